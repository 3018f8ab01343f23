"""A robot from a few lines of URDF, with what was reported about it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from gazelle.description.model import Model
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader import read_urdf
from gazelle.diagnostics import Diagnostics

INERTIAL = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
)


class Read(NamedTuple):
    """A model and the findings about it."""

    model: Model | None
    diagnostics: Diagnostics

    @property
    def robot(self) -> Model:
        assert self.model is not None, [str(item) for item in self.diagnostics]
        return self.model

    @property
    def codes(self) -> list[str]:
        return [item.code for item in self.diagnostics]

    def message(self, code: str) -> str:
        found = self.diagnostics.by_code(code)
        assert found, f"{code} not among {self.codes}"
        return str(found[0])


Reader = Callable[..., Read]


@pytest.fixture
def read() -> Reader:
    """Read a whole document."""

    def reader(text: str, base_dir: Path | None = None) -> Read:
        diagnostics = Diagnostics()
        context = ReadContext(None, diagnostics, "robot.urdf", base_dir)
        return Read(read_urdf(text, context=context), diagnostics)

    return reader


@pytest.fixture
def read_link(read: Reader) -> Reader:
    """Read a robot of one link 'a' with mass, `inside` in it and `after` behind it."""

    def reader(inside: str = "", after: str = "", base_dir: Path | None = None) -> Read:
        text = f'<robot name="r"><link name="a">{INERTIAL}{inside}</link>{after}</robot>'
        return read(text, base_dir)

    return reader


@pytest.fixture
def read_joint(read: Reader) -> Reader:
    """Read a robot of links a and b with mass and joint 'j' between them."""

    def reader(inside: str = "", kind: str = "continuous", after: str = "") -> Read:
        links = "".join(f'<link name="{name}">{INERTIAL}</link>' for name in "ab")
        ends = '<parent link="a"/><child link="b"/>'
        joint = f'<joint name="j" type="{kind}">{ends}{inside}</joint>'
        return read(f'<robot name="r">{links}{joint}{after}</robot>')

    return reader
