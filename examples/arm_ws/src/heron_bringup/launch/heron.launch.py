"""The workbench with arm, controllers and move_group; rviz:=true opens the view too."""

from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, RegisterEventHandler
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare
from moveit_configs_utils import MoveItConfigsBuilder

from launch import LaunchDescription


def generate_launch_description():
    moveit_config = MoveItConfigsBuilder("heron").to_moveit_configs()
    sim_time = {"use_sim_time": True}
    view = PathJoinSubstitution([FindPackageShare("heron_moveit_config"), "config", "moveit.rviz"])
    world = PathJoinSubstitution([FindPackageShare("heron_bringup"), "worlds", "workbench.world"])
    gazebo = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(
            PathJoinSubstitution([FindPackageShare("gazebo_ros"), "launch", "gazebo.launch.py"])
        ),
        launch_arguments={"world": world, "gui": LaunchConfiguration("gui")}.items(),
    )
    state_publisher = Node(
        package="robot_state_publisher",
        executable="robot_state_publisher",
        output="screen",
        parameters=[moveit_config.robot_description, sim_time],
    )
    spawn = Node(
        package="gazebo_ros",
        executable="spawn_entity.py",
        arguments=["-topic", "robot_description", "-entity", "heron"],
        output="screen",
    )
    controllers = Node(
        package="controller_manager",
        executable="spawner",
        arguments=["joint_state_broadcaster", "arm_controller", "hand_controller"],
        output="screen",
    )
    move_group = Node(
        package="moveit_ros_move_group",
        executable="move_group",
        output="screen",
        parameters=[moveit_config.to_dict(), sim_time],
    )
    rviz = Node(
        package="rviz2",
        executable="rviz2",
        output="log",
        arguments=["-d", view],
        parameters=[
            moveit_config.robot_description,
            moveit_config.robot_description_semantic,
            moveit_config.robot_description_kinematics,
            moveit_config.planning_pipelines,
            moveit_config.joint_limits,
            sim_time,
        ],
        condition=IfCondition(LaunchConfiguration("rviz")),
    )
    return LaunchDescription(
        [
            DeclareLaunchArgument("gui", default_value="false", description="open Gazebo's window"),
            DeclareLaunchArgument("rviz", default_value="false", description="open RViz"),
            gazebo,
            state_publisher,
            spawn,
            RegisterEventHandler(OnProcessExit(target_action=spawn, on_exit=[controllers])),
            RegisterEventHandler(
                OnProcessExit(target_action=controllers, on_exit=[move_group, rviz])
            ),
        ]
    )
