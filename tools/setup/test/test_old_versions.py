"""The lock of the old versions is made from both lists."""

import re

import pytest

from tools.setup.layout import OLD_LOCK, OLD_VERSIONS, REQUIREMENTS, ROOT
from tools.setup.old_versions import with_versions

REQUIRED = "# what for\na==1.0\nb-c==2.0\n\nd==3.0\n"


def test_versions_are_changed_and_packages_left_out() -> None:
    assert with_versions(REQUIRED, "") == "a==1.0\nb-c==2.0\nd==3.0\n"
    assert with_versions(REQUIRED, "# old\nb-c==1.5\nwithout d\n") == "a==1.0\nb-c==1.5\n"


@pytest.mark.parametrize("versions", ["e==1.0\n", "without e\n"])
def test_only_what_is_required_can_be_changed(versions: str) -> None:
    with pytest.raises(ValueError, match=r"^e: "):
        with_versions(REQUIRED, versions)


def test_all_of_it_is_locked() -> None:
    pins = with_versions(REQUIREMENTS.read_text(), OLD_VERSIONS.read_text()).split()
    locked = OLD_LOCK.read_text()
    assert [pin for pin in pins if f"\n{pin} \\\n" not in locked] == []


def test_the_page_names_the_versions_that_are_tried() -> None:
    page = (ROOT / "docs" / "dependencies.md").read_text()
    section = page.partition("## Oldest versions")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| (\S+) [\d.]+ \| `[\w-]+` \| ([\d.]+)", section, re.MULTILINE)
    pins = re.findall(r"^([a-z0-9-]+)==(\S+)$", OLD_VERSIONS.read_text(), re.MULTILINE)
    assert sorted((name.lower(), version) for name, version in rows) == sorted(pins)
