from __future__ import annotations

import os
import re
import subprocess
import sys
from xml.etree import ElementTree

import pytest
from tests.patience import stretched

from gazelle.workspace.environment_paths import BUILTIN

# What launch files written for gazebo_ros 2.9 may set.
EMPTY_WORLD_ARGS = {
    "paused": "false",
    "use_sim_time": "true",
    "extra_gazebo_args": "",
    "gui": "true",
    "recording": "false",
    "headless": "false",
    "debug": "false",
    "physics": "ode",
    "verbose": "false",
    "output": "screen",
    "world_name": "worlds/empty.world",
    "respawn_gazebo": "false",
    "use_clock_frequency": "false",
    "pub_clock_frequency": "100",
    "enable_ros_network": "true",
    "server_required": "false",
    "gui_required": "false",
}


def test_empty_world_takes_every_argument_of_the_original(discover):
    path = discover().package("gazebo_ros").find_file("launch/empty_world.launch")
    root = ElementTree.parse(path).getroot()
    found = {
        arg.get("name"): arg.get("default")
        for arg in root.iter("arg")
        if arg.get("default") is not None
    }
    assert found == EMPTY_WORLD_ARGS
    server, client = root.iter("node")
    assert (server.get("name"), server.get("type")) == ("gazebo", "gzserver")
    assert (client.get("type"), client.get("if")) == ("gzclient", "$(arg gui)")


ROS1_LAUNCHES = sorted(
    path for path in BUILTIN.rglob("*.launch") if "$(var " not in path.read_text(encoding="utf-8")
)


@pytest.mark.parametrize("path", ROS1_LAUNCHES, ids=lambda path: path.name)
def test_launch_files_refer_only_to_what_is_there(discover, path):
    workspace = discover()
    root = ElementTree.parse(path).getroot()
    known = set(EMPTY_WORLD_ARGS)
    for include in root.iter("include"):
        assert workspace.resolve(include.get("file")).path is not None
        for arg in include.iter("arg"):
            assert arg.get("name") in known
            if arg.get("name") == "world_name":
                assert workspace.world_file(arg.get("value")).path is not None
    for node in root.iter("node"):
        assert node.get("pkg") in workspace.packages


@pytest.mark.parametrize(
    "name",
    [
        "gazebo_worlds/launch/office_world.launch",
        "gazebo_worlds/launch/empty_world.launch",
        "gazebo/launch/empty_world.launch",
        "pr2_controller_manager/controller_manager.launch",
        "xacro/xacro",
        "xacro/xacro.py",
    ],
)
def test_names_of_old_launch_files_exist(discover, name):
    assert discover().resolve(f"package://{name}").path is not None


@pytest.mark.parametrize(
    "name",
    [
        "joy/launch/joy-launch.py",
        "teleop_twist_joy/config/xbox.config.yaml",
        "teleop_twist_joy/launch/teleop-launch.py",
        "teleop_twist_joy/launch/teleop.launch",
        "twist_mux/config/twist_mux_locks.yaml",
        "twist_mux/launch/twist_mux.launch",
        "twist_mux/launch/twist_mux_launch.py",
    ],
)
def test_files_that_robots_include_for_their_joysticks_exist(discover, name):
    assert discover().resolve(f"package://{name}").path is not None


@pytest.mark.parametrize(
    "path",
    sorted([*BUILTIN.rglob("*.world"), *BUILTIN.rglob("*.sdf")]),
    ids=lambda p: f"{p.parent.name}-{p.name}",
)
def test_worlds_and_models_include_only_builtin_models(discover, path):
    workspace = discover()
    text = path.read_text(encoding="utf-8")
    root = ElementTree.fromstring(text)
    assert root.tag == "sdf"
    for uri in re.findall(r"model://[^<]+", text):
        assert workspace.resolve(uri).path is not None
    names = [model.get("name") for model in root.iter("model")]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("name", ["xacro", "xacro.py"])
def test_the_xacro_command_of_launch_files_runs(discover, tmp_path, name):
    script = discover().package("xacro").find_file(name)
    assert os.access(script, os.X_OK)
    file = tmp_path / "a.xacro"
    file.write_text(
        '<robot xmlns:xacro="http://ros.org/wiki/xacro" name="${1 + 1}"><link name="a"/></robot>'
    )
    done = subprocess.run(
        [sys.executable, script, "--inorder", file],
        check=False,
        capture_output=True,
        text=True,
        timeout=stretched(),
        env={**os.environ, "XDG_CACHE_HOME": str(tmp_path)},
    )
    said = "xacro: in-order processing became default in ROS Melodic. You can drop the option.\n"
    assert (done.returncode, done.stderr) == (0, said)
    assert '<robot name="2">' in done.stdout


def test_every_model_has_a_config_that_names_its_sdf():
    for folder in sorted((BUILTIN / "models").iterdir()):
        root = ElementTree.parse(folder / "model.config").getroot()
        assert (folder / root.findtext("sdf")).is_file()


@pytest.mark.parametrize(
    "name",
    ["force_torque_sensor_controller", "imu_sensor_controller", "joint_state_controller"],
)
def test_broadcasters_bring_their_parameters_and_their_launch_file(discover, name):
    package = discover().package(name)
    for file in (f"{name}.yaml", f"{name}.launch"):
        assert name in (package.path / file).read_text("utf-8")
