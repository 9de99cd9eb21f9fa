"""A run of two joints and two cables as cells of a table."""

from pathlib import Path

import numpy as np

ROWS = 120
T = np.arange(ROWS) / 120
ANGLES = np.stack([0.3 * np.cos(6 * T), 0.2 * np.cos(6 * T + 1)], axis=1)
RATES = np.stack([-1.8 * np.sin(6 * T), -1.2 * np.sin(6 * T + 1)], axis=1)
PULL = np.stack([4 - 3 * np.sin(5 * T), 4 + 3 * np.sin(5 * T)], axis=1)

type Cells = dict[str, list[str]]


def cells(**blocks: np.ndarray) -> Cells:
    """Columns as text, `t_s` first."""
    columns = {"t_s": T} | {name: np.asarray(values) for name, values in blocks.items()}
    return {name: [repr(float(value)) for value in values] for name, values in columns.items()}


def sway(unit: str = "rad") -> Cells:
    """Two joints that sway, their rates, and two cables."""
    factor = 1.0 if unit == "rad" else 180 / np.pi
    return cells(
        **{f"q{j + 1}_{unit}": factor * ANGLES[:, j] for j in range(2)},
        **{f"dq{j + 1}_{unit}_s": factor * RATES[:, j] for j in range(2)},
        **{f"u{j + 1}_N": PULL[:, j] for j in range(2)},
    )


def text_of(table: Cells) -> str:
    return "\n".join([",".join(table), *(",".join(row) for row in zip(*table.values(), strict=True)), ""])


def write(folder: Path, table: Cells | str, encoding: str = "utf-8") -> Path:
    path = folder / "swing 7.csv"
    path.write_text(table if isinstance(table, str) else text_of(table), encoding=encoding)
    return path
