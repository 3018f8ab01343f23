"""A view of Nav2."""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch.actions import DeclareLaunchArgument, EmitEvent, OpaqueFunction, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
from launch_ros.actions import Node
from nav2_common.bringup import RELATIVE_TF, arguments, is_true, value_of
from nav2_common.launch import ReplaceString

from launch import LaunchDescription

TOPICS = ("map", "goal_pose", "clicked_point", "initialpose")


def generate_launch_description():
    """Return the arguments and the view, whose end is that of the launch."""
    folder = Path(get_package_share_directory("nav2_bringup")) / "rviz"
    config = DeclareLaunchArgument(
        "rviz_config",
        default_value=str(folder / "nav2_default_view.rviz"),
        description="path of the file of displays",
    )
    own = {"namespace": "navigation", "use_namespace": "false", "use_sim_time": "false"}
    return LaunchDescription([*arguments(*own, **own), config, OpaqueFunction(function=_start)])


def _start(context):
    file, space, rules = value_of(context, "rviz_config"), None, []
    if is_true(context, "use_namespace"):
        space = value_of(context, "namespace")
        replacements = {"<robot_namespace>": f"/{space.strip('/')}"}
        file = ReplaceString(source_file=file, replacements=replacements).perform(context)
        rules = [*RELATIVE_TF, *((f"/{name}", name) for name in TOPICS)]
    view = Node(
        package="rviz2",
        executable="rviz2",
        namespace=space,
        arguments=["-d", file],
        parameters=[{"use_sim_time": is_true(context, "use_sim_time")}],
        remappings=rules,
        output="screen",
    )
    end = EmitEvent(event=Shutdown(reason="rviz exited"))
    return [view, RegisterEventHandler(OnProcessExit(target_action=view, on_exit=end))]
