"""Actions that the launch files of MoveIt config packages are made of."""

from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


class DeclareBooleanLaunchArg(DeclareLaunchArgument):
    """An argument that is true or false."""

    def __init__(self, name, *, default_value=False, description=None, **kwargs):
        choices = ["true", "false", "True", "False"]
        super().__init__(
            name,
            default_value=str(default_value),
            description=description,
            choices=choices,
            **kwargs,
        )


def add_debuggable_node(
    ld,
    package,
    executable,
    condition_name="debug",
    commands_file=None,
    extra_debug_args=None,
    **kwargs,
):
    """Add a node twice: as it is, and under gdb when the argument `condition_name` is true."""
    debugging = LaunchConfiguration(condition_name)
    ld.add_action(
        Node(package=package, executable=executable, condition=UnlessCondition(debugging), **kwargs)
    )
    commands = f"-x {commands_file} " if commands_file else ""
    options = dict(kwargs)
    arguments = options.pop("arguments", None)
    if arguments is not None and extra_debug_args:
        arguments = [*arguments, *extra_debug_args]
    ld.add_action(
        Node(
            package=package,
            executable=executable,
            condition=IfCondition(debugging),
            prefix=[f"gdb {commands}--ex run --args"],
            arguments=arguments,
            **options,
        )
    )
