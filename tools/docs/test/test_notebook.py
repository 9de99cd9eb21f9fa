"""A notebook's cells share a namespace; text, figures and last values become outputs, in the place of old ones."""

from base64 import b64decode

import matplotlib as mpl
import pytest

from tools.docs.notebook import run_cells

CELLS = (
    "x = 2\nprint('two')\nprint(x)",
    "x + 1",
    "from matplotlib import pyplot as plt\nfigure = plt.figure()\nNone",
    "from matplotlib.figure import Figure\nFigure()",
)


@pytest.fixture(autouse=True)
def without_a_screen() -> None:
    mpl.use("Agg")


def code(source: str) -> dict[str, object]:
    return {"cell_type": "code", "source": source.splitlines(keepends=True), "outputs": ["old"], "metadata": {}}


def test_outputs_are_those_of_a_kernel() -> None:
    notebook = {"cells": [{"cell_type": "markdown", "source": ["text"]}, *map(code, CELLS)]}
    run_cells(notebook)
    text, *cells = notebook["cells"]
    printed, value, opened, shown = (cell["outputs"] for cell in cells)
    assert text == {"cell_type": "markdown", "source": ["text"]}
    assert [cell["execution_count"] for cell in cells] == [1, 2, 3, 4]
    assert printed == [{"output_type": "stream", "name": "stdout", "text": ["two\n", "2\n"]}]
    assert value[0]["data"] == {"text/plain": ["3"]}
    for (output,) in (opened, shown):
        assert output["output_type"] == "display_data"
        assert b64decode(output["data"]["image/png"]).startswith(b"\x89PNG")


def test_a_cell_that_fails_ends_the_run() -> None:
    with pytest.raises(ZeroDivisionError):
        run_cells({"cells": [code("1 / 0")]})
