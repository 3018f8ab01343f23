"""Every launch file of the published TurtleBot3 packages: what runs each of its nodes."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.launch.node_commands import find_executable
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.workspace import Workspace

pytestmark = pytest.mark.tutorial

# Nodes of real hardware, and compiled ones that explore; a notice says what is missing.
_NOTICED = {
    ("frontier_exploration", "explore_client"),
    ("frontier_exploration", "explore_server"),
    ("rosserial_python", "serial_node.py"),
    ("hls_lfcd_lds_driver", "hlds_laser_publisher"),
    ("turtlebot3_bringup", "turtlebot3_diagnostics"),
    ("nodelet", "nodelet"),
    ("realsense_camera", "r200_nodelet_default"),
}


def _files(workspaces_dir: Path) -> list[Path]:
    return sorted((workspaces_dir / "turtlebot3_ws" / "src").rglob("*.launch"))


@pytest.mark.parametrize("model", ["burger", "waffle", "waffle_pi"])
def test_every_launch_file_finds_all_its_nodes(workspaces_dir: Path, model: str) -> None:
    folder = workspaces_dir / "turtlebot3_ws"
    environ = {"ROS_PACKAGE_PATH": str(folder / "src"), "TURTLEBOT3_MODEL": model}
    workspace = Workspace.discover(environ=environ, cwd=folder)
    missing: dict[tuple[str, str], str] = {}
    files = _files(workspaces_dir)
    assert len(files) >= 20
    for path in files:
        diagnostics = Diagnostics()
        config = load_launch_files(
            [path], {}, workspace=workspace, diagnostics=diagnostics, environ=environ
        )
        for node in config.nodes:
            found = Diagnostics()
            if find_executable(node.package, node.type, workspace=workspace, diagnostics=found):
                continue
            missing[node.package, node.type] = "\n".join(map(str, found))
    assert set(missing) <= _NOTICED, missing
    for (package, type_name), said in missing.items():
        assert package in said, (package, type_name, said)
