"""Small MoveIt config packages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.description.moveit import MoveItConfig, read_moveit_config
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace

_INERTIAL = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
)
URDF = (
    f'<robot name="arm"><link name="base">{_INERTIAL}</link><link name="tool">{_INERTIAL}</link>'
    '<joint name="elbow" type="revolute">'
    '<parent link="base"/><child link="tool"/><axis xyz="0 0 1"/>'
    '<limit lower="-1" upper="2" effort="1" velocity="1"/></joint></robot>'
)
SRDF = '<robot name="arm"><group name="arm"><joint name="elbow"/></group></robot>'
PACKAGE = (
    '<package format="3"><name>{}</name><version>0.0.0</version><description>x</description>'
    '<maintainer email="a@b.example">a</maintainer><license>x</license></package>'
)


class Package:
    """A package of a few files, read as often as a test wants."""

    def __init__(self, folder: Path, workspace: Path) -> None:
        self.folder = folder
        self.diagnostics = Diagnostics()
        self._workspace = workspace

    def write(self, name: str, text: str) -> Package:
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return self

    def read(self, **options: str | dict[str, str]) -> MoveItConfig:
        workspace = Workspace.discover(environ={}, cwd=self._workspace, extra=[self._workspace])
        found = read_moveit_config(
            self.folder,
            workspace=workspace,
            diagnostics=self.diagnostics,
            **options,  # type: ignore[arg-type]
        )
        assert found is not None, self.said
        return found

    @property
    def said(self) -> str:
        return "\n".join(str(item) for item in self.diagnostics)


@pytest.fixture
def package(tmp_path: Path) -> Callable[..., Package]:
    """Makes a package with a robot, as ROS 2's Setup Assistant writes it."""

    def make(name: str = "arm_moveit_config", *, robot: bool = True) -> Package:
        made = Package(tmp_path / "src" / name, tmp_path)
        made.write("package.xml", PACKAGE.format(name))
        if robot:
            made.write("config/arm.urdf.xacro", URDF).write("config/arm.srdf", SRDF)
        return made

    return make
