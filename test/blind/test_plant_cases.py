"""What an analysis is handed by either plant tells nothing but the measurement; what is hidden can be drawn again."""

import ast
import re
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from blind import moreau_plant, mujoco_plant
from blind.mujoco_plant import COMMANDS, DATASETS, EFFECTS, LIBRARY, OUTSIDE, Case, draw_plan, make_case, write_case
from blind.mujoco_plant.effect import SIZES
from blind.mujoco_plant.table import table

pytestmark = pytest.mark.slow

SHORT = {"dataset": ["release", "chirp"], "seconds": 0.5, "seed": 11}
SEEDS = range(1500)
DIGITS = (
    {"t_s": 6, "u1_N": 4, "u2_N": 4} | {f"q{i}_deg": 4 for i in range(1, 6)} | {f"dq{i}_deg_s": 3 for i in range(1, 6)}
)

each_plant = pytest.mark.parametrize("of", [mujoco_plant, moreau_plant], ids=lambda of: of.__name__)


@pytest.fixture(scope="module")
def cases() -> list[Case]:
    """One seed with nothing hidden, an effect of the mechanics, of the sensors, of the cables, and one from outside."""
    return [
        make_case(effects, **SHORT)
        for effects in ([], ["backlash"], ["sensor_delay"], ["actuator_lag", "gyro_drift"], ["magnet"])
    ]


@pytest.mark.parametrize(("folder", "engine"), [("mujoco_plant", "mujoco"), ("moreau_plant", "numba")])
def test_a_plant_shares_no_code_with_the_library_and_the_second_none_with_mujoco(folder: str, engine: str) -> None:
    found = set()
    for path in (Path(__file__).parent / folder).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                found |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                found.add(str(node.module).partition(".")[0])
    assert engine in found
    assert not {name for name in found if name.startswith(("continuum", "importlib"))}
    assert ("mujoco" in found) == (engine == "mujoco")


def test_the_arm_moves_from_the_row_on_in_which_the_tension_ends(cases: list[Case]) -> None:
    case = cases[0]
    (name,) = (name for name, regime in case.truth.regimes.items() if regime == "release")
    rows = np.loadtxt(case.files[name].decode().splitlines(), delimiter=",", skiprows=1)
    let_go = int(np.argmin(rows[:, -2:].any(axis=1)))
    moved = np.degrees(np.abs(case.without_noise[name] - case.without_noise[name][0])).max(axis=1)
    assert 2 <= let_go <= 8
    assert moved[let_go] < 0.01
    assert moved[let_go + 1] > 0.5


@each_plant
def test_a_seed_gives_the_same_bytes_again_and_another_seed_others(of: ModuleType) -> None:
    first, again, other = (of.make_case(["inertia"], **(SHORT | {"seed": seed})).files for seed in (11, 11, 12))
    assert again == first
    assert all(other[name] != content for name, content in first.items())


def test_a_seed_draws_the_same_in_both_plants() -> None:
    assert moreau_plant.make_case(["inertia"], **SHORT).truth.plain() == make_case(["inertia"], **SHORT).truth.plain()


def test_files_are_alike_whatever_is_hidden(cases: list[Case]) -> None:
    views = []
    for case in cases:
        look = []
        for name, content in case.files.items():
            header, *rows = content.decode("ascii").splitlines()
            columns = header.split(",")
            assert columns[0] == "t_s"
            for row in rows:
                for column, cell in zip(columns, row.split(","), strict=True):
                    assert re.fullmatch(rf"-?\d+\.\d{{{DIGITS[column]}}}", cell)
            look.append((name, header, [row.partition(",")[0] for row in rows], content.endswith(b"\n")))
        views.append((look, case.truth.regimes))
    assert all(look == views[0] for look in views)


def test_a_zero_has_no_sign() -> None:
    assert table({"t_s": np.array([0.0, 1.0]), "u1_N": np.array([-0.0, -1e-5])}) == (
        b"t_s,u1_N\n0.000000,0.0000\n1.000000,0.0000\n"
    )


def test_commands_do_not_depend_on_what_is_hidden(cases: list[Case]) -> None:
    """Where the motion is commanded; how far a cable must be pulled before a release is itself a measurement."""

    def commands(case: Case) -> list[list[str]]:
        driven = [case.files[name] for name, regime in case.truth.regimes.items() if regime != "release"]
        return [[row.split(",")[-2:] for row in content.decode().splitlines()] for content in driven]

    assert all(commands(case) == commands(cases[0]) for case in cases)


def test_the_folder_reveals_nothing(cases: list[Case], tmp_path: Path) -> None:
    sights = []
    words = re.compile("|".join([*EFFECTS, *COMMANDS, *SIZES, "release", "seed", "noise", "truth"]))
    for number, case in enumerate(cases):
        folder, sealed = tmp_path / f"{number}" / "data", tmp_path / "sealed" / f"{number}.json"
        paths = write_case(case, folder, sealed)
        assert sorted(paths) == sorted(folder.iterdir())
        assert not any(words.search(path.name) or words.search(path.read_text()) for path in paths)
        sights.append([(p.name, p.stat().st_mtime, p.stat().st_mode) for p in sorted(folder.iterdir())])
        assert all(name in sealed.read_text() for name in case.truth.names)
    assert all(sight == sights[0] for sight in sights)


def test_the_truth_stays_out_of_the_datas_folder(cases: list[Case], tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="where the analysis looks"):
        write_case(cases[0], tmp_path, tmp_path / "inside" / "truth.json")
    assert list(tmp_path.iterdir()) == []


def test_every_effect_is_drawn_and_only_where_it_can_be_seen() -> None:
    plans = [draw_plan(seed) for seed in SEEDS]
    assert {name for plan in plans for name in plan.effects} == {*LIBRARY, *OUTSIDE}
    assert {plan.size for plan in plans} == set(SIZES)
    assert not any(
        "driven" in EFFECTS[name].seen_in and len(EFFECTS[name].seen_in) == 1
        for plan in plans
        if set(DATASETS[plan.dataset]) == {"release"}
        for name in plan.effects
    )
    assert 0.15 < sum(not plan.effects for plan in plans) / len(plans) < 0.25
    assert all(draw_plan(plan.seed) == plan for plan in plans[:20])


def test_what_is_given_is_not_drawn() -> None:
    for seed in range(30):
        plan = draw_plan(seed, "outside", size="large", dataset="slow", noise="low")
        assert (plan.size, plan.dataset, plan.noise) == ("large", "slow", "low")
        assert set(plan.effects) < set(OUTSIDE)


@each_plant
def test_a_drawn_case_holds_what_is_planned(of: ModuleType) -> None:
    case = of.draw_case(4, "one", dataset="releases")
    assert case.truth.names == draw_plan(4, "one", dataset="releases").effects
    assert list(case.truth.regimes.values()) == ["release"] * 4


def test_files_of_the_second_plant_hold_angles_and_tensions_and_no_rates() -> None:
    files = moreau_plant.make_case([], **SHORT).files.values()
    columns = "t_s,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,u1_N,u2_N"
    assert {content.decode().splitlines()[0] for content in files} == {columns}


@pytest.mark.parametrize("noise", ["low", "ordinary", "high"])
def test_zeros_are_wrong_by_tenths_of_a_degree_on_top_of_the_noise(noise: str) -> None:
    """Each joint's but the first, which has one sensor: by 0.15 degrees, and what the noise has by itself."""
    joints = np.degrees(np.sqrt(2) * np.array([moreau_plant.NOISES[noise].start, mujoco_plant.NOISES[noise].start]))
    assert np.sqrt(joints[0] ** 2 - joints[1] ** 2) == pytest.approx(0.15)
    case = moreau_plant.make_case(dataset=["release"] * 4, seed=5, noise=noise)
    errors = []
    for name, content in case.files.items():
        rows = np.loadtxt(content.decode().splitlines(), delimiter=",", skiprows=1)
        errors.append((rows[:, 1:6] - np.degrees(case.without_noise[name])).mean(axis=0))
    assert 0.05 < np.std(errors) < 3 * joints[0]
