"""Plug-ins that push: force, link wrench, joint commands, vacuum gripper, hand of god, poses."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.geometry import Pose
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import transform_stamped
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

G = 9.8
MASS_KG, INERTIA = 2.0, 0.05

_BODY = f"""<link name="body"><inertial><mass value="{MASS_KG}"/><inertia ixx="{INERTIA}" ixy="0"
  ixz="0" iyy="{INERTIA}" iyz="0" izz="{INERTIA}"/></inertial></link>"""


def floating(library: str, keys: str) -> str:
    """A body that falls freely."""
    plugin = f'<gazebo><plugin name="push" filename="{library}">{keys}</plugin></gazebo>'
    return f'<robot name="thing">{_BODY}{plugin}</robot>'


def lever(library: str, keys: str, *, effort: float = 100.0) -> str:
    """A wheel on the world that turns about z, and a second one."""
    joints = "".join(
        f"""<link name="{name}"><inertial><mass value="1"/><inertia ixx="{INERTIA}" ixy="0"
          ixz="0" iyy="{INERTIA}" iyz="0" izz="{INERTIA}"/></inertial></link>
        <joint name="{name}_joint" type="revolute"><parent link="world"/><child link="{name}"/>
          <axis xyz="0 0 1"/><limit lower="-50" upper="50" effort="{effort}" velocity="50"/>
        </joint>"""
        for name in ("one", "two")
    )
    plugin = f'<gazebo><plugin name="push" filename="{library}">{keys}</plugin></gazebo>'
    return f'<robot name="thing"><link name="world"/>{joints}{plugin}</robot>'


def wrench(force: tuple[float, ...] = (0, 0, 0), torque: tuple[float, ...] = (0, 0, 0)) -> Any:
    message = message_type("geometry_msgs/Wrench")()
    for field, values in ((message.force, force), (message.torque, torque)):
        field.x, field.y, field.z = (float(value) for value in values)
    return message


def test_force_accelerates_with_force_over_mass_until_the_next(load: Load) -> None:
    keys = "<bodyName>body</bodyName><topicName>push</topicName>"
    sim = load(floating("libgazebo_ros_force.so", keys), pose=Pose((0, 0, 50)))
    sim.publish("/push", wrench((3.0, 0.0, MASS_KG * G)))
    sim.run(seconds=1.0)
    assert sim.link("body").linear_velocity_m_s == pytest.approx((3.0 / MASS_KG, 0, 0), abs=1e-3)
    sim.publish("/push", wrench((0.0, 0.0, MASS_KG * G), (0.0, 0.0, 0.1)))
    sim.run(seconds=1.0)
    assert sim.link("body").linear_velocity_m_s[0] == pytest.approx(3.0 / MASS_KG, abs=1e-3)
    assert sim.link("body").angular_velocity_rad_s[2] == pytest.approx(0.1 / INERTIA, rel=0.01)
    sim.publish("/push", wrench())
    sim.run(seconds=0.5)
    assert sim.link("body").linear_velocity_m_s[2] == pytest.approx(-G * 0.5, rel=0.01)


def test_force_in_the_links_frame_turns_with_it(load: Load) -> None:
    """A forward force on a body that turns at ω drives a circle of F/(m ω²)."""
    keys = """<ros><namespace>/demo</namespace></ros><link_name>body</link_name>
      <force_frame>link</force_frame>"""
    sim = load(floating("libgazebo_ros_force.so", keys), pose=Pose((0, 0, 50)))
    omega, force = 2 * math.pi, 4.0
    sim.server.engine.set_gravity((0.0, 0.0, 0.0))
    sim.server.engine.set_model_velocity("thing", (0, 0, 0), (0, 0, omega))
    sim.publish("/demo/gazebo_ros_force", wrench((force, 0.0, 0.0)))
    sim.run(seconds=0.5)
    speed = sim.link("body").linear_velocity_m_s
    assert speed == pytest.approx((0.0, 2 * force / (MASS_KG * omega), 0.0), abs=5e-3)


def test_force_with_a_wrong_frame_is_reported(load: Load) -> None:
    keys = "<link_name>body</link_name><force_frame>wrold</force_frame>"
    sim = load(floating("libgazebo_ros_force.so", keys))
    found = [item for item in sim.diagnostics if item.code == "parameter.bad-value"]
    assert "not 'world' or 'link'" in found[0].message
    assert "world" in found[0].fix


WRENCH_WORLD = """<sdf version="1.9"><world name="w"><gravity>0 0 0</gravity>
  <plugin filename="gz-sim-apply-link-wrench-system" name="gz::sim::systems::ApplyLinkWrench">
    <persistent><entity_name>crate</entity_name><entity_type>model</entity_type>
      <force>0 6 0</force></persistent></plugin>
  <model name="crate"><link name="body"><inertial><mass>2</mass></inertial></link></model>
</world></sdf>"""


def test_link_wrenches_act_for_a_step_or_until_cleared(load: Load, tmp_path: Any) -> None:
    path = tmp_path / "wrench.sdf"
    path.write_text(WRENCH_WORLD, encoding="utf-8")
    sim = load(None, world=path)
    sim.run(seconds=0.5)
    assert sim.link("crate::body").linear_velocity_m_s == pytest.approx((0, 1.5, 0), abs=1e-3)
    entity = message_type("ros_gz_interfaces/Entity")(name="crate::body", type=3)
    sim.publish("/world/w/wrench/clear", entity)
    message = message_type("ros_gz_interfaces/EntityWrench")(entity=entity)
    message.wrench = wrench((1000.0, 0.0, 0.0))
    sim.publish("/world/w/wrench", message)
    sim.run(seconds=0.5)
    speed = sim.link("crate::body").linear_velocity_m_s
    assert speed == pytest.approx((1000.0 / 2 * 0.001, 1.5, 0), abs=2e-3)
    message.entity = message_type("ros_gz_interfaces/Entity")(name="crte", type=2)
    sim.publish("/world/w/wrench/persistent", message)
    sim.run(seconds=0.01)
    missing = [item for item in sim.diagnostics if item.code == "plugin.missing-link"]
    assert "there is no model 'crte'" in missing[0].message
    assert "crate" in missing[0].fix


def float64(value: float) -> Any:
    return message_type("std_msgs/Float64")(data=value)


def test_joint_force_accelerates_with_torque_over_inertia(load: Load) -> None:
    sim = load(lever("gz-sim-apply-joint-force-system", "<joint_name>one_joint</joint_name>"))
    sim.publish("/model/thing/joint/one_joint/cmd_force", float64(0.2))
    sim.run(seconds=1.0)
    assert sim.joint("one_joint").velocity == pytest.approx(0.2 / INERTIA, rel=0.01)
    assert sim.joint("two_joint").velocity == 0.0


def test_joint_controller_reaches_its_velocity_at_once_or_by_its_pid(load: Load) -> None:
    names = "<joint_name>one_joint</joint_name><joint_name>two_joint</joint_name>"
    sim = load(lever("gz-sim-joint-controller-system", names))
    sim.publish("/model/thing/joint/one_joint/cmd_vel", float64(3.0))
    sim.run(seconds=0.01)
    speeds = [sim.joint(f"{name}_joint").velocity for name in ("one", "two")]
    assert speeds == pytest.approx([3.0, 3.0], rel=1e-3)
    keys = names + "<use_force_commands>true</use_force_commands><p_gain>0.5</p_gain>"
    sim = load(lever("gz-sim-joint-controller-system", keys))
    sim.publish("/model/thing/joint/one_joint/cmd_vel", float64(3.0))
    sim.run(seconds=0.1)
    expected = 3.0 * (1 - math.exp(-0.5 / INERTIA * 0.1))
    assert sim.joint("one_joint").velocity == pytest.approx(expected, rel=0.02)


def test_joint_position_controller_is_a_spring_and_damper(load: Load) -> None:
    """Critically damped by its gains: (1 + ω t) e^(−ω t) is left of a step of 1 rad."""
    omega = 10.0
    keys = f"""<joint_name>one_joint</joint_name><p_gain>{INERTIA * omega**2}</p_gain>
      <i_gain>0</i_gain><d_gain>{2 * INERTIA * omega}</d_gain><topic>/aim</topic>"""
    sim = load(lever("gz-sim-joint-position-controller-system", keys))
    sim.publish("/aim", float64(1.0))
    # Gazebo takes the derivative of the error, which jumps with the target: for one step the
    # joint's effort limit of 100 N·m acts.
    kick = 100.0 * 0.001 / INERTIA
    sim.run(seconds=0.2)
    t = 0.2
    left = ((1 + omega * t) - kick * t) * math.exp(-omega * t)
    assert sim.joint("one_joint").position == pytest.approx(1.0 - left, abs=0.01)
    sim.run(seconds=2.0)
    assert sim.joint("one_joint").position == pytest.approx(1.0, abs=1e-3)


def test_joint_position_controller_goes_by_velocity_at_most_at_its_bound(load: Load) -> None:
    keys = """<joint_name>one_joint</joint_name><cmd_max>2.0</cmd_max>
      <use_velocity_commands>true</use_velocity_commands>"""
    sim = load(lever("gz-sim-joint-position-controller-system", keys))
    sim.publish("/model/thing/joint/one_joint/0/cmd_pos", float64(1.0))
    sim.run(seconds=0.25)
    assert sim.joint("one_joint").position == pytest.approx(0.5, abs=0.01)
    sim.run(seconds=0.5)
    assert sim.joint("one_joint").position == pytest.approx(1.0, abs=1e-3)


def course(*points: dict[str, Any], joints: tuple[str, ...] = ("one_joint", "two_joint")) -> Any:
    """A trajectory; ``after`` of a point is its time in seconds."""
    message = message_type("trajectory_msgs/JointTrajectory")(joint_names=list(joints))
    for fields in points:
        point = message_type("trajectory_msgs/JointTrajectoryPoint")()
        after = fields.pop("after")
        point.time_from_start.sec = int(after)
        point.time_from_start.nanosec = round(after % 1 * 1e9)
        for name, values in fields.items():
            setattr(point, name, values)
        message.points.append(point)
    return message


TRAJECTORY = "gz-sim-joint-trajectory-controller-system"


def test_trajectory_controller_takes_each_joint_to_the_points_by_its_own_gains(
    load: Load, listen: Listen
) -> None:
    omega = 20.0
    both = "".join(
        f"""<joint_name>{name}_joint</joint_name><initial_position>{start}</initial_position>
        <position_p_gain>{INERTIA * omega**2}</position_p_gain>
        <position_d_gain>{2 * INERTIA * omega}</position_d_gain>"""
        for name, start in (("one", 0.3), ("two", -0.2))
    )
    sim = load(lever(TRAJECTORY, both))
    sim.run(seconds=1.0)
    there = [sim.joint(f"{name}_joint").position for name in ("one", "two")]
    assert there == pytest.approx([0.3, -0.2], abs=1e-3)
    progress = listen(sim, "/model/thing/joint_trajectory_progress")
    sim.publish(
        "/model/thing/joint_trajectory",
        course({"positions": [1.0, -1.0], "after": 1.0}, {"positions": [0.5, 2.0], "after": 2.0}),
    )
    sim.run(seconds=0.9)
    there = [sim.joint(f"{name}_joint").position for name in ("one", "two")]
    assert there == pytest.approx([1.0, -1.0], abs=1e-3)
    assert [one.data for one in progress] == [0.5]
    sim.run(seconds=1.1)
    there = [sim.joint(f"{name}_joint").position for name in ("one", "two")]
    assert there == pytest.approx([0.5, 2.0], abs=1e-3)
    assert [one.data for one in progress] == [0.5, 1.0]


def test_trajectory_controller_adds_velocity_loop_and_effort_for_all_joints(load: Load) -> None:
    sim = load(lever(TRAJECTORY, "<topic>go</topic><velocity_p_gain>0.5</velocity_p_gain>"))
    point = {"velocities": [2.0], "effort": [0.0, 0.2], "after": 0.1}
    sim.publish("/go", course(point))
    sim.run(seconds=1.0)
    # Only the first joint has a gain; the second has its effort alone.
    assert sim.joint("one_joint").velocity == pytest.approx(2.0, rel=1e-3)
    assert sim.joint("two_joint").velocity == pytest.approx(0.2 / INERTIA, rel=0.01)


def test_time_of_a_trajectory_counts_from_its_stamp_where_the_world_says_so(
    load: Load, listen: Listen
) -> None:
    sim = load(lever(TRAJECTORY, "<use_header_start_time>true</use_header_start_time>"))
    progress = listen(sim, "/model/thing/joint_trajectory_progress")
    sim.run(seconds=1.0)
    message = course(*({"effort": [0.0, 0.0], "after": after} for after in (0.5, 1.5, 2.5)))
    message.header.stamp.nanosec = 100_000_000
    sim.publish("/model/thing/joint_trajectory", message)
    sim.run(seconds=0.5)
    # 0.9 s after the stamp: the first point is over.
    assert [one.data for one in progress] == pytest.approx([2 / 3])
    sim.run(seconds=0.2)
    assert [one.data for one in progress] == pytest.approx([2 / 3, 1.0])


def test_trajectory_for_a_joint_that_is_not_driven_is_told(load: Load) -> None:
    sim = load(lever(TRAJECTORY, "<joint_name>one_joint</joint_name>"))
    sim.publish("/model/thing/joint_trajectory", course({"effort": [0.1, 0.1], "after": 0.0}))
    sim.run(seconds=0.1)
    assert sim.joint("two_joint").velocity == 0.0
    assert sim.joint("one_joint").velocity == pytest.approx(0.1 * 0.1 / INERTIA, rel=0.05)
    (told,) = sim.diagnostics.by_code("plugin.missing-joint")
    assert "trajectory for joint 'two_joint', which it does not drive" in told.message


def gripper(keys: str) -> str:
    """A cup on a lift that hangs on the world."""
    return f"""<robot name="robot"><link name="world"/>
      <link name="cup">{_BODY.split('name="body">')[1]}
      <joint name="lift" type="prismatic"><origin xyz="0 0 0.24"/><parent link="world"/>
        <child link="cup"/><axis xyz="0 0 1"/>
        <limit lower="-1" upper="2" effort="500" velocity="5"/></joint>
      <gazebo><plugin name="gripper" filename="libgazebo_ros_vacuum_gripper.so">{keys}</plugin>
      </gazebo></robot>"""


def crate(name: str) -> str:
    return f"""<robot name="{name}">{_BODY.replace("</link>", "")}<collision><geometry>
      <box size="0.2 0.2 0.4"/></geometry></collision></link></robot>"""


@pytest.mark.parametrize("ros_version", [1, 2])
def test_vacuum_gripper_lifts_what_is_near_and_drops_it(
    load: Load, listen: Listen, ros_version: int
) -> None:
    keys = "<bodyName>cup</bodyName><topicName>grasping</topicName>"
    if ros_version == 2:
        keys = """<ros><namespace>/arm</namespace></ros><link_name>cup</link_name>
          <max_distance>0.1</max_distance><fixed>wall</fixed>"""
    sim = load(gripper(keys))
    for name, x in (("near", 0.0), ("far", 0.5), ("wall", 0.02)):
        sim.spawn(crate(name), name=name, pose=Pose((x, 0.0, 0.21 if name != "wall" else 5.0)))
    topic = "/grasping" if ros_version == 1 else "/arm/grasping"
    grasping = listen(sim, topic)
    lift = sim.server.engine.joint("robot::lift")
    lift.lock_position(0.0)
    sim.run(seconds=0.1)
    switch(sim, ros_version, on=True)
    assert grasping[-1].data is False
    engine = sim.server.engine
    for k in range(100):
        lift.lock_position(0.5 * (k + 1) / 100)
        sim.run(seconds=0.01)
    assert grasping[-1].data is True
    assert engine.model_pose("near").position_m[2] == pytest.approx(0.7, abs=0.02)
    assert engine.model_pose("far").position_m[2] == pytest.approx(0.2, abs=0.01)
    switch(sim, ros_version, on=False)
    sim.run(seconds=1.0)
    assert engine.model_pose("near").position_m[2] == pytest.approx(0.2, abs=0.01)
    assert grasping[-1].data is False


def switch(sim: Simulation, ros_version: int, *, on: bool) -> None:
    node = sim.server.node
    if ros_version == 1:
        name = "/on" if on else "/off"
        node.call(name, service_type("std_srvs/Empty").Request())
        return
    request = service_type("std_srvs/SetBool").Request(data=on)
    assert node.call("/arm/switch", request).success
    assert not node.call("/arm/switch", request).success


def test_hand_of_god_brings_a_link_to_its_frame_without_overshoot(
    load: Load, listen: Listen
) -> None:
    keys = "<linkName>body</linkName><frameId>hog</frameId>"
    sim = load(floating("libgazebo_ros_hand_of_god.so", keys), pose=Pose((0, 0, 5)))
    tf = listen(sim, "/tf")
    wanted = Pose.from_xyz_rpy((0.5, -0.2, 5.3), (0.0, 0.0, 0.6))
    root, half = Pose((0.0, 0.0, 5.0)), Pose((0.0, 0.0, 5.0)).inverse() @ wanted
    message = message_type("tf2_msgs/TFMessage")(
        transforms=[
            transform_stamped(0, "world", "table", root),
            transform_stamped(0, "table", "hog_desired", half),
        ]
    )
    sim.publish("/tf", message)
    furthest = 0.0
    for _ in range(200):
        sim.run(seconds=0.01)
        furthest = max(furthest, sim.model("thing").pose.position_m[0])
    pose = sim.model("thing").pose
    assert pose.position_m == pytest.approx(wanted.position_m, abs=2e-3)
    assert pose.rpy_rad[2] == pytest.approx(0.6, abs=2e-3)
    assert furthest < 0.5 * 1.002
    actual = [item for m in tf for item in m.transforms if item.child_frame_id == "hog_actual"]
    assert actual[-1].transform.translation.x == pytest.approx(pose.position_m[0], abs=1e-4)


def trajectory(frame: str, names: list[str], *points: tuple[float, list[float]]) -> Any:
    message = message_type("trajectory_msgs/JointTrajectory")(joint_names=names)
    message.header.frame_id = frame
    for seconds, positions in points:
        point = message_type("trajectory_msgs/JointTrajectoryPoint")()
        point.positions = np.array(positions)
        point.time_from_start.sec = int(seconds)
        point.time_from_start.nanosec = round(seconds % 1 * 1e9)
        message.points.append(point)
    return message


def test_joints_take_the_points_of_a_trajectory_in_turn(load: Load) -> None:
    sim = load(lever("libgazebo_ros_joint_pose_trajectory.so", ""))
    names = ["one_joint", "two_joint"]
    points = ((0.5, [0.3, -0.2]), (0.5, [0.6, -0.4]))
    sim.publish("/set_joint_trajectory", trajectory("world", names, *points))
    sim.run(seconds=0.1)
    assert [sim.joint(name).position for name in names] == pytest.approx([0.3, -0.2])
    sim.run(seconds=0.5)
    assert [sim.joint(name).position for name in names] == pytest.approx([0.6, -0.4])


def test_trajectory_service_takes_a_model_and_refuses_what_is_not_there(load: Load) -> None:
    sim = load(lever("libgazebo_ros_joint_pose_trajectory.so", ""))
    service = service_type("gazebo_msgs/SetJointTrajectory")
    request = service.Request(model_name="thing")
    request.joint_trajectory = trajectory("world", ["one_joint"], (0.0, [0.7]))
    assert sim.server.node.call("/set_joint_trajectory", request).success
    sim.run(seconds=0.01)
    assert sim.joint("one_joint").position == pytest.approx(0.7)
    request.joint_trajectory.joint_names = ["on_joint"]
    assert not sim.server.node.call("/set_joint_trajectory", request).success
    missing = [item for item in sim.diagnostics if item.code == "plugin.missing-joint"]
    assert "one_joint" in missing[0].fix
    request.model_name = "nobody"
    answer = sim.server.node.call("/set_joint_trajectory", request)
    assert answer.status_message == "there is no model 'nobody'"
