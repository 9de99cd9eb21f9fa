"""Models from URDFs move as MuJoCo says that the same URDF does; what is no planar chain is refused."""

import re
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from continuum.cli import main
from continuum.dynamics.balance import balance
from continuum.dynamics.commented_model import commented_model
from continuum.dynamics.model import NamedJoint
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.urdf_chain import UrdfChain, chain_from_urdf
from continuum.errors import FileError

LINK = """<link name="{name}"><inertial><origin xyz="{xyz}" rpy="{rpy}"/><mass value="{mass}"/>
<inertia ixx="{a}" iyy="{b}" izz="{c}" ixy="0" ixz="0" iyz="0"/></inertial></link>"""
JOINT = """<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>{more}</joint>"""
FAR_AWAY = ["--mass=1", "--center-of-mass=1e200", "--inertia=1", "--link-length=1", "--inertia-about=joint"]
LIMIT = '<limit lower="-3" upper="3" effort="100" velocity="100"/>'


def words(values: object) -> str:
    return " ".join(f"{one:.17g}" for one in np.atleast_1d(np.asarray(values, dtype=float)))


def planar_arm(n: int, seed: int) -> str:
    """A URDF whose axes are parallel: mounted askew, drawn bent, some axes turned round, links of two parts each."""
    random = np.random.default_rng(seed)
    parts = ['<robot name="arm"><link name="world"/><link name="base"/>']
    mount = {"xyz": words(random.normal(size=3)), "rpy": words(random.uniform(-2, 2, 3)), "axis": "1 0 0", "more": ""}
    parts.append(JOINT.format(name="mount", kind="fixed", parent="world", child="base", **mount))
    flat, parent, offset = np.zeros(3), "base", np.zeros(3)
    for number in range(1, n + 1):
        length, name = random.uniform(0.1, 0.4), f"link_{number}"
        way = random.uniform(-np.pi, np.pi)  # in which the link points in its own frame
        along = np.array([np.cos(way), np.sin(way), 0.0])
        rpy = [random.choice([0.0, np.pi]), 0.0, random.uniform(-np.pi, np.pi)]
        axis = [0.0, 0.0, random.choice([-1.0, 1.0])]
        kind = random.choice(["revolute", "continuous"])
        damping = f'{LIMIT}<dynamics damping="{random.uniform(0, 0.1):.17g}" friction="0"/>'
        place = {"xyz": words(offset), "rpy": words(rpy), "axis": words(axis), "more": damping}
        parts.append(JOINT.format(name=f"joint_{number}", kind=kind, parent=parent, child=name, **place))
        for part, share in ((name, 0.3), (f"{name}_rest", 0.8)):
            a, b = random.uniform(1e-3, 2e-3, 2)
            centre = share * length * along + flat + [0.0, 0.0, random.normal() * 0.05]
            values = {"a": a, "b": b, "c": random.uniform(abs(a - b), a + b), "mass": random.uniform(0.2, 1.0)}
            parts.append(LINK.format(name=part, xyz=words(centre), rpy=words(random.uniform(-2, 2, 3)), **values))
        still = {"xyz": "0 0 0", "rpy": "0 0 0", "axis": "1 0 0", "more": ""}
        parts.append(JOINT.format(name=f"{name}_glue", kind="fixed", parent=name, child=f"{name}_rest", **still))
        offset, parent = length * along + [0.0, 0.0, random.normal() * 0.1], name
    end = {"xyz": words(offset), "rpy": "0 0 0", "axis": "1 0 0", "more": ""}
    parts += ['<link name="tip"/>', JOINT.format(name="end", kind="fixed", parent=parent, child="tip", **end)]
    return "".join(parts) + "</robot>"


def read(text: str, folder: Path, **options: object) -> UrdfChain:
    (folder / "arm.urdf").write_text(text, encoding="utf-8")
    return chain_from_urdf(folder / "arm.urdf", **options)


@pytest.mark.parametrize("n", [1, 2, 7])
@pytest.mark.parametrize("seed", range(3))
def test_torques_are_those_of_mujoco(n: int, seed: int, tmp_path: Path) -> None:
    text, random = planar_arm(n, seed), np.random.default_rng(seed)
    chain = read(text, tmp_path)
    engine = mujoco.MjModel.from_xml_string(text)
    engine.dof_frictionloss[:] = 0.0
    engine.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    data = mujoco.MjData(engine)
    for _ in range(5):
        q, rate, acceleration = random.normal(size=(3, n))
        data.qpos[:], data.qvel[:], data.qacc[:] = q, rate, acceleration
        mujoco.mj_inverse(engine, data)
        state = np.concatenate([chain.signs * q + chain.zeros, chain.signs * rate])
        found = balance(chain.model, state, chain.signs * acceleration, np.zeros(n))
        np.testing.assert_allclose(chain.signs * found, data.qfrc_inverse, rtol=1e-6, atol=1e-6)
    assert chain.joints == tuple(f"joint_{number}" for number in range(1, n + 1))
    assert chain.tip == "tip"


NAMESPACES = {
    "default": lambda text: text.replace("<robot", '<robot xmlns="https://sim.example.org/urdf"', 1),
    "of every link": lambda text: text.replace("<link", '<link xmlns="https://sim.example.org/urdf"'),
    "prefixed": lambda text: re.sub(r"<(/?)(?=\w)", r"<\1u:", text).replace("<u:robot", '<u:robot xmlns:u="urn:u"', 1),
    "declared for xacro": lambda text: text.replace("<robot", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"', 1),
    "both": lambda text: text.replace(
        "<robot", '<robot xmlns="https://sim.example.org/urdf" xmlns:xacro="http://ros.org/wiki/xacro"', 1
    ),
    "of extensions": lambda text: text.replace("<robot", '<robot xmlns:drake="http://drake.mit.edu"', 1).replace(
        "</robot>", '<gazebo><drake:plugin name="x"/></gazebo></robot>'
    ),
    "definitions left by xacro": lambda text: text.replace(
        "<robot", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"', 1
    ).replace(
        "</robot>",
        '<xacro:property name="length" value="0.3"/><xacro:macro name="leg" params="*origin"><link name="leg">'
        '<xacro:insert_block name="origin"/></link></xacro:macro></robot>',
    ),
}


@pytest.mark.parametrize("namespace", NAMESPACES)
def test_namespaces_change_nothing(namespace: str, tmp_path: Path) -> None:
    text = planar_arm(3, 2)
    changed = NAMESPACES[namespace](text)
    assert changed != text
    plain, found = read(text, tmp_path), read(changed, tmp_path)
    assert (found.model.joints, found.tip) == (plain.model.joints, plain.tip)
    for name, value in plain.model.parameters.named().items():
        np.testing.assert_array_equal(found.model.parameters.named()[name], value, err_msg=name)


@pytest.mark.parametrize(
    ("change", "what"),
    [
        (("</robot>", '<xacro:include filename="leg.xacro"/></robot>'), "xacro:include; expand"),
        (('<link name="base"/>', '<xacro:if value="1"><link name="base"/></xacro:if>'), "xacro:if; expand"),
        (('<mass value="', '<mass value="${m} '), "expand it first"),
        (("<robot", "<sdf"), "root element is sdf"),
    ],
)
def test_what_xacro_has_not_replaced_is_refused_with_the_remedy(
    change: tuple[str, str], what: str, tmp_path: Path
) -> None:
    text = planar_arm(2, 1).replace("<robot", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"', 1)
    assert change[0] in text
    text = text.replace(change[0], change[1], 1)
    with pytest.raises(FileError, match=what):
        read(text.replace("</robot>", "</sdf>") if "<sdf" in text else text, tmp_path)


def test_the_command_writes_the_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    chain, out = read(planar_arm(3, 5), tmp_path), tmp_path / "model.yaml"
    assert main(["model", "from-urdf", str(tmp_path / "arm.urdf"), "--out", str(out)]) == 0
    for name, value in load_model(out).parameters.named().items():
        np.testing.assert_array_equal(value, getattr(chain.model.parameters, name), err_msg=name)
    assert load_model(out).joints == chain.model.joints
    *lines, driven, written = capsys.readouterr().out.splitlines()
    assert (driven, written) == ("3 joints, driven by joint torques", f"written: {out}")
    for line in lines:
        assert f"# {line}\n" in out.read_text()


@pytest.mark.parametrize(
    ("change", "what"),
    [
        (('type="continuous"', 'type="prismatic"'), "prismatic"),
        (('<axis xyz="0 0 1"/>', '<axis xyz="0 0.1 1"/>'), "not parallel"),
        (('<child link="link_2"/>', '<child link="nowhere"/>'), "between undefined links"),
        (("</robot>", "<link/></robot>"), "cannot be read"),
        (("<mass", "<weight"), "without mass"),
        (("<robot", "<"), "cannot be read"),
        (('damping="0', 'damping="x0'), "damping"),
        (("</robot>", '<link name="other"/></robot>'), "not a tree"),
        (("</robot>", '<link name="tip"/></robot>'), "2 times"),
        (("</robot>", ""), "cannot be read"),
        ((' iyy="', ' jyy="'), "moment of inertia iyy"),
        (("<robot", '<!DOCTYPE r [<!ENTITY a "b">]><robot'), "document type"),
        (('<axis xyz="0 0 1"/>', '<axis xyz="0 0 0"/>'), "axis"),
    ],
)
def test_what_is_no_planar_chain_is_refused(change: tuple[str, str], what: str, tmp_path: Path) -> None:
    text = planar_arm(2, 1).replace('type="revolute"', 'type="continuous"').replace("0 0 -1", "0 0 1")
    assert change[0] in text
    with pytest.raises(FileError, match=what):
        read(text.replace(change[0], change[1], 1), tmp_path)


def test_a_centre_of_mass_next_to_the_line_is_refused(tmp_path: Path) -> None:
    text = planar_arm(1, 1)
    read(text, tmp_path)
    at = text.index('<origin xyz="', text.index('<link name="link_1"')) + len('<origin xyz="')
    with pytest.raises(FileError, match="off the line"):
        read(text[:at] + words([0.3, -0.3, 0.0]) + text[text.index('"', at) :], tmp_path)


def test_a_model_of_values_is_the_one_that_was_given(tmp_path: Path) -> None:
    out = tmp_path / "model.yaml"
    values = ["--mass", "0.559,0.604", "--center-of-mass", "0.3,0.184", "--link-length", "0.3,0.2", "--gravity", "9.81"]
    about_joint = ["--inertia", "0.0535,0.0239", "--inertia-about", "joint", "--coulomb-friction", "0.16,0.12"]
    assert main(["model", "new", "--joints", "2", *values, *about_joint, "--out", str(out)]) == 0
    p = load_model(out).parameters
    np.testing.assert_allclose(p.inertia + p.mass * p.center_of_mass**2, [0.0535, 0.0239])
    np.testing.assert_array_equal(p.coulomb_friction, [0.16, 0.12])


@pytest.mark.parametrize("name", ["lamecc_prototype.yaml", "double_pendulum.yaml"])
@pytest.mark.parametrize("named", [False, True])
def test_a_commented_file_gives_its_model_back(name: str, named: bool, tmp_path: Path) -> None:
    model, out = load_model(name), tmp_path / "model.yaml"
    names = [f"j: {number}, #" for number in range(model.n_joints)] if named else []
    model = replace(model, joints=tuple(NamedJoint(one, -1 if "1" in one else 1, 0.1) for one in names))
    out.write_text(commented_model(model, ["a joint named\nn_joints: 7"]), encoding="utf-8")
    found = load_model(out)
    assert (found.inputs, found.sources, found.joints) == (model.inputs, model.sources, model.joints)
    save_model(model, out)
    assert load_model(out).joints == model.joints
    for key, value in model.values().items():
        np.testing.assert_array_equal(found.values()[key], value)


@pytest.mark.parametrize(
    ("words_of_option", "what"),
    [
        (["--joints", "two"], "--joints is 'two'"),
        (["--joints", "0", "--inertia-about", "joint"], "--joints"),
        (["--joints", "1000000000"], "--joints"),
        (["--joints", "1", *FAR_AWAY], "--inertia"),
        (["--joints", "2", "--mass", "1,2,3"], "mass"),
        (["--joints", "1", "--mass", "1", "--center-of-mass", "1", "--inertia", "x"], "--inertia is 'x'"),
        (["--joints", "1", "--mass", "1"], "required|give it"),
    ],
)
def test_a_bad_or_missing_value_is_reported_in_one_line_and_nothing_is_written(
    words_of_option: list[str], what: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch
) -> None:
    monkeypatch.setattr("sys.stdin.isatty", lambda: False, raising=False)
    assert main(["model", "new", *words_of_option, "--out", str(tmp_path / "model.yaml")]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert not list(tmp_path.iterdir())
