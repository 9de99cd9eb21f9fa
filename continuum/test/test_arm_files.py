"""Arm parameter files: what load_arm reads; a bad file is a FileError or an InvalidValueError, nothing else."""

from pathlib import Path

import pytest
import yaml
from continuum_laws.outcomes import outcome
from continuum_laws.strategies import LAW, arms
from hypothesis import given
from hypothesis import strategies as st

from continuum.arm import Arm, arm_to_mapping, load_arm
from continuum.errors import FileError, InvalidValueError

ONE_SECTION = "sections: [s]\ns: {n_joints: 5, b: 0.02, a: 0.03}\n"

PIECES = [
    *["sections", "s", "arm", "/**", "ros__parameters", "a", "b", "n_joints", "twist", "cable_azimuths"],
    *[": ", ":", "- ", ", ", "[", "]", "{", "}", "\n", "\n  ", "\n    ", '"', "'", "|", ">"],
    *["#", "&x", "*x", "%", "---", "?", "<<", "\t", "\x00", "é", "2001-99-99", "true", "null", "~"],
    *["1", "-1", "0.02", "1e3", ".nan", ".inf", "9" * 400, "0x"],
]


@pytest.fixture(scope="session")
def scratch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("arms") / "arm.yaml"


@LAW
@given(arm=arms())
@pytest.mark.parametrize("keys", [(), ("arm",), ("/**", "ros__parameters", "arm")], ids=len)
def test_a_written_arm_is_read_back(scratch: Path, keys: tuple[str, ...], arm: Arm) -> None:
    content = arm_to_mapping(arm)
    for key in reversed(keys):
        content = {key: content}
    scratch.write_text(yaml.safe_dump(content), encoding="utf-8")
    assert load_arm(scratch) == arm
    assert load_arm(str(scratch)) == arm


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"5",
        b"just text",
        b"- 1",
        b"a: [",
        b"a: b: c",
        b"\xff\xfe",
        b"a: 2001-99-99",
        b"{a: 1, ? [b]: 2}",
        b"sections: [s]\ns: {n_joints: 2, b: 0.01, a: 0.02, b: 0.03}",
        b"sections: [s]\ns: {n_joints: 2, b: 0.01, a: 0.02}\ns.b: 0.03",
        b"sections: [s]\ns: &s {n_joints: 2, b: 0.01, a: 0.02}\nt: *s",
        b"a: &a {k: 1}\nsections: [s]\ns: {<<: *a}",
        b"[" * 5000,
    ],
)
def test_a_file_that_holds_no_arm(scratch: Path, content: bytes) -> None:
    scratch.write_bytes(content)
    with pytest.raises(FileError) as caught:
        load_arm(scratch)
    assert caught.value.path == scratch
    assert "\n" not in str(caught.value)


@LAW
@given(content=st.binary() | st.text().map(lambda text: text.encode("utf-8", "replace")))
def test_any_file_is_an_arm_or_refused(scratch: Path, content: bytes) -> None:
    scratch.write_bytes(content)
    with pytest.raises((FileError, InvalidValueError)) as caught:
        load_arm(scratch)
    assert "\n" not in str(caught.value)


@LAW
@given(at=st.integers(0, len(ONE_SECTION)), width=st.integers(0, 4), piece=st.sampled_from(PIECES))
def test_a_damaged_arm_is_an_arm_or_refused(scratch: Path, at: int, width: int, piece: str) -> None:
    scratch.write_text(ONE_SECTION[:at] + piece + ONE_SECTION[at + width :], encoding="utf-8")
    found = outcome(load_arm, scratch)
    assert isinstance(found, FileError | InvalidValueError) or found.n_sections == 1


def test_a_slip_in_a_name_is_reported_with_the_right_one(scratch: Path) -> None:
    scratch.write_text(ONE_SECTION.replace("n_joints", "n_joint"), encoding="utf-8")
    with pytest.raises(InvalidValueError, match=r"arm\.s\.n_joint .* did you mean n_joints\?$"):
        load_arm(scratch)


def test_whole_numbers_among_decimals_are_refused_as_ros_does(scratch: Path) -> None:
    scratch.write_text("arm: {sections: [s], s: {cable_azimuths: [0, 1.5, 3.0]}}", encoding="utf-8")
    with pytest.raises(FileError, match=r"arm\.s\.cable_azimuths is \[0, 1\.5, 3\.0\].*write 0\.0, not 0"):
        load_arm(scratch)


def test_decimals_may_be_written_with_an_exponent(scratch: Path) -> None:
    scratch.write_text(ONE_SECTION.replace("0.02", "2e-2"), encoding="utf-8")
    assert load_arm(scratch).sections[0].b == 0.02


@pytest.mark.parametrize("number", ["05", "010", "1:05", "1_0", "0o5", "5,0", "5 m"])
def test_numbers_that_languages_read_differently_are_none(scratch: Path, number: str) -> None:
    scratch.write_text(ONE_SECTION.replace("n_joints: 5, b", f'n_joints: "{number}", b'))
    with pytest.raises(InvalidValueError) as quoted:
        load_arm(scratch)
    scratch.write_text(f"sections: [s]\ns:\n  n_joints: {number}\n  b: 0.02\n  a: 0.03\n")
    with pytest.raises(InvalidValueError) as bare:
        load_arm(scratch)
    assert str(bare.value) == str(quoted.value)
    assert repr(number) in str(bare.value)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_every_unicode_file_is_the_same(scratch: Path, encoding: str) -> None:
    scratch.write_text(ONE_SECTION, encoding="utf-8")
    arm = load_arm(scratch)
    scratch.write_text("# é\n" + ONE_SECTION, encoding=encoding)
    assert load_arm(scratch) == arm
