"""`make docs`: build the pages as one site in out/docs/site; a warning ends it with an error."""

from __future__ import annotations

import logging
import sys
from pathlib import Path

from mkdocs.commands.build import build
from mkdocs.config import load_config
from mkdocs.exceptions import MkDocsException

from tools.docs.site.source import assemble, navigation

OUT = Path("out/docs").absolute()
CONFIGURATION = Path(__file__).with_name("mkdocs.yml")


def main() -> int:
    """Assemble the source and build the site; return 1 if a page, a link or a linked heading is missing."""
    logging.basicConfig(level=logging.WARNING, format="docs: %(message)s")
    assemble(OUT / "source")
    try:
        config = load_config(
            str(CONFIGURATION), docs_dir=str(OUT / "source"), site_dir=str(OUT / "site"), nav=navigation(), strict=True
        )
        config.plugins.on_startup(command="build", dirty=False)
        build(config)
    except MkDocsException as error:
        print(f"docs: {error}", file=sys.stderr)
        return 1
    print(f"written: {(OUT / 'site' / 'index.html').relative_to(Path.cwd())}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
