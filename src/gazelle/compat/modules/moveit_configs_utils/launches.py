"""The launch descriptions that MoveIt's Setup Assistant lets packages refer to."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from moveit_configs_utils.launch_utils import DeclareBooleanLaunchArg, add_debuggable_node
from srdfdom.srdf import SRDF


def generate_rsp_launch(moveit_config):
    """Publish the robot's transforms: robot_state_publisher."""
    return LaunchDescription(
        [
            DeclareLaunchArgument("publish_frequency", default_value="15.0"),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                respawn=True,
                output="screen",
                parameters=[
                    moveit_config.robot_description,
                    {"publish_frequency": LaunchConfiguration("publish_frequency")},
                ],
            ),
        ]
    )


def generate_moveit_rviz_launch(moveit_config):
    """Show the robot in RViz, with the package's view."""
    view = str(moveit_config.package_path / "config/moveit.rviz")
    ld = LaunchDescription(
        [
            DeclareBooleanLaunchArg("debug", default_value=False),
            DeclareLaunchArgument("rviz_config", default_value=view),
        ]
    )
    add_debuggable_node(
        ld,
        package="rviz2",
        executable="rviz2",
        output="log",
        respawn=False,
        arguments=["-d", LaunchConfiguration("rviz_config")],
        parameters=[
            moveit_config.planning_pipelines,
            moveit_config.robot_description_kinematics,
        ],
    )
    return ld


def generate_setup_assistant_launch(moveit_config):
    """Open the package in MoveIt's Setup Assistant."""
    ld = LaunchDescription([DeclareBooleanLaunchArg("debug", default_value=False)])
    add_debuggable_node(
        ld,
        package="moveit_setup_assistant",
        executable="moveit_setup_assistant",
        arguments=[["--config_pkg=", str(moveit_config.package_path)]],
    )
    return ld


def generate_static_virtual_joint_tfs_launch(moveit_config):
    """Publish where the virtual joints of the SRDF hold the robot."""
    texts = moveit_config.robot_description_semantic.values()
    joints = [joint for text in texts for joint in SRDF.from_xml_string(text).virtual_joints]
    ld = LaunchDescription()
    for number, joint in enumerate(joints):
        frames = ["--frame-id", joint.parent_frame, "--child-frame-id", joint.child_link]
        ld.add_action(
            Node(
                package="tf2_ros",
                executable="static_transform_publisher",
                name=f"static_transform_publisher{number}",
                output="log",
                arguments=frames,
            )
        )
    return ld


def generate_spawn_controllers_launch(moveit_config):
    """Spawn the controllers that MoveIt sends trajectories to, and the joint state broadcaster."""
    manager = moveit_config.trajectory_execution.get("moveit_simple_controller_manager", {})
    ld = LaunchDescription()
    for controller in [*manager.get("controller_names", []), "joint_state_broadcaster"]:
        ld.add_action(
            Node(
                package="controller_manager",
                executable="spawner",
                arguments=[controller],
                output="screen",
            )
        )
    return ld


def generate_warehouse_db_launch(moveit_config):
    """Run the data base of scenes and states; it is compiled code that Gazelle does not have."""
    path = str(moveit_config.package_path / "default_warehouse_mongo_db")
    return LaunchDescription(
        [
            DeclareLaunchArgument("moveit_warehouse_database_path", default_value=path),
            DeclareBooleanLaunchArg("reset", default_value=False),
            DeclareLaunchArgument("moveit_warehouse_port", default_value="33829"),
            DeclareLaunchArgument("moveit_warehouse_host", default_value="localhost"),
            Node(
                package="warehouse_ros_mongo",
                executable="mongo_wrapper_ros.py",
                parameters=[
                    {
                        "overwrite": False,
                        "database_path": LaunchConfiguration("moveit_warehouse_database_path"),
                        "warehouse_port": LaunchConfiguration("moveit_warehouse_port"),
                        "warehouse_host": LaunchConfiguration("moveit_warehouse_host"),
                        "warehouse_exec": "mongod",
                        "warehouse_plugin": "warehouse_ros_mongo::MongoDatabaseConnection",
                    }
                ],
            ),
            Node(
                package="moveit_ros_warehouse",
                executable="moveit_init_demo_warehouse",
                output="screen",
                condition=IfCondition(LaunchConfiguration("reset")),
            ),
        ]
    )


def generate_move_group_launch(moveit_config):
    """Run move_group with everything the package has."""
    ld = LaunchDescription(
        [
            DeclareBooleanLaunchArg("debug", default_value=False),
            DeclareBooleanLaunchArg("allow_trajectory_execution", default_value=True),
            DeclareBooleanLaunchArg("publish_monitored_planning_scene", default_value=True),
            # Capabilities besides the usual ones, and those that are left out; space separated.
            DeclareLaunchArgument("capabilities", default_value=_capability(moveit_config, "")),
            DeclareLaunchArgument(
                "disable_capabilities", default_value=_capability(moveit_config, "disable_")
            ),
            DeclareBooleanLaunchArg("monitor_dynamics", default_value=False),
        ]
    )
    publishing = LaunchConfiguration("publish_monitored_planning_scene")
    configuration = {
        "publish_robot_description_semantic": True,
        "allow_trajectory_execution": LaunchConfiguration("allow_trajectory_execution"),
        # As values of type text, for both may be empty.
        "capabilities": ParameterValue(LaunchConfiguration("capabilities"), value_type=str),
        "disable_capabilities": ParameterValue(
            LaunchConfiguration("disable_capabilities"), value_type=str
        ),
        "publish_planning_scene": publishing,
        "publish_geometry_updates": publishing,
        "publish_state_updates": publishing,
        "publish_transforms_updates": publishing,
        "monitor_dynamics": False,
    }
    add_debuggable_node(
        ld,
        package="moveit_ros_move_group",
        executable="move_group",
        commands_file=str(moveit_config.package_path / "launch" / "gdb_settings.gdb"),
        output="screen",
        parameters=[moveit_config.to_dict(), configuration],
        extra_debug_args=["--debug"],
        additional_env={"DISPLAY": ":0"},
    )
    return ld


def generate_demo_launch(moveit_config):
    """Run everything on simulated hardware: transforms, move_group, RViz, controllers."""
    folder = moveit_config.package_path
    ld = LaunchDescription(
        [
            DeclareBooleanLaunchArg(
                "db",
                default_value=False,
                description="By default, we do not start a database (it can be large)",
            ),
            DeclareBooleanLaunchArg(
                "debug",
                default_value=False,
                description="By default, we are not in debug mode",
            ),
            DeclareBooleanLaunchArg("use_rviz", default_value=True),
        ]
    )
    if (folder / "launch/static_virtual_joint_tfs.launch.py").exists():
        ld.add_action(_included(folder, "static_virtual_joint_tfs"))
    ld.add_action(_included(folder, "rsp"))
    ld.add_action(_included(folder, "move_group"))
    ld.add_action(_included(folder, "moveit_rviz", "use_rviz"))
    ld.add_action(_included(folder, "warehouse_db", "db"))
    ld.add_action(
        Node(
            package="controller_manager",
            executable="ros2_control_node",
            parameters=[
                moveit_config.robot_description,
                str(folder / "config/ros2_controllers.yaml"),
            ],
        )
    )
    ld.add_action(_included(folder, "spawn_controllers"))
    return ld


def _capability(moveit_config, prefix):
    return moveit_config.move_group_capabilities.get(f"{prefix}capabilities", "")


def _included(folder, name, argument=None):
    source = PythonLaunchDescriptionSource(str(folder / f"launch/{name}.launch.py"))
    condition = None if argument is None else IfCondition(LaunchConfiguration(argument))
    return IncludeLaunchDescription(source, condition=condition)
