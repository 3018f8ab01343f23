"""An arm with a two-fingered hand, and an SRDF read against it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import pytest

from gazelle.description.model import Link, Model
from gazelle.description.read_context import ReadContext
from gazelle.description.srdf import Srdf, load_srdf
from gazelle.description.urdf_reader import read_urdf
from gazelle.diagnostics import Diagnostics

_JOINT = (
    '<joint name="{name}" type="{type}"><parent link="{parent}"/><child link="{child}"/>'
    '<axis xyz="0 0 1"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>'
)
_JOINTS = (
    ("shoulder", "revolute", "base", "upper"),
    ("elbow", "revolute", "upper", "lower"),
    ("wrist", "continuous", "lower", "tool"),
    ("mount", "fixed", "tool", "hand"),
    ("left", "prismatic", "hand", "finger_left"),
    ("right", "prismatic", "hand", "finger_right"),
)
_LINKS = ("base", *(child for _, _, _, child in _JOINTS))


class Read(NamedTuple):
    """What was read, and what was said about it."""

    srdf: Srdf | None
    diagnostics: Diagnostics

    @property
    def content(self) -> Srdf:
        assert self.srdf is not None, [str(item) for item in self.diagnostics]
        return self.srdf

    @property
    def codes(self) -> list[str]:
        return [item.code for item in self.diagnostics]

    def text(self, code: str) -> str:
        found = self.diagnostics.by_code(code)
        assert found, f"{code} not among {self.codes}"
        return "\n".join(str(item) for item in found)


Reader = Callable[[str], Read]


@pytest.fixture(scope="session")
def arm() -> Model:
    """The robot the SRDFs are about; one of its links hangs on no joint."""
    links = "".join(f'<link name="{name}"/>' for name in _LINKS)
    joints = "".join(
        _JOINT.format(name=name, type=kind, parent=parent, child=child)
        for name, kind, parent, child in _JOINTS
    )
    text = f'<robot name="arm">{links}{joints}</robot>'
    model = read_urdf(text, context=ReadContext(None, Diagnostics(), "arm.urdf"))
    assert model is not None
    return replace(model, links=(*model.links, Link("alone")))


@pytest.fixture
def read(arm: Model, tmp_path: Path) -> Reader:
    """Read the inside of a <robot>, from a file."""

    def reader(inside: str) -> Read:
        file = tmp_path / "arm.srdf"
        file.write_text(f'<robot name="arm">\n{inside}\n</robot>\n', encoding="utf-8")
        diagnostics = Diagnostics()
        return Read(
            load_srdf(file, robot=arm, workspace=None, diagnostics=diagnostics), diagnostics
        )

    return reader
