"""What launch files ask for: evaluation of every tag, and mistakes told with file, line and tag."""

import os
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from ros2_standin.errors import UserError
from ros2_standin.launch.interpreter import Interpreter
from ros2_standin.launch.parameter_values import ParameterFiles, typed
from ros2_standin.launch.processes import LogLine, ProcessSpec
from ros2_standin.launch.xml_tree import Element


@pytest.fixture
def evaluate(tmp_path: Path, program, ros2, monkeypatch: pytest.MonkeyPatch):
    """Evaluate the tags of a launch file; the package ``demo`` has the executable ``talk``."""
    program("talk", "")
    monkeypatch.setenv("AMENT_PREFIX_PATH", ros2.environment["AMENT_PREFIX_PATH"])
    with ParameterFiles() as files:

        def run(tags: str, **given: str) -> list[ProcessSpec | LogLine]:
            file = tmp_path / "test.launch.xml"
            file.write_text(f"<launch>\n{tags}\n</launch>")
            interpreter = Interpreter(files, given)
            interpreter.run(file)
            return interpreter.steps

        yield run


def texts(steps: list[ProcessSpec | LogLine]) -> list[str]:
    return [step.text for step in steps]


def ros_args(process: ProcessSpec) -> list[str]:
    return process.command[process.command.index("--ros-args") + 1 :]


def parameters(process: ProcessSpec) -> list[dict]:
    words = process.command
    return [yaml.safe_load(Path(words[i + 1]).read_text()) for i, word in enumerate(words) if word == "--params-file"]


def test_node(evaluate, overlay: Path, tmp_path: Path) -> None:
    given = tmp_path / "given.yaml"
    given.write_text("{}")
    (node,) = evaluate(f"""
        <node pkg="demo" exec="talk" name="t" namespace="arm" args="-x '$(dirname) y' $(dirname)"
              ros_args="--log-level debug"
              output="screen" respawn="true" respawn_delay="0.5" on_exit="shutdown">
          <param from="{given}"/>
          <param name="gain" value="2.5"/>
          <param name="arm"><param name="n" value="3"/></param>
          <remap from="in" to="out"/>
          <env name="A" value="b"/>
        </node>""")
    assert node.command[:4] == [str(overlay / "talk"), "-x", f"{tmp_path} y", str(tmp_path)]
    words = ros_args(node)
    assert words[:6] == ["--log-level", "debug", "-r", "__node:=t", "-r", "__ns:=/arm"]
    assert words[6:8] == ["--params-file", str(given)]
    assert words[-2:] == ["-r", "in:=out"]
    assert parameters(node)[1] == {"/arm/t": {"ros__parameters": {"gain": 2.5, "arm": {"n": 3}}}}
    assert node.environment["A"] == "b"
    assert (node.name, node.stdout_to_screen, node.respawn, node.respawn_delay, node.ends_launch) == (
        "talk", True, True, 0.5, True,
    )  # fmt: skip


def test_parameters_of_a_node_without_name_are_for_any(evaluate) -> None:
    (node,) = evaluate('<node pkg="demo" exec="talk"><param name="s" value="1" type="str"/></node>')
    assert parameters(node) == [{"/**": {"ros__parameters": {"s": "1"}}}]


def test_groups_keep_their_changes_to_themselves(evaluate) -> None:
    first, second, third = evaluate("""
        <let name="x" value="outside"/>
        <group>
          <push_ros_namespace namespace="a"/><set_remap from="p" to="q"/><set_env name="E" value="1"/>
          <set_parameter name="use_sim_time" value="true"/><let name="x" value="inside"/>
          <group><push-ros-namespace namespace="/b"/><node pkg="demo" exec="talk" namespace="$(var x)"/></group>
          <node pkg="demo" exec="talk"/>
        </group>
        <node pkg="demo" exec="talk" namespace="$(var x)"/>""")
    assert ros_args(first)[:2] == ["-r", "__ns:=/b/inside"]
    assert ros_args(second)[:2] == ["-r", "__ns:=/a"]
    assert ros_args(second)[-2:] == ["-r", "p:=q"]
    assert parameters(second) == [{"/**": {"ros__parameters": {"use_sim_time": True}}}]
    assert second.environment["E"] == "1"
    assert ros_args(third) == ["-r", "__ns:=/outside"]
    assert "E" not in third.environment


def test_an_include_sees_and_leaves_variables_as_the_stock_launch_does(evaluate, tmp_path: Path) -> None:
    (tmp_path / "part.launch.xml").write_text(
        '<launch><arg name="x" default="d"/><arg name="y" default="e"/>'
        '<log message="$(var x)$(var y)$(filename)"/></launch>'
    )
    part = tmp_path / "part.launch.xml"
    include = '<include file="$(dirname)/part.launch.xml">{}</include>'
    steps = evaluate(include.format('<arg name="x" value="1"/>') + include.format("") + '<log message="$(filename)"/>')
    assert texts(steps) == [f"1e{part}", f"1e{part}", str(tmp_path / "test.launch.xml")]


def test_arguments(evaluate) -> None:
    choices = '<choice value="2"/><choice value="3"/>'
    tags = f'<arg name="n" default="$(eval \'1 + 1\')">{choices}</arg><log message="$(var n)"/>'
    assert texts(evaluate(tags)) == ["2"]
    assert texts(evaluate(tags, n="3")) == ["3"]
    with pytest.raises(UserError, match="'n' is '4'; allowed: 2, 3"):
        evaluate(tags, n="4")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("$(env HOME)", os.environ.get("HOME")),
        ("$(env NOT_SET_AT_ALL 'x y')", "x y"),
        ("$(command 'printf %s &quot;a b&quot;')", "a b"),
        ("$(if $(equals 1 1.0) yes no)", "yes"),
        ("$(and true $(not $(or false 0)))", "true"),
        ("$(not-equals a b)", "true"),
        ("$(eval '$(equals a a) and &quot;$(var v)&quot; == &quot;w&quot;')", "True"),
        (r"\$(var v)", "$(var v)"),
    ],
)
def test_substitutions(evaluate, text: str, value: str) -> None:
    assert texts(evaluate(f'<let name="v" value="w"/><log message="{text}"/>')) == [value]


def test_what_a_command_warns_of_is_passed_on(evaluate, capsys: pytest.CaptureFixture[str]) -> None:
    tags = "<log message=\"$(command 'sh -c &quot;echo a; echo b >&amp;2&quot;' {})\"/>"
    assert [text.strip() for text in texts(evaluate(tags.format("warn")))] == ["a"]
    assert capsys.readouterr().err == "b\n"
    with pytest.raises(UserError, match="failed"):
        evaluate(tags.format(""))


def test_packages(evaluate, overlay: Path) -> None:
    text = "$(find-pkg-prefix demo);$(find-pkg-share demo);$(exec-in-pkg talk demo);$(find-exec sh)"
    prefix, share, executable, shell = texts(evaluate(f'<log message="{text}"/>'))[0].split(";")
    assert (prefix, share) == (str(overlay.parents[1]), str(overlay.parents[1] / "share" / "demo"))
    assert executable == str(overlay / "talk")
    assert Path(shell).is_file()


def test_anonymous_names_differ(evaluate) -> None:
    first, again, other = texts(evaluate("".join(f'<log message="$(anon {name})"/>' for name in ("a", "a", "b"))))
    assert first == again
    assert first != other


def test_conditions(evaluate) -> None:
    tags = '<log message="a" if="$(var c)"/><log message="b" unless="$(var c)"/>'
    assert texts(evaluate(tags, c="true")) == ["a"]
    assert texts(evaluate(tags, c="0")) == ["b"]


@pytest.mark.parametrize(
    ("tags", "problem"),
    [
        ("<nod/>", "2: <nod> within <launch>"),
        ('<node pkg="demo" exec="talk" nam="x"/>', "2: <node> has the attribute 'nam'"),
        ('<node exec="talk"/>', "2: <node> lacks the attribute 'pkg'"),
        ('<node pkg="demo" exec="nix"/>', "2: <node> No executable found.*talk"),
        ('<node pkg="nix" exec="nix"/>', "2: <node> Package 'nix' not found"),
        ('<node pkg="demo" exec="talk">\n<params name="a" value="1"/></node>', "3: <params> within <node>"),
        ('<node pkg="demo" exec="talk"><param from="/nix.yaml"/></node>', "the file '/nix.yaml', which does not exist"),
        ('<node pkg="demo" exec="talk"><param name="a" value="[1, b]"/></node>', r"the value '\[1, b\]'"),
        ('<node pkg="demo" exec="talk" output="loud"/>', "output='loud'; allowed: screen"),
        ('<node pkg="demo" exec="talk" on_exit="cry"/>', "on_exit='cry'; allowed: shutdown"),
        ('<arg name="n" description="how many"/>', "missing required argument 'n'.*how many.*given: none"),
        ('<log message="$(var nix)"/>', r"2: <log> has '\$\(var nix\)'.*no such variable"),
        ('<log message="$(optenv A b)"/>', r"\$\(env NAME default\)"),
        ('<log message="$(var a b c)"/>', "3 arguments; allowed: 1 to 2"),
        ('<log message="$(command false)"/>', "command 'false' failed"),
        ('<log message="a" if="perhaps"/>', "'perhaps'; allowed: true, false, 1, 0"),
        ('<log message="a" if="1" unless="1"/>', "both 'if' and 'unless'"),
        ('<include file="$(dirname)/test.launch.xml"/>', "circle"),
        ('<include file="$(dirname)/nix.launch.xml"/>', "nix.launch.xml: No such file"),
        ("<group>", "not XML: mismatched tag"),
        ("words", "2: .*'words'"),
    ],
)
def test_mistakes_name_their_place(evaluate, tags: str, problem: str) -> None:
    with pytest.raises(UserError, match=problem) as error:
        evaluate(tags)
    assert "test.launch.xml" in str(error.value)


@given(st.booleans() | st.integers() | st.floats(allow_nan=False) | st.lists(st.integers(), max_size=3))
def test_values_have_the_types_of_yaml(value: object) -> None:
    text = yaml.safe_dump(value).removesuffix("...\n").strip()
    found = typed(text, "yaml", Element("param", {}, Path("f"), 1))
    assert found == value
    assert type(found) is type(value)


@pytest.mark.parametrize(
    ("text", "kind", "value"), [("1", "float", 1.0), ("true", "str", "true"), ("[1]", "list_of_int", [1])]
)
def test_a_type_can_be_demanded(text: str, kind: str, value: object) -> None:
    found = typed(text, kind, Element("param", {}, Path("f"), 1))
    assert found == value
    assert type(found) is type(value)


@pytest.mark.parametrize(
    ("text", "kind"), [("a", "int"), ("1.5", "int"), ("1", "list_of_int"), ("{a: 1}", "yaml"), ("[", "yaml")]
)
def test_a_value_of_another_type_is_refused(text: str, kind: str) -> None:
    with pytest.raises(UserError, match="has the value"):
        typed(text, kind, Element("param", {}, Path("f"), 1))
