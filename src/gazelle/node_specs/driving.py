"""Joysticks, keyboards, choosing among velocities, and the nodes of TurtleBot3."""

from __future__ import annotations

from gazelle.node_specs.spec import ROS_1, ROS_2, NodeName, NodeSpec

__all__ = ["DRIVING"]

DRIVING = (
    NodeSpec(
        package="turtlebot3_fake",
        executable="turtlebot3_fake_node",
        ros=ROS_1,
        entry="gazelle.nodes.turtlebot3.fake:run",
        does="a TurtleBot3 that drives without physics",
        is_light=True,
    ),
    NodeSpec(
        package="turtlebot3_fake_node",
        executable="turtlebot3_fake_node",
        ros=ROS_2,
        entry="gazelle.nodes.turtlebot3.fake:run_ros2",
        does="a TurtleBot3 that drives without physics, ROS 2's package",
        is_light=True,
    ),
    NodeSpec(
        package="turtlebot3_gazebo",
        executable="turtlebot3_drive",
        entry="gazelle.nodes.turtlebot3.drive:run",
        does="wanders about without bumping into things",
        is_light=True,
    ),
    NodeSpec(
        package="turtlebot3_slam",
        executable="flat_world_imu_node",
        ros=ROS_1,
        entry="gazelle.nodes.turtlebot3.flat_world_imu:run",
        does="makes an IMU's accelerations those of flat ground",
        is_light=True,
    ),
    NodeSpec(
        package="turtlebot3_teleop",
        executable="turtlebot3_teleop_key",
        ros=ROS_1,
        entry="gazelle.nodes.turtlebot3.teleop:run",
        does="drives a TurtleBot3 from the keyboard",
        is_light=False,
        name="turtlebot3_teleop",
    ),
    NodeSpec(
        package="turtlebot3_teleop",
        executable="teleop_keyboard",
        ros=ROS_2,
        entry="gazelle.nodes.turtlebot3.teleop:run_ros2",
        does="drives a TurtleBot3 from the keyboard, ROS 2's name",
        is_light=False,
    ),
    NodeSpec(
        package="teleop_twist_keyboard",
        executable="teleop_twist_keyboard.py",
        ros=ROS_1,
        entry="gazelle.nodes.teleop.twist_keyboard:run",
        does="drives any robot from the keyboard",
        is_light=False,
        name="teleop_twist_keyboard",
    ),
    NodeSpec(
        package="teleop_twist_keyboard",
        executable="teleop_twist_keyboard",
        ros=ROS_2,
        entry="gazelle.nodes.teleop.twist_keyboard:run_ros2",
        does="drives any robot from the keyboard, ROS 2's name",
        is_light=False,
    ),
    NodeSpec(
        package="twist_mux",
        executable="twist_mux",
        entry="gazelle.nodes.twist_mux.mux:run",
        does="passes on one of several velocity commands, by priorities, time-outs and locks",
        is_light=True,
    ),
    NodeSpec(
        package="twist_mux",
        executable="twist_marker",
        entry="gazelle.nodes.twist_mux.marker:run",
        does="shows a velocity command as an arrow",
        is_light=True,
    ),
    NodeSpec(
        package="twist_mux",
        executable="joystick_relay.py",
        entry="gazelle.nodes.twist_mux.relay:run",
        does="makes velocities of a joystick's shares, in steps, while it has priority",
        is_light=True,
        aliases=(NodeName("twist_mux", "joystick_relay", ROS_2),),
        name="joystick_relay",
    ),
    NodeSpec(
        package="joy",
        executable="joy_node",
        entry="gazelle.nodes.joy.node:run",
        does="publishes what a joystick does",
        is_light=True,
        aliases=(NodeName("joy_linux", "joy_linux_node", ROS_2),),
    ),
    NodeSpec(
        package="joy",
        executable="joy_enumerate_devices",
        ros=ROS_2,
        entry="gazelle.nodes.joy.node:list_devices",
        does="lists joysticks",
        is_light=True,
    ),
    NodeSpec(
        package="teleop_twist_joy",
        executable="teleop_node",
        entry="gazelle.nodes.teleop.joystick:run",
        does="drives any robot by a joystick",
        is_light=True,
        name="teleop_twist_joy_node",
    ),
)
