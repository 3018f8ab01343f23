"""Plug-ins that move a whole robot: skid steer, planar move, gz velocity control."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.interfaces import message_type
from gazelle.interfaces.poses import twist_message
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

_WHEEL = """<link name="{name}_wheel"><inertial><mass value="0.5"/>
    <inertia ixx="8e-4" ixy="0" ixz="0" iyy="8e-4" iyz="0" izz="1.5e-3"/></inertial>
    <collision><geometry><cylinder radius="0.1" length="0.02"/></geometry></collision></link>
  <joint name="{name}_joint" type="continuous">
    <origin xyz="{x} {y} 0" rpy="-1.5707963267948966 0 0"/>
    <parent link="base_link"/><child link="{name}_wheel"/><axis xyz="0 0 1"/></joint>"""

_BODY = """<robot name="{name}"><link name="base_footprint"/>
  <joint name="base_joint" type="fixed"><origin xyz="0 0 0.1"/>
    <parent link="base_footprint"/><child link="base_link"/></joint>
  <link name="base_link"><inertial><mass value="8"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.15"/></inertial>{collision}</link>
  {parts}<gazebo><plugin name="drive" filename="{library}">{keys}</plugin></gazebo></robot>"""


def four_wheels(keys: str) -> str:
    parts = "".join(
        _WHEEL.format(name=f"{side}_{end}", x=x, y=y)
        for side, y in (("left", 0.15), ("right", -0.15))
        for end, x in (("front", 0.1), ("rear", -0.1))
    )
    library = "libgazebo_ros_skid_steer_drive.so"
    return _BODY.format(name="rover", collision="", parts=parts, library=library, keys=keys)


def slider(library: str, keys: str, *, mu: float = 0.0) -> str:
    """A box that slides on the floor."""
    box = '<collision><geometry><box size="0.4 0.2 0.2"/></geometry></collision>'
    parts = f'<gazebo reference="base_link"><mu1>{mu}</mu1><mu2>{mu}</mu2></gazebo>'
    return _BODY.format(name="box", collision=box, parts=parts, library=library, keys=keys)


def command(sim: Simulation, forward: float, sideways: float = 0.0, turn: float = 0.0) -> None:
    sim.publish("/cmd_vel", twist_message((forward, sideways, 0.0), (0.0, 0.0, turn)))


SKID = """<wheelSeparation>0.3</wheelSeparation><wheelDiameter>0.2</wheelDiameter>
  <torque>20</torque><broadcastTF>true</broadcastTF>"""


def test_skid_steer_drives_at_wheel_speed_times_radius(load: Load, listen: Listen) -> None:
    sim = load(four_wheels(SKID))
    odometry, tf = listen(sim, "/odom"), listen(sim, "/tf")
    command(sim, 0.5)
    sim.run(seconds=4.0)
    wheels = [sim.joint(f"{side}_{end}_joint") for side in ("left", "right")
              for end in ("front", "rear")]  # fmt: skip
    assert [wheel.velocity for wheel in wheels] == pytest.approx([5.0] * 4, rel=0.01)
    assert sim.model("rover").pose.position_m[0] == pytest.approx(2.0, rel=0.01)
    message = odometry[-1]
    assert len(odometry) == len(tf) == 400
    assert message.pose.pose.position.x == pytest.approx(sim.model("rover").pose.position_m[0])
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_footprint")
    assert message.twist.twist.linear.x == pytest.approx(0.5, rel=0.01)
    for covariance in (message.pose.covariance, message.twist.covariance):
        assert np.asarray(covariance)[[0, 7, 14, 21, 28, 35]].tolist() == [
            1e-4, 1e-4, 1e12, 1e12, 1e12, 1e-2
        ]  # fmt: skip


def test_skid_steer_turns_left_with_both_sides_opposed_and_slower_than_ideal(load: Load) -> None:
    """Wheels before and behind the centre must slide, so the robot turns less than it rolls."""
    sim = load(four_wheels(SKID))
    command(sim, 0.0, turn=1.0)
    sim.run(seconds=2.0)
    speeds = [sim.joint(f"{side}_front_joint").velocity for side in ("left", "right")]
    assert speeds == pytest.approx([-1.5, 1.5], rel=0.02)
    assert 0.3 < sim.model("rover").pose.rpy_rad[2] < 2.0


def test_skid_steer_without_a_wheel_is_reported_and_left_out(load: Load) -> None:
    sim = load(four_wheels("<leftFrontJoint>left_fornt_joint</leftFrontJoint>"))
    found = [item for item in sim.diagnostics if item.code == "plugin.missing-joint"]
    assert "left_front_joint" in found[0].fix
    assert sim.model("rover").pose.position_m[0] == 0.0


@pytest.mark.parametrize(
    "keys",
    [
        "<odometryRate>50</odometryRate>",
        "<ros><remapping>odom:=odom</remapping></ros><update_rate>1000</update_rate>"
        "<publish_rate>50</publish_rate>",
    ],
)
def test_planar_move_integrates_the_command(load: Load, listen: Listen, keys: str) -> None:
    sim = load(slider("libgazebo_ros_planar_move.so", keys))
    odometry, tf = listen(sim, "/odom"), listen(sim, "/tf")
    forward, sideways, turn = 0.6, -0.3, 0.8
    command(sim, forward, sideways, turn)
    sim.run(seconds=2.0)
    sin, cos = math.sin(turn * 2.0), math.cos(turn * 2.0)
    x = (forward * sin + sideways * (cos - 1)) / turn
    y = (forward * (1 - cos) + sideways * sin) / turn
    pose = sim.model("box").pose
    assert pose.position_m[:2] == pytest.approx((x, y), abs=3e-3)
    assert pose.rpy_rad[2] == pytest.approx(turn * 2.0, rel=2e-3)
    message = odometry[-1]
    assert len(odometry) == len(tf) == 100
    assert message.pose.pose.position.x == pytest.approx(pose.position_m[0], abs=1e-9)
    assert message.twist.twist.linear.x == pytest.approx(forward, abs=0.01)
    assert message.twist.twist.linear.y == pytest.approx(sideways, abs=0.01)
    assert message.twist.twist.angular.z == pytest.approx(turn, abs=0.01)
    assert np.asarray(message.pose.covariance)[[0, 35]].tolist() == [1e-5, 1e-3]


def test_planar_move_ends_a_command_after_its_timeout(load: Load) -> None:
    sim = load(slider("libgazebo_ros_planar_move.so", "<cmdTimeout>0.5</cmdTimeout>"))
    command(sim, 1.0)
    sim.run(seconds=2.0)
    assert sim.model("box").pose.position_m[0] == pytest.approx(0.5, abs=0.01)


def test_planar_move_of_ros2_lets_friction_act_between_two_updates(load: Load) -> None:
    """At 20 Hz a sliding body loses μ g · 50 ms until its speed is set again, first after 50 ms."""
    keys = "<ros><namespace>/</namespace></ros>"
    sim = load(slider("libgazebo_ros_planar_move.so", keys, mu=0.4))
    command(sim, 1.0)
    sim.run(seconds=2.0)
    lost = 0.4 * 9.8 * 0.05 / 2
    assert sim.model("box").pose.position_m[0] == pytest.approx(1.95 * (1 - lost), rel=0.01)


def test_velocity_control_moves_a_model_in_its_own_frame(load: Load) -> None:
    keys = "<initial_linear>0.5 0 0</initial_linear><initial_angular>0 0 0.5</initial_angular>"
    sim = load(slider("gz-sim-velocity-control-system", keys))
    sim.run(seconds=1.0)
    radius = 0.5 / 0.5
    assert sim.model("box").pose.position_m[:2] == pytest.approx(
        (radius * math.sin(0.5), radius * (1 - math.cos(0.5))), abs=2e-3
    )
    twist = message_type("geometry_msgs/Twist")()
    twist.linear.z = 0.3
    sim.publish("/model/box/cmd_vel", twist)
    height = sim.model("box").pose.position_m[2]
    sim.run(seconds=1.0)
    assert sim.model("box").pose.position_m[2] - height == pytest.approx(0.3 - 0.0098, abs=1e-3)


def test_velocity_control_moves_a_single_link(load: Load) -> None:
    sim = load(slider("gz-sim-velocity-control-system", "<link_name>base_link</link_name>"))
    twist = message_type("geometry_msgs/Twist")()
    twist.linear.x = 0.4
    sim.publish("/model/box/link/base_link/cmd_vel", twist)
    sim.run(seconds=1.0)
    assert sim.model("box").pose.position_m[0] == pytest.approx(0.4, abs=5e-3)
