"""slam_toolbox's own launch files, which launch files of robots include."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from gazelle.launch.ros2 import LaunchContext
from gazelle.launch.ros2.launch_description_sources import PythonLaunchDescriptionSource
from gazelle.launch.ros2.launch_ros.node_executable import node_command
from gazelle.nodes.slam.parameters import SLAM_NODES
from gazelle.workspace.ament_index import get_package_share_directory


@pytest.mark.parametrize(
    "name", ["online_async", "online_sync", "offline", "lifelong", "localization"]
)
def test_launch_file_of_slam_toolbox(name: str, context: LaunchContext) -> None:
    share = Path(get_package_share_directory("slam_toolbox"))
    source = PythonLaunchDescriptionSource(str(share / "launch" / f"{name}_launch.py"))
    description = source.get_launch_description(context)
    arguments = {one.name: one for one in description.get_launch_arguments()}
    assert {"use_sim_time", "slam_params_file"} <= set(arguments)
    for one in arguments.values():
        one.execute(context)
    node = description.entities[-1]
    node._perform_substitutions(context)  # type: ignore[attr-defined]
    assert node.node_name == "<node_namespace_unspecified>/slam_toolbox"  # type: ignore[attr-defined]
    assert node_command(context, "slam_toolbox", node.node_executable) is not None  # type: ignore[attr-defined]
    file = Path(context.launch_configurations["slam_params_file"])
    values = yaml.safe_load(file.read_text())["slam_toolbox"]["ros__parameters"]
    known = {one.key for one in SLAM_NODES["slam_toolbox"].table.rows}
    assert set(values) <= known
    assert values["mode"] == ("localization" if name == "localization" else "mapping")
