"""Controllers from Python: a description, parameters, goals; no graph and no launch file."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import gazelle
from gazelle.control.errors import ControllerError
from gazelle.errors import NotFoundError
from gazelle.interfaces import message_type

ROBOT = """
<robot name="arm">
  <link name="world"/>
  <link name="base_link">
    <inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <link name="lever">
    <inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="fixed" type="fixed"><parent link="world"/><child link="base_link"/></joint>
  <joint name="hinge" type="revolute">
    <parent link="base_link"/><child link="lever"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" effort="50" velocity="5"/>
  </joint>
  {control}
</robot>
"""
ROS1 = """
  <transmission name="t">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="hinge">
      <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
    </joint>
    <actuator name="m"><mechanicalReduction>1</mechanicalReduction></actuator>
  </transmission>
  <gazebo><plugin name="c" filename="libgazebo_ros_control.so">
    <robotNamespace>/arm</robotNamespace></plugin></gazebo>
"""
ROS2 = """
  <ros2_control name="system" type="system">
    <hardware><plugin>gazebo_ros2_control/GazeboSystem</plugin></hardware>
    <joint name="hinge">
      <command_interface name="position"/>
      <state_interface name="position"/><state_interface name="velocity"/>
    </joint>
  </ros2_control>
  <gazebo><plugin name="c" filename="libgazebo_ros2_control.so"/></gazebo>
"""
SERVO = {
    "type": "effort_controllers/JointPositionController",
    "joint": "hinge",
    "pid": {"p": 40.0, "i": 0.0, "d": 6.0},
}
TRAJECTORY = {
    "type": "joint_trajectory_controller/JointTrajectoryController",
    "joints": ["hinge"],
    "command_interfaces": ["position"],
    "state_interfaces": ["position", "velocity"],
}


@pytest.fixture
def ros1() -> Iterator[gazelle.Simulation]:
    """A hinge under ros_control."""
    with gazelle.Simulation.load(
        ROBOT.format(control=ROS1), parameters={"arm": {"servo": SERVO}}
    ) as sim:
        yield sim


@pytest.fixture(params=["mapping", "file"])
def ros2(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[gazelle.Simulation]:
    """A hinge under ros2_control, its parameters given as a mapping or a file."""
    import yaml

    tree = {
        "controller_manager": {"ros__parameters": {"update_rate": 200}},
        "arm_controller": {"ros__parameters": TRAJECTORY},
    }
    file = tmp_path / "controllers.yaml"
    file.write_text(yaml.safe_dump(tree))
    parameters = tree if request.param == "mapping" else file
    with gazelle.Simulation.load(ROBOT.format(control=ROS2), parameters=parameters) as sim:
        yield sim


def test_a_controller_of_the_parameters_is_spawned_and_obeys(ros1):
    controllers = ros1.controller_manager("/arm")
    record = controllers.spawn("servo")
    assert (record.state, record.commands) == ("active", ("hinge/effort",))
    ros1.publish("/arm/servo/command", message_type("std_msgs/Float64")(data=0.5))
    ros1.run(seconds=3.0)
    assert ros1.joint("hinge").position == pytest.approx(0.5, abs=0.01)


def test_a_controller_can_be_described_in_the_program(ros1):
    controllers = ros1.controller_manager()
    values = {"joint": "hinge", "pid.p": 10.0, "pid.d": 2.0}
    kind = "effort_controllers/JointPositionController"
    controllers.spawn("other", kind, parameters=values)
    assert list(controllers.controllers) == ["other"]
    with pytest.raises(ControllerError, match=r"Resource conflict on \[hinge\]"):
        controllers.spawn("servo")
    controllers.switch(start=("servo",), stop=("other",))
    assert controllers.controllers["servo"].is_active
    controllers.unload("other")
    controllers.stop("servo")
    controllers.start("servo")
    controllers.unload("servo")
    assert not controllers.controllers


def test_runs_with_controllers_repeat_exactly(ros1):
    def run() -> str:
        with gazelle.Simulation.load(
            ROBOT.format(control=ROS1), parameters={"arm": {"servo": SERVO}}
        ) as sim:
            sim.controller_manager().spawn("servo")
            sim.publish("/arm/servo/command", message_type("std_msgs/Float64")(data=0.5))
            sim.run(seconds=0.3)
            return sim.state_hash()

    assert run() == run()


def test_reset_restarts_the_controllers(ros1):
    ros1.controller_manager().spawn("servo")
    ros1.publish("/arm/servo/command", message_type("std_msgs/Float64")(data=0.5))
    ros1.run(seconds=1.0)
    ros1.reset()
    assert ros1.time_ns == 0
    ros1.run(seconds=0.5)
    assert ros1.joint("hinge").position == pytest.approx(0.0, abs=1e-3)


def test_a_goal_is_followed_to_its_end(ros2):
    ros2.controller_manager().spawn("arm_controller")
    ros2.step()
    feedback: list[object] = []
    goal = ros2.send_goal(
        "/arm_controller/follow_joint_trajectory",
        {
            "trajectory": {
                "joint_names": ["hinge"],
                "points": [{"positions": [0.8], "time_from_start": {"sec": 1, "nanosec": 0}}],
            }
        },
        on_feedback=feedback.append,
    )
    ros2.run(seconds=0.5)
    assert goal.status.name == "EXECUTING"
    ros2.run(seconds=1.0)
    assert goal.status.name == "SUCCEEDED", (goal.status, goal.text, goal.result)
    assert goal.result.error_code == 0
    assert ros2.joint("hinge").position == pytest.approx(0.8, abs=1e-3)
    assert feedback


def test_an_action_or_manager_that_is_not_there_is_named(ros2, ros1):
    with pytest.raises(NotFoundError, match="follow_joint_trajectory"):
        ros2.controller_manager().spawn("arm_controller")
        ros2.send_goal("/arm_controller/follow_trajectory", {})
    with pytest.raises(NotFoundError, match="namespaces with a controller manager: /arm"):
        ros1.controller_manager("/leg")
