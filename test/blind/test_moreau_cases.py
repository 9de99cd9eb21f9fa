"""What an analysis is handed by the second plant: angles alone, zeroed badly; no code in common with the library."""

import ast
from pathlib import Path

import numpy as np
import pytest

from blind import moreau, plant
from blind.plant import Case

pytestmark = pytest.mark.slow

SHORT = {"dataset": ["release", "chirp"], "seconds": 0.5, "seed": 11}
COLUMNS = "t_s,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,u1_N,u2_N"


@pytest.fixture(scope="module")
def case() -> Case:
    return moreau.make_case(["inertia"], **SHORT)


def test_the_plant_shares_no_code_with_the_library_nor_with_mujoco() -> None:
    found = set()
    for path in (Path(__file__).parent / "moreau").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                found |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                found.add(str(node.module).partition(".")[0])
    assert "numba" in found
    assert not {name for name in found if name.startswith(("continuum", "importlib", "mujoco"))}


def test_a_seed_gives_the_same_bytes_again(case: Case) -> None:
    assert moreau.make_case(["inertia"], **SHORT).files == case.files


def test_another_seed_gives_other_bytes(case: Case) -> None:
    other = moreau.make_case(["inertia"], **(SHORT | {"seed": 12}))
    assert all(other.files[name] != content for name, content in case.files.items())


def test_files_hold_angles_and_tensions_and_no_rates(case: Case) -> None:
    assert {content.decode().splitlines()[0] for content in case.files.values()} == {COLUMNS}


def test_a_seed_draws_the_same_as_in_the_other_plant(case: Case) -> None:
    assert case.truth.plain() == plant.make_case(["inertia"], **SHORT).truth.plain()


def test_a_drawn_case_holds_what_is_planned() -> None:
    case = moreau.draw_case(4, "one", dataset="releases")
    assert case.truth.names == plant.draw_plan(4, "one", dataset="releases").effects


def test_a_case_is_written_as_any(case: Case, tmp_path: Path) -> None:
    paths = moreau.write_case(case, tmp_path / "data", tmp_path / "truth.json")
    assert [path.read_bytes() for path in paths] == [case.files[name] for name in sorted(case.files)]
    assert "inertia" in (tmp_path / "truth.json").read_text()


@pytest.mark.parametrize("noise", ["low", "ordinary", "high"])
def test_zeros_are_wrong_by_tenths_of_a_degree_on_top_of_the_noise(noise: str) -> None:
    """Each joint's but the first, which has one sensor: by 0.15 degrees, and what the noise has by itself."""
    joints = np.degrees(np.sqrt(2) * np.array([moreau.NOISES[noise].start, plant.NOISES[noise].start]))
    assert np.sqrt(joints[0] ** 2 - joints[1] ** 2) == pytest.approx(0.15)
    case = moreau.make_case(dataset=["release"] * 4, seed=5, noise=noise)
    errors = []
    for name, content in case.files.items():
        rows = np.loadtxt(content.decode().splitlines(), delimiter=",", skiprows=1)
        errors.append((rows[:, 1:6] - np.degrees(case.without_noise[name])).mean(axis=0))
    assert 0.05 < np.std(errors) < 3 * joints[0]
