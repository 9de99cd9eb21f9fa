"""docs/equations.md is what its tool writes, has a row for all that the thesis numbers, and names nothing missing."""

import ast
from dataclasses import replace
from pathlib import Path

import pytest

from tools.docs.equations.lookup import ROOT, RowError, check_rows, problem_of_name, problem_of_test
from tools.docs.equations.page import page
from tools.docs.equations.rows import Row, read_rows

ROWS = read_rows()
NUMBERED = {"Eq.": 26, "Table": 4, "Figure": 15}
"""How many of each the thesis has."""

GOOD = Row("Eq. 0", "an equation", ("continuum.arm.Section",), ("continuum/test/test_errata.py::test_eq_06_straight",))

each_row = pytest.mark.parametrize("row", ROWS, ids=lambda row: row.number)


def test_the_page_is_what_the_rows_make() -> None:
    assert (ROOT / "docs" / "equations.md").read_text(encoding="utf-8") == page(ROWS)


def test_all_that_the_thesis_numbers_has_one_row_in_its_order() -> None:
    expected = [f"{kind} {number}" for kind, last in NUMBERED.items() for number in range(1, last + 1)]
    assert [row.number for row in ROWS] == expected
    assert all(row.what for row in ROWS)


def test_every_row_has_one_line_of_the_page() -> None:
    lines = page(ROWS).splitlines()
    assert [
        line.split(" | ")[0].removeprefix("| ") for line in lines if line.startswith(("| Eq.", "| Ta", "| Fi"))
    ] == [row.number for row in ROWS]


@each_row
def test_names_and_tests_are_there(row: Row) -> None:
    check_rows([row])


def names_in(path: Path) -> set[str]:
    """Names that a module uses anywhere."""
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    return {node.id for node in nodes if isinstance(node, ast.Name)}


@pytest.mark.parametrize("row", [row for row in ROWS if row.kind == "Eq."], ids=lambda row: row.number)
def test_a_function_of_an_equation_is_used_by_one_of_its_tests(row: Row) -> None:
    functions = {name.rpartition(".")[2] for name in row.names}
    assert functions & set().union(*(names_in(ROOT / test.partition("::")[0]) for test in row.tests))


@pytest.mark.parametrize(
    "name",
    [
        "continuum.arm.Section",
        "continuum.arm.SECTION_PARAMETERS",
        "continuum.kinematics.chain.arm_pose",
        "continuum solve",
        "continuum model new",
        "make demo",
        "ros2 run continuum_manipulator forward_kinematics",
        "ros2 launch continuum_manipulator dynamics.launch.py",
        "docs/errata.md",
    ],
)
def test_what_is_there_is_found(name: str) -> None:
    assert problem_of_name(name) == ""


@pytest.mark.parametrize(
    "name",
    [
        "continuum.arm.Sektion",
        "continuum.arms.Section",
        "continuum.kinematics.chain",  # a module
        "kontinuum.arm.Section",
        "continuum dissolve",
        "continuum --help",
        "continuum model old",
        "continuum solve ARM.yaml",  # an argument
        "make demos",
        "make",
        "ros2 run continuum_manipulator backward_kinematics",
        "ros2 run continuum_manipulation forward_kinematics",
        "ros2 run continuum urdf",  # an entry point of another kind
        "ros2 launch continuum_manipulator statics.launch.py",
        "docs/error.md",
        "docs/pictures",
        "something like it",
        "",
    ],
)
def test_a_name_of_nothing_is_refused(name: str) -> None:
    assert problem_of_name(name)
    with pytest.raises(RowError, match=r"^Eq\. 0: "):
        check_rows([GOOD, replace(GOOD, names=(*GOOD.names, name))])


@pytest.mark.parametrize(
    "test",
    [
        "continuum/test/test_errata.py::test_eq_99",
        "continuum/test/test_errata.py::relative_error",  # no test
        "continuum/test/test_errata.py",
        "continuum/test/test_misprints.py::test_eq_06_straight",
        "continuum/test/test_errata_dynamics.py::test_eq_06_straight",  # of another file
        "tools/docs/markdown.py::table",
        "",
    ],
)
def test_a_test_of_nothing_is_refused(test: str) -> None:
    assert problem_of_test(test)
    with pytest.raises(RowError, match=r"^Eq\. 0: "):
        check_rows([GOOD, replace(GOOD, tests=(*GOOD.tests, test))])


@pytest.mark.parametrize("part", ["names", "tests"])
def test_what_is_missing_needs_a_reason(part: str) -> None:
    bare = replace(GOOD, **{part: ()})
    with pytest.raises(RowError, match=r"^Eq\. 0: "):
        check_rows([bare])
    explained = replace(bare, reason="a photograph")
    check_rows([explained])
    assert "a photograph" in page([explained])
