"""Which files viewers get."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.bridge.foxglove.bridge import read_asset
from gazelle.workspace import Workspace


def write_package(root: Path) -> Path:
    """A package with a mesh, beside a file that is nobody's business."""
    folder = root / "my_arm"
    (folder / "meshes").mkdir(parents=True)
    (folder / "package.xml").write_text(
        '<package format="2"><name>my_arm</name><version>0.0.0</version>'
        "<description>an arm</description><maintainer email='a@b.c'>a</maintainer>"
        "<license>MIT</license></package>"
    )
    (folder / "meshes" / "arm.stl").write_bytes(b"solid arm")
    (folder / "secret.txt").write_text("secret")
    (root / "other.png").write_bytes(b"outside")
    return folder


def test_meshes_of_packages_are_read(tmp_path: Path) -> None:
    write_package(tmp_path)
    workspace = Workspace.discover(environ={}, extra=[tmp_path])
    assert read_asset(workspace, "package://my_arm/meshes/arm.stl") == b"solid arm"
    assert read_asset(workspace, "package://my_arm/meshes/%61rm.stl") == b"solid arm"


@pytest.mark.parametrize(
    "uri",
    [
        "package://my_arm/secret.txt",
        "package://my_arm/package.xml",
        "package://my_arm/meshes",
        "package://my_arm/../other.png",
        "package://my_arm/%2e%2e/other.png",
        "package://my_arm/meshes/../../other.png",
        "package://my_arm/..%5cother.png",
        "package://my_arm/{outside}",
        "package:///my_arm/{outside}",
        "file://{outside}",
        "{outside}",
        "model://{outside}",
        "model://../other.png",
        "package://no_such/arm.stl",
        # No file and no folder can have such a name.
        f"package://my_arm/{'n' * 300}/arm.stl",
        f"model://{'n' * 300}/arm.stl",
        "http://example.org/arm.stl",
        "",
    ],
)
def test_nothing_else_is_read(tmp_path: Path, uri: str) -> None:
    write_package(tmp_path)
    workspace = Workspace.discover(environ={}, extra=[tmp_path])
    assert read_asset(workspace, uri.format(outside=tmp_path / "other.png")) is None
