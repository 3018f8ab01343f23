"""Making and building workspaces as the documents do, typed into a shell (rows L1 and L2)."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.patience import stretched
from tests.tutorial.terminals import Terminal

_NODE = """import rclpy
from rclpy.node import Node
from ament_index_python.packages import get_package_share_directory
def main():
    rclpy.init()
    Node('walker').get_logger().info('share ' + get_package_share_directory('bot'))
    rclpy.shutdown()
"""


def _typed(script: str, cwd: Path, port: int) -> str:
    """Run lines in a fresh bash that has Gazelle's commands; every failure fails the test."""
    names = ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "PYTHONPATH")
    environ = {key: value for key, value in os.environ.items() if key not in names}
    environ |= {"GAZELLE_PORT": str(port), "GAZELLE": f"{sys.executable} -m gazelle.cli"}
    text = f'set -e\neval "$($GAZELLE env)"\n{script}'
    done = subprocess.run(
        ["bash", "-c", text], cwd=cwd, env=environ, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True, check=False, timeout=stretched(),
    )  # fmt: skip
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.mark.tutorial
def test_luck_package_is_made_built_and_found(tmp_path: Path, free_port: int) -> None:
    script = """
mkdir -p luck_ws/src
cd luck_ws/src
ros2 pkg create luck_gazebo --build-type ament_python \\
    --dependencies gazebo_ros gazebo_ros2_control controller_manager
cd ..
colcon build --symlink-install
source install/setup.bash
cd /
ros2 pkg prefix luck_gazebo
ros2 pkg executables luck_gazebo
"""
    printed = _typed(script, tmp_path, free_port)
    assert "dependencies: ['gazebo_ros', 'gazebo_ros2_control', 'controller_manager']" in printed
    assert "Summary: 1 package finished [" in printed
    assert printed.splitlines()[-1] == str(tmp_path / "luck_ws/install/luck_gazebo")


@pytest.mark.tutorial
def test_a_new_node_runs_from_the_sourced_workspace(tmp_path: Path, free_port: int) -> None:
    (tmp_path / "walk.py").write_text(_NODE, encoding="utf-8")
    script = """
ros2 pkg create bot --build-type ament_python --node-name walk --destination-directory src
cp walk.py src/bot/bot/walk.py
colcon build
source install/setup.bash
rm -r src
cd /
ros2 run bot walk
"""
    printed = _typed(script, tmp_path, free_port)
    assert f"[walker]: share {tmp_path / 'install/bot/share/bot'}" in printed


@pytest.mark.tutorial
def test_a_catkin_workspace_is_begun_empty(tmp_path: Path, free_port: int) -> None:
    script = """
mkdir src
catkin_make
cd src
catkin_create_pkg slam_robot rospy std_msgs
mkdir -p slam_robot/scripts
printf '#!/usr/bin/env python3\\nprint("hello")\\n' > slam_robot/scripts/hello.py
chmod +x slam_robot/scripts/hello.py
cd .. && catkin_make
source devel/setup.bash
cd /
rospack find slam_robot
rosrun slam_robot hello.py
"""
    printed = _typed(script, tmp_path, free_port)
    assert printed.count("-- Generating done") == 2
    assert printed.splitlines()[-2:] == [str(tmp_path / "src/slam_robot"), "hello"]


@pytest.mark.tutorial
def test_luck_workspace_launches_are_found_after_sourcing(
    workspaces_dir: Path, tmp_path: Path, free_port: int
) -> None:
    shutil.copytree(workspaces_dir / "ros2_ws/src", tmp_path / "luck_ws/src")
    script = """
cd luck_ws
colcon build --symlink-install
cd /
source ~/luck_ws/install/setup.bash 2>/dev/null
xacro $(rospack find luck_robot)/config/luck_description.urdf.xacro > /dev/null && echo expanded
"""
    printed = _typed(f"export HOME={tmp_path}\n{script}", tmp_path, free_port)
    assert printed.splitlines()[-1] == "expanded"


@pytest.mark.tutorial
def test_turtlebot3_is_built_with_catkin_make(
    workspaces_dir: Path, tmp_path: Path, free_port: int
) -> None:
    shutil.copytree(workspaces_dir / "turtlebot3_ws/src", tmp_path / "catkin_ws/src")
    script = f"""
export HOME={tmp_path}
cd ~/catkin_ws && catkin_make
source devel/setup.bash
cd /
rospack find turtlebot3_fake
"""
    printed = _typed(script, tmp_path, free_port)
    place = tmp_path / "catkin_ws/src/turtlebot3_simulations/turtlebot3_fake"
    assert printed.splitlines()[-1] == str(place)


@pytest.mark.tutorial
def test_luck_workspace_is_built_and_found_by_the_next_terminal(
    open_terminal: Callable[[], Terminal], tmp_path: Path
) -> None:
    first = open_terminal()
    first.run("mkdir -p ~/luck_ws/src && cd ~/luck_ws/src")
    made = first.run(
        "ros2 pkg create luck_gazebo --build-type ament_python --dependencies gazebo_ros "
        "gazebo_ros2_control controller_manager"
    )
    assert "going to create a new package\npackage name: luck_gazebo\n" in made
    for line in ("cd luck_gazebo", "mkdir -p config", "touch config/controllers.yaml", "cd ../.."):
        first.run(line)
    assert "Summary: 1 package finished [" in first.run("colcon build --symlink-install")
    told = first.run("rosdep install --from-paths src --ignore-src -r -y")
    assert told.endswith("#All required rosdeps installed successfully\n")
    second = open_terminal()
    second.run("source ~/luck_ws/install/setup.bash 2>/dev/null")
    prefix = second.run("ros2 pkg prefix luck_gazebo")
    assert prefix == f"{tmp_path / 'luck_ws/install/luck_gazebo'}\n"
