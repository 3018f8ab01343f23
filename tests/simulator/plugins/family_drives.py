"""Laws of the plug-ins that drive, push and hold."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest
from tests.simulator.conftest import DIFF_ROBOT, DRIVE, WHEEL
from tests.simulator.plugins.family_trial import HERE, KEYS, FamilyRow, Trial, number, vector
from tests.simulator.plugins.test_body_drives import SKID, four_wheels, slider
from tests.simulator.plugins.test_cars import (
    ACKERMANN,
    BASE_M,
    GZ_CAR,
    TRACK_M,
    car,
    driven_circle,
    tricycle,
)
from tests.simulator.plugins.test_pushing import (
    INERTIA,
    MASS_KG,
    WRENCH_WORLD,
    G,
    crate,
    floating,
    gripper,
    lever,
    switch,
    trajectory,
    wrench,
)
from tests.simulator.plugins.test_ros2_control import SYSTEMS
from tests.simulator.plugins.test_ros2_control import robot as ros2_robot
from tests.simulator.plugins.test_ros_control import joint as ros1_joint
from tests.simulator.plugins.test_ros_control import robot as ros1_robot
from tests.simulator.plugins.test_wheel_slip import cart, compliances, pulled, slip_ratio

from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import transform_stamped

__all__ = ["ROWS"]

HIGH = {"pose": Pose((0.0, 0.0, 50.0))}


def _two_wheels() -> str:
    wheels = WHEEL.format(side="left", y=0.15, axis=1) + WHEEL.format(side="right", y=-0.15, axis=1)
    text = DIFF_ROBOT.format(wheels=wheels, drive=KEYS, extra="")
    return text.replace("libgazebo_ros_diff_drive.so", HERE)


def two_wheels(trial: Trial, *, command: str, odometry: str) -> None:
    """Wheels turn at (v ± ω b/2) / r, the robot turns at ω, and odometry says so."""
    told = trial.listen(odometry)
    trial.command(command, 0.4, turn=0.5)
    trial.sim.run(seconds=1.0)
    speeds = [trial.sim.joint(f"{side}_joint").velocity for side in ("left", "right")]
    assert speeds == pytest.approx([(0.4 - 0.075) / 0.1, (0.4 + 0.075) / 0.1], rel=0.02)
    before = told[-1].pose.pose
    speed, rate = driven_circle(trial.sim, "cart", seconds=2.0)
    # The axle lies 0.1 m ahead of the robot's origin; tyres of 2 cm touch anywhere on their width.
    assert speed == pytest.approx(math.hypot(0.4, 0.1 * 0.5), rel=0.02)
    assert rate == pytest.approx(0.5, rel=0.02 / 0.3)
    after, twist = told[-1].pose.pose, told[-1].twist.twist
    assert math.hypot(twist.linear.x, twist.linear.y) == pytest.approx(0.4, rel=0.02)
    assert twist.angular.z == pytest.approx(0.5, rel=0.02)
    travelled = math.dist(vector(before.position), vector(after.position))
    assert travelled == pytest.approx(2 * 0.4 / 0.5 * math.sin(0.5), rel=0.02)


def skid(trial: Trial) -> None:
    """All four wheels turn at v / r and the robot moves at v."""
    trial.command("/cmd_vel", 0.5)
    trial.sim.run(seconds=2.0)
    names = [f"{side}_{end}_joint" for side in ("left", "right") for end in ("front", "rear")]
    assert [trial.sim.joint(name).velocity for name in names] == pytest.approx([5.0] * 4, rel=0.01)
    assert trial.sim.model("rover").pose.position_m[0] == pytest.approx(1.0, rel=0.02)


def whole_body(trial: Trial, *, topic: str, model: str) -> None:
    """A sliding body follows a twist with a sideways part, in its own frame."""
    x, y, turn = 0.6, -0.3, 0.8
    trial.command(topic, x, y, turn)
    trial.sim.run(seconds=1.0)
    sine, rest = math.sin(turn) / turn, (1 - math.cos(turn)) / turn
    pose = trial.sim.model(model).pose
    assert pose.position_m[:2] == pytest.approx(
        (x * sine - y * rest, x * rest + y * sine), abs=5e-3
    )
    assert pose.rpy_rad[2] == pytest.approx(turn, rel=5e-3)


def car_circle(trial: Trial, *, topic: str, turn: float, radius: float, model: str = "car") -> None:
    """A car goes round the circle that its steering says."""
    trial.command(topic, 0.6, turn=turn)
    trial.sim.run(seconds=1.5)
    speed, rate = driven_circle(trial.sim, model, seconds=1.5)
    assert speed / rate == pytest.approx(radius, rel=0.04)


def slips(trial: Trial) -> None:
    """Wheels lose compliance × force ratio of their speed."""
    forward, _, _ = pulled(trial.sim, (-20.0, 0.0, 0.0))
    assert forward == pytest.approx(0.5 * (1 - slip_ratio(0.7)), rel=0.01)


def pushes(trial: Trial) -> None:
    """F / m, and what carries the weight."""
    topic = "/demo/gazebo_ros_force" if trial.is_ros2 else "/push"
    trial.sim.publish(topic, wrench((3.0, 0.0, MASS_KG * G)))
    trial.sim.run(seconds=0.5)
    speed = trial.sim.link("body").linear_velocity_m_s
    assert speed == pytest.approx((0.5 * 3.0 / MASS_KG, 0.0, 0.0), abs=1e-2)


def world_pushes(trial: Trial) -> None:
    """A wrench of the file acts until it is cleared: F t / m."""
    trial.sim.run(seconds=0.5)
    crate_speed = trial.sim.link("crate::body").linear_velocity_m_s
    assert crate_speed == pytest.approx((0.0, 6.0 / 2.0 * 0.5, 0.0), abs=1e-3)


def joint_force(trial: Trial) -> None:
    """τ t / I on the joint named, none on the other."""
    trial.sim.publish("/model/thing/joint/one_joint/cmd_force", number(0.2))
    trial.sim.run(seconds=0.5)
    speeds = [trial.sim.joint(f"{name}_joint").velocity for name in ("one", "two")]
    assert speeds == pytest.approx([0.5 * 0.2 / INERTIA, 0.0], rel=0.01)


FOLLOWS = """<joint>one_joint</joint><mimicJoint>two_joint</mimicJoint>
  <multiplier>-0.5</multiplier><offset>0.3</offset>"""


def mimics(trial: Trial) -> None:
    """The second joint is where the first one's position puts it."""
    one, two = (trial.sim.joint(f"{name}_joint") for name in ("one", "two"))
    one.handle.set_state(velocity=2.0)
    trial.sim.run(seconds=0.5)
    assert one.position == pytest.approx(1.0, rel=0.01)
    assert two.position == pytest.approx(0.3 - 0.5 * one.position, abs=5e-3)
    assert two.velocity == pytest.approx(-0.5 * one.velocity, rel=0.02)


def joint_velocity(trial: Trial) -> None:
    """The velocity is there at once."""
    trial.sim.publish("/model/thing/joint/one_joint/cmd_vel", number(3.0))
    trial.sim.run(seconds=0.5)
    assert trial.sim.joint("one_joint").velocity == pytest.approx(3.0, rel=1e-3)
    assert trial.sim.joint("one_joint").position == pytest.approx(1.5, rel=5e-3)


def joint_position(trial: Trial) -> None:
    """By velocity, at its bound until the goal."""
    trial.sim.publish("/model/thing/joint/one_joint/0/cmd_pos", number(1.0))
    trial.sim.run(seconds=0.25)
    assert trial.sim.joint("one_joint").position == pytest.approx(0.5, abs=0.01)
    trial.sim.run(seconds=0.5)
    assert trial.sim.joint("one_joint").position == pytest.approx(1.0, abs=1e-3)


def joint_trajectory(trial: Trial) -> None:
    """With a velocity loop alone a joint turns at the velocity of the point."""
    point = message_type("trajectory_msgs/JointTrajectoryPoint")(velocities=[2.0])
    message = message_type("trajectory_msgs/JointTrajectory")(
        joint_names=["one_joint"], points=[point]
    )
    trial.sim.publish("/model/thing/joint_trajectory", message)
    trial.sim.run(seconds=1.0)
    assert trial.sim.joint("one_joint").velocity == pytest.approx(2.0, rel=1e-3)


def lifts(trial: Trial) -> None:
    """What is near rises with the cup, and falls when it is let go."""
    sim, ros_version = trial.sim, 2 if trial.is_ros2 else 1
    sim.spawn(crate("near"), name="near", pose=Pose((0.0, 0.0, 0.21)))
    lift = sim.server.engine.joint("robot::lift")
    lift.lock_position(0.0)
    sim.run(seconds=0.05)
    switch(sim, ros_version, on=True)
    for height in np.linspace(0.0, 0.5, 51):
        lift.lock_position(float(height))
        sim.run(seconds=0.01)
    assert sim.model("near").pose.position_m[2] == pytest.approx(0.7, abs=0.02)
    switch(sim, ros_version, on=False)
    sim.run(seconds=0.6)
    assert sim.model("near").pose.position_m[2] == pytest.approx(0.2, abs=0.02)


def brings(trial: Trial) -> None:
    """The link goes to the frame that tf names, and stays."""
    wanted = (0.3, -0.2, 50.3)
    moved = [transform_stamped(0, "world", "hog_desired", Pose(wanted))]
    trial.sim.publish("/tf", message_type("tf2_msgs/TFMessage")(transforms=moved))
    trial.sim.run(seconds=2.0)
    assert trial.sim.model("thing").pose.position_m == pytest.approx(wanted, abs=2e-3)


def poses(trial: Trial) -> None:
    """Joints take the points of a trajectory in turn."""
    topic = "/arm/set_joint_trajectory" if trial.is_ros2 else "/set_joint_trajectory"
    names = ["one_joint", "two_joint"]
    points = ((0.2, [0.3, -0.2]), (0.2, [0.6, -0.4]))
    trial.sim.publish(topic, trajectory("world", names, *points))
    for wanted in points:
        trial.sim.run(seconds=0.1)
        assert [trial.sim.joint(n).position for n in names] == pytest.approx(wanted[1])
        trial.sim.run(seconds=0.15)


def ros1_controller(trial: Trial) -> None:
    """An effort controller of the parameters accelerates the joint: τ t / I."""
    ((namespace, _),) = trial.sim.server.controls.managers.items()
    manager = trial.sim.controller_manager(namespace)
    manager.load("go")
    manager.start("go")
    topic = f"{namespace.rstrip('/')}/go/command"
    trial.sim.publish(topic, number(2.0))
    trial.sim.run(seconds=0.5)
    # The first step has no effort yet: controllers run after a step, for the next one.
    assert trial.sim.joint("j").velocity == pytest.approx(2.0 / 0.5 * 0.499, rel=1e-9)


def ros2_controller(trial: Trial) -> None:
    """The joint is held where it begins and goes where it is told."""
    manager = trial.sim.controller_manager()
    manager.load("forward")
    manager.start("forward")
    trial.sim.run(seconds=0.5)
    assert trial.sim.joint("j").position == pytest.approx(0.2, abs=2e-3)
    data = message_type("std_msgs/Float64MultiArray")(data=[0.5])
    trial.sim.publish("/forward/commands", data)
    trial.sim.run(seconds=1.0)
    assert trial.sim.joint("j").position == pytest.approx(0.5, abs=2e-3)


CLASSIC, GZ = SYSTEMS
GO = {"type": "effort_controllers/JointEffortController", "joint": "j"}
FORWARD = {
    "controller_manager": {
        "ros__parameters": {
            "update_rate": 200,
            "forward": {"type": "forward_command_controller/ForwardCommandController"},
        }
    },
    "forward": {"ros__parameters": {"joints": ["j"], "interface_name": "position"}},
}
ROS2_DRIVE = """<ros><namespace>/</namespace></ros><update_rate>100</update_rate>
  <left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>
  <wheel_separation>0.3</wheel_separation><wheel_diameter>0.2</wheel_diameter>
  <max_wheel_torque>10</max_wheel_torque><publish_odom>true</publish_odom>
  <odometry_source>0</odometry_source>"""
GZ_DRIVE = """<left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>
  <wheel_separation>0.3</wheel_separation><wheel_radius>0.1</wheel_radius>"""
TRICYCLE2 = """<ros><namespace>/</namespace></ros>
  <steering_joint>front_steering_joint</steering_joint>
  <actuated_wheel_joint>front_wheel_joint</actuated_wheel_joint>
  <encoder_wheel_left_joint>left_wheel_joint</encoder_wheel_left_joint>
  <encoder_wheel_right_joint>right_wheel_joint</encoder_wheel_right_joint>
  <actuated_wheel_diameter>0.2</actuated_wheel_diameter>
  <encoder_wheel_diameter>0.2</encoder_wheel_diameter>
  <encoder_wheel_separation>0.4</encoder_wheel_separation>
  <max_wheel_torque>20</max_wheel_torque>"""
SLIPPERY = cart(HERE, compliances(0.0, 0.7), KEYS)
ONE = "<joint_name>one_joint</joint_name>"
BY_VELOCITY = "<use_velocity_commands>true</use_velocity_commands><cmd_max>2.0</cmd_max>"
DEMO = "<ros><namespace>/demo</namespace></ros>"
ARM = "<ros><namespace>/arm</namespace></ros>"
GRIP = (
    "<bodyName>cup</bodyName><topicName>grasping</topicName>",
    f"{ARM}<link_name>cup</link_name>",
)

ROWS = (
    FamilyRow(
        "diff_drive",
        _two_wheels(),
        partial(two_wheels, command="/cmd_vel", odometry="/odom"),
        (f"{DRIVE}<odometrySource>encoder</odometrySource>", ROS2_DRIVE),
    ),
    FamilyRow(
        "gz-sim diff_drive",
        _two_wheels(),
        partial(two_wheels, command="/model/cart/cmd_vel", odometry="/model/cart/odometry"),
        (GZ_DRIVE,),
    ),
    FamilyRow(
        "skid_steer_drive",
        four_wheels(KEYS).replace("libgazebo_ros_skid_steer_drive.so", HERE),
        skid,
        (SKID,),
    ),
    FamilyRow(
        "planar_move",
        slider(HERE, KEYS),
        partial(whole_body, topic="/cmd_vel", model="box"),
        ("<odometryRate>50</odometryRate>", "<ros/><update_rate>1000</update_rate>"),
    ),
    FamilyRow(
        "gz-sim velocity control",
        slider(HERE, KEYS),
        partial(whole_body, topic="/model/box/cmd_vel", model="box"),
    ),
    FamilyRow(
        "ackermann_drive",
        car(HERE, KEYS),
        partial(car_circle, topic="/cmd_vel", turn=0.4, radius=BASE_M / math.tan(0.4)),
        (ACKERMANN,),
    ),
    FamilyRow(
        "gz-sim ackermann steering",
        car(HERE, KEYS),
        partial(car_circle, topic="/model/car/cmd_vel", turn=0.3, radius=0.6 / 0.3),
        (GZ_CAR,),
    ),
    FamilyRow(
        "tricycle_drive",
        tricycle(KEYS)
        .replace("libgazebo_ros_tricycle_drive.so", HERE)
        .replace(f"<encoderWheelSeparation>{TRACK_M}</encoderWheelSeparation>", ""),
        partial(car_circle, topic="/cmd_vel", turn=0.5, radius=BASE_M / math.tan(0.5)),
        (f"<encoderWheelSeparation>{TRACK_M}</encoderWheelSeparation>",),
    ),
    *(
        FamilyRow(family, SLIPPERY, slips, keys)
        for family, keys in (
            ("wheel_slip", ("", DEMO)),
            ("WheelSlipPlugin", ("",)),
            ("gz-sim wheel slip", ("",)),
        )
    ),
    FamilyRow(
        "force",
        floating(HERE, KEYS),
        pushes,
        (
            "<bodyName>body</bodyName><topicName>push</topicName>",
            f"{DEMO}<link_name>body</link_name>",
        ),
        HIGH,
    ),
    FamilyRow(
        "gz-sim apply link wrench",
        WRENCH_WORLD.replace(
            'filename="gz-sim-apply-link-wrench-system" name="gz::sim::systems::ApplyLinkWrench"',
            f'name="p" filename="{HERE}"',
        ),
        world_pushes,
    ),
    FamilyRow("gz-sim apply joint force", lever(HERE, KEYS), joint_force, (ONE,)),
    FamilyRow("gz-sim joint controller", lever(HERE, KEYS), joint_velocity, (ONE,)),
    FamilyRow(
        "gz-sim joint position controller", lever(HERE, KEYS), joint_position, (ONE + BY_VELOCITY,)
    ),
    FamilyRow(
        "gz-sim joint trajectory controller",
        lever(HERE, KEYS),
        joint_trajectory,
        (ONE + "<velocity_p_gain>0.5</velocity_p_gain>",),
    ),
    FamilyRow(
        "vacuum_gripper",
        gripper(KEYS).replace("libgazebo_ros_vacuum_gripper.so", HERE),
        lifts,
        GRIP,
    ),
    FamilyRow(
        "hand_of_god",
        floating(HERE, KEYS),
        brings,
        (
            "<linkName>body</linkName><frameId>hog</frameId>",
            "<ros/><link_name>body</link_name><frame_id>hog</frame_id>",
        ),
        HIGH,
    ),
    FamilyRow("mimic_joint", lever(HERE, KEYS), mimics, (FOLLOWS,)),
    FamilyRow("joint_pose_trajectory", lever(HERE, KEYS), poses, ("", ARM)),
    FamilyRow(
        "ros_control",
        ros1_robot(ros1_joint("j"), keys=KEYS).replace("libgazebo_ros_control.so", HERE),
        ros1_controller,
        options={"parameters": {"go": GO, "bot": {"go": GO}}},
    ),
    *(
        FamilyRow(
            family,
            ros2_robot(plugin, KEYS)
            .replace(filename, HERE)
            .replace('name="gz_ros2_control::GazeboSimROS2ControlPlugin"', 'name="p"'),
            ros2_controller,
            options={"parameters": FORWARD},
        )
        for family, plugin, filename in (
            ("ros2_control", CLASSIC, "libgazebo_ros2_control.so"),
            ("gz-sim ros2_control", GZ, "gz_ros2_control-system"),
        )
    ),
)
