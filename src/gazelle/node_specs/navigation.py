"""What drives to goals around obstacles, and the motions of arms."""

from __future__ import annotations

from gazelle.node_specs.spec import ROS_1, ROS_2, NodeName, NodeSpec

__all__ = ["NAVIGATION"]

NAVIGATION = (
    NodeSpec(
        package="move_base",
        executable="move_base",
        ros=ROS_1,
        entry="gazelle.nodes.move_base.node:run",
        does="drives to goals around obstacles",
        is_light=False,
    ),
    NodeSpec(
        package="moveit_ros_move_group",
        executable="move_group",
        entry="gazelle.nodes.move_group:run",
        does="plans and executes motions of arms, as MoveIt does",
        is_light=False,
    ),
    NodeSpec(
        package="nav2_planner",
        executable="planner_server",
        ros=ROS_2,
        entry="gazelle.nodes.nav2.planner_server:run",
        does="plans paths (Nav2)",
        is_light=False,
    ),
    NodeSpec(
        package="nav2_controller",
        executable="controller_server",
        ros=ROS_2,
        entry="gazelle.nodes.nav2.controller_server:run",
        does="follows paths (Nav2)",
        is_light=False,
    ),
    NodeSpec(
        package="nav2_behaviors",
        executable="behavior_server",
        ros=ROS_2,
        entry="gazelle.nodes.nav2.behavior_server:run",
        does="spins, backs up, waits (Nav2)",
        is_light=False,
        aliases=(NodeName("nav2_recoveries", "recoveries_server", ROS_2),),
    ),
    NodeSpec(
        package="nav2_bt_navigator",
        executable="bt_navigator",
        ros=ROS_2,
        entry="gazelle.nodes.nav2.bt_navigator:run",
        does="drives to poses by behaviour trees (Nav2)",
        is_light=False,
    ),
    NodeSpec(
        package="nav2_waypoint_follower",
        executable="waypoint_follower",
        ros=ROS_2,
        entry="gazelle.nodes.nav2.waypoint_follower:run",
        does="drives to one pose after another (Nav2)",
        is_light=False,
    ),
    NodeSpec(
        package="nav2_smoother",
        executable="smoother_server",
        ros=ROS_2,
        entry="gazelle.nodes.nav2.smoother_server:run",
        does="smooths paths (Nav2)",
        is_light=False,
    ),
    NodeSpec(
        package="nav2_velocity_smoother",
        executable="velocity_smoother",
        ros=ROS_2,
        entry="gazelle.nodes.nav2.velocity_smoother:run",
        does="limits accelerations of commands (Nav2)",
        is_light=False,
    ),
    NodeSpec(
        package="nav2_collision_monitor",
        executable="collision_monitor",
        ros=ROS_2,
        entry="gazelle.nodes.nav2.collision_monitor:run",
        does="slows or stops commands by what sensors see (Nav2)",
        is_light=False,
    ),
    NodeSpec(
        package="nav2_lifecycle_manager",
        executable="lifecycle_manager",
        ros=ROS_2,
        entry="gazelle.nodes.nav2.lifecycle_manager:run",
        does="brings managed nodes up and down (Nav2)",
        is_light=False,
    ),
)
