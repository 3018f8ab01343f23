"""Robots of a few lines as files, read and judged."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from gazelle.description.checks.inertia import (
    InertiaFinding,
    check_inertia,
    check_mass_ratios,
)
from gazelle.description.checks.source_elements import CheckedSource, read_checked_source
from gazelle.description.checks.written_inertials import LinkRecord, joint_records_of, records_of
from gazelle.diagnostics import Diagnostic, Diagnostics

BOX_TENSOR = (0.13, 0.1, 0.05)
"""Moments of a box of 12 kg and 0.1 × 0.2 × 0.3 m."""


class Judged(NamedTuple):
    """A file, what was read from it and what was found."""

    file: Path
    source: CheckedSource
    records: tuple[LinkRecord, ...]
    findings: tuple[InertiaFinding, ...]
    ratios: Diagnostics
    read: Diagnostics

    @property
    def codes(self) -> list[str]:
        """Codes of all findings of the checks."""
        return [item.diagnostic.code for item in self.findings] + [i.code for i in self.ratios]

    @property
    def only(self) -> Diagnostic:
        """The one finding there is."""
        assert len(self.codes) == 1, self.codes
        return self.findings[0].diagnostic if self.findings else next(iter(self.ratios))

    @property
    def place(self) -> tuple[str, int, int]:
        """File name, line and column of the one finding."""
        assert self.only.span is not None
        span = self.only.span
        return Path(span.file).name, span.line, span.column


Judge = Callable[..., Judged]


def judged(file: Path, density_kg_m3: float | None = None) -> Judged:
    """Read a file and judge it."""
    read = Diagnostics()
    source = read_checked_source(file, workspace=None, diagnostics=read)
    records = records_of(source.models, source.find_tag, read)
    findings = check_inertia(records, density_kg_m3=density_kg_m3)
    ratios = check_mass_ratios(joint_records_of(source.models, source.find_tag))
    return Judged(file, source, records, findings, ratios, read)


@pytest.fixture
def judge(tmp_path: Path) -> Judge:
    """Write a text to ``robot.urdf`` or another name and judge it."""

    def run(text: str, name: str = "robot.urdf", density_kg_m3: float | None = None) -> Judged:
        file = tmp_path / name
        file.write_text(text, encoding="utf-8")
        return judged(file, density_kg_m3)

    return run


def inertial(
    mass: float | str = 12,
    moments: tuple[float, float, float] = BOX_TENSOR,
    xyz: str = "0 0 0",
    products: str = 'ixy="0" ixz="0" iyz="0"',
) -> str:
    """URDF's block; by default that of the box of `link`."""
    xx, yy, zz = moments
    return (
        f'<inertial>\n      <origin xyz="{xyz}"/>\n      <mass value="{mass}"/>\n'
        f'      <inertia ixx="{xx}" iyy="{yy}" izz="{zz}" {products}/>\n    </inertial>'
    )


SHAPE = '<collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision>'


def link(inside: str, shape: str = SHAPE, name: str = "a") -> str:
    """A link on lines 2 to 9 of `robot`: <inertial> on 3, <mass> on 5, <inertia> on 6."""
    return f'  <link name="{name}">\n    {inside}\n    {shape}\n  </link>\n'


def robot(*parts: str) -> str:
    """A robot of links and joints."""
    return '<robot name="r">\n' + "".join(parts) + "</robot>\n"


@pytest.fixture
def stl(tmp_path: Path) -> Callable[[str, np.ndarray], Path]:
    """Write triangles, (n, 3, 3) metres, to a binary STL beside the robot."""

    def write(name: str, triangles: np.ndarray) -> Path:
        rows = np.zeros(len(triangles), [("n", "<f4", 3), ("v", "<f4", (3, 3)), ("x", "<u2")])
        rows["v"] = triangles
        file = tmp_path / name
        file.write_bytes(bytes(80) + np.uint32(len(triangles)).tobytes() + rows.tobytes())
        return file

    return write
