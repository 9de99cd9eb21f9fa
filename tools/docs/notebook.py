"""Run the code cells of a notebook and save their outputs in it: `make notebook`, without Jupyter.

    python3 -m tools.docs.notebook examples/find_the_hidden_effect.ipynb

Cells run in one namespace, as in a kernel. Outputs are the printed text, the value of a last expression, and figures
that are open or that are this value.
"""

from __future__ import annotations

import ast
import base64
import io
import json
import sys
import tempfile
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from continuum.whole_file import write_figure, write_whole
from tools.docs.small_png import shrink

DPI = 70


def main() -> None:
    mpl.use("Agg")
    path = Path(sys.argv[1])
    notebook = json.loads(path.read_text(encoding="utf-8"))
    run_cells(notebook)
    write_whole(path, json.dumps(notebook, indent=1, ensure_ascii=False) + "\n")


def run_cells(notebook: dict[str, Any]) -> None:
    """Replace the outputs of every code cell of a notebook (nbformat 4) by new ones."""
    namespace: dict[str, Any] = {"__name__": "__main__"}
    for number, cell in enumerate((cell for cell in notebook["cells"] if cell["cell_type"] == "code"), 1):
        cell["execution_count"] = number
        cell["outputs"] = outputs_of("".join(cell["source"]), namespace, number)


def outputs_of(source: str, namespace: dict[str, Any], number: int) -> list[dict[str, Any]]:
    """Run one cell and return its outputs in the order text, figures, value."""
    tree, value, printed = ast.parse(source), None, io.StringIO()
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    with redirect_stdout(printed):
        exec(compile(tree, f"cell {number}", "exec"), namespace)  # noqa: S102  (the checkout's own notebook)
        if isinstance(last, ast.Expr):
            value = eval(compile(ast.Expression(last.value), f"cell {number}", "eval"), namespace)  # noqa: S307
    found: list[dict[str, Any]] = []
    if text := printed.getvalue():
        found.append({"output_type": "stream", "name": "stdout", "text": text.splitlines(keepends=True)})
    figures = [plt.figure(figure) for figure in plt.get_fignums()]
    if isinstance(value, Figure):
        figures.append(value)
    elif value is not None:
        data = {"text/plain": repr(value).splitlines(keepends=True)}
        found.append({"output_type": "execute_result", "execution_count": number, "data": data, "metadata": {}})
    found += [{"output_type": "display_data", "data": {"image/png": png(one)}, "metadata": {}} for one in figures]
    plt.close("all")
    return found


def png(figure: Figure) -> str:
    """Return a small picture in base64."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "figure.png"
        write_figure(path, figure, DPI)
        shrink(path)
        return base64.b64encode(path.read_bytes()).decode()


if __name__ == "__main__":
    main()
