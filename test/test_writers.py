"""Files are written by one writer, so that none is ever there in part."""

import ast
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("continuum", "continuum_description", "continuum_hw_imu", "continuum_manipulator", "trajectory_generator")
SOURCES = [
    path for folder in (*FOLDERS, "tools") for path in sorted((ROOT / folder).rglob("*.py")) if "test" not in path.parts
]

ELSEWHERE = {
    "continuum/continuum/whole_file.py": "the writer",
    "continuum/continuum/compiled_code.py": "an empty file that is locked, in a temporary folder",
    "continuum/continuum/output_files.py": "opened and left as it was",
    "continuum/continuum/dynamics/compiled/machine_code.py": "in a temporary folder, then renamed",
    "continuum_hw_imu/continuum_hw_imu/emulator/growing_file.py": "read while it grows",
    "tools/demo/bench/command.py": "a log of processes",
    "tools/benchmarks/discovery/result.py": "a line is added",
    "tools/benchmarks/discovery/next_experiment.py": "in a temporary folder; a line is added",
    "tools/benchmarks/link/processes.py": "a setting of the kernel",
    "tools/benchmarks/viewer/__main__.py": "in a temporary folder",
    "tools/demo/hidden_process.py": "a log of processes",
    "tools/demo/nodes.py": "a log of processes",
    "tools/demo/viewer.py": "a log of processes",
    "tools/docs/site/source.py": "in a folder that is made again",
    "tools/benchmarks/exams/urdf_payload.py": "in a temporary folder",
    "tools/benchmarks/fuzzing/guided.py": "in a temporary folder",
    "tools/ros2/ros2_standin/launch/launch_file.py": "in a temporary folder",
    "tools/ros2/ros2_standin/launch/screen.py": "a log of processes",
}
"""Where files are opened for writing all the same, and why."""

BEFORE_THE_WORKSPACE = "tools/setup/"
"""Runs where the writer is not installed yet."""

WRITERS = {"write_text", "write_bytes", "savefig", "imsave", "savetxt", "savez", "to_csv", "tofile"}


def writes(path: Path) -> Iterator[int]:
    """Lines that write a file."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.Call):
            continue
        name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
        words = [*node.args, *(keyword.value for keyword in node.keywords)]
        modes = [w.value for w in words if isinstance(w, ast.Constant) and isinstance(w.value, str)]
        opened = name == "open" and any(set(mode) <= set("rwxabt+") and set(mode) & set("wxa+") for mode in modes)
        if name in WRITERS or opened:
            yield node.lineno


def test_files_are_written_by_the_one_writer() -> None:
    writing = {str(path.relative_to(ROOT)) for path in SOURCES if any(writes(path))}
    assert {name for name in writing if not name.startswith(BEFORE_THE_WORKSPACE)} == {*ELSEWHERE}
