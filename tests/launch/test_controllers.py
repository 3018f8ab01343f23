"""Controllers of a launch: they start before the first step, and every run is the same."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
MIRA_CONTROLLERS = (
    "roll_joint_position_controller pitch_joint_position_controller "
    "yaw_joint_position_controller joint_state_controller"
)
LAUNCH = f"""
<launch>
  <param name="robot_description"
         command="cat '$(find urdf_exam)/urdf/mira_gazebo_controller.urdf'"/>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="gui" value="false"/>
  </include>
  <rosparam file="$(find urdf_exam)/config/mira_control.yaml" command="load"/>
  <!-- The controllers come first in the file: the model is spawned before them all the same. -->
  <node name="controllers" pkg="controller_manager" type="spawner" ns="/mira" output="screen"
        args="{MIRA_CONTROLLERS}"/>
  <node name="model" pkg="gazebo_ros" type="spawn_model" output="screen"
        args="-urdf -param robot_description -model mira -z 0.045"/>
</launch>
"""


def _hash(launched: Any) -> str:
    line = launched.wait_for_line("state hash")
    launched.wait()
    return re.findall(r"hash (\w+) at", line)[0]


@pytest.mark.tutorial
def test_spawners_of_a_paused_launch_finish_before_the_first_step(in_workspace):
    launched = in_workspace("roslaunch", "urdf_exam", "mira_spawn_controller.launch")
    line = launched.wait_for_line("Started controllers: ")
    assert line.endswith(", ".join(MIRA_CONTROLLERS.split()))
    assert ", 0.000000]" in line
    launched.call("/gazebo/unpause_physics", "std_srvs/Empty")
    states = launched.messages({"/mira/joint_states": 60})["/mira/joint_states"]
    assert max(abs(angle) for message in states for angle in message.position) < 0.02
    launched.publish("/mira/roll_joint_position_controller/command", "std_msgs/Float64", data=0.1)

    def position() -> float:
        message = launched.messages({"/mira/joint_states": 1})["/mira/joint_states"][0]
        return float(dict(zip(message.name, message.position, strict=True))["roll_joint"])

    assert launched.eventually(lambda: position() > 0.09)


@pytest.mark.tutorial
def test_lockstep_launches_with_controllers_have_one_state(in_workspace, tmp_path, next_port):
    file = tmp_path / "mira.launch"
    file.write_text(LAUNCH)
    hashes = set()
    for _ in range(2):
        words = ("roslaunch", "--lockstep", "--iters", "400", str(file))
        launched = in_workspace(*words, port=next_port())
        started = launched.wait_for_line("Started controllers: ")
        assert ", 0.000000]" in started
        hashes.add(_hash(launched))
    assert len(hashes) == 1


def test_time_goes_on_for_a_spawner_without_a_manager(gazelle, tmp_path):
    file = tmp_path / "none.launch"
    file.write_text(
        """
        <launch>
          <include file="$(find gazebo_ros)/launch/empty_world.launch">
            <arg name="gui" value="false"/>
          </include>
          <node name="controllers" pkg="controller_manager" type="spawner" output="screen"
                args="--timeout 0.5 nobody"/>
        </launch>
        """
    )
    # Without an end: the simulator does not wait until the spawner has said it.
    launched = gazelle("roslaunch", "--lockstep", str(file))
    launched.wait_for_line("there is no controller manager at all")
    clock = [
        (one.clock.sec, one.clock.nanosec) for one in launched.messages({"/clock": 2})["/clock"]
    ]
    assert clock[0] < clock[1]


def test_a_spawner_that_is_killed_unloads_its_controllers(gazelle):
    launched = gazelle("roslaunch", "tandem_controller", "robot.launch",
                       cwd=EXAMPLES / "pr2_style_ws")  # fmt: skip
    launched.wait_for_line("Started controllers: tandem_controller")
    launched.graph.kill_node("/spawn_controller")
    launched.wait_for_line("Succeeded in unloading tandem_controller")
