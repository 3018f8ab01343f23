"""A world of the new Gazebo: ``gz_args`` are the words behind ``gz sim``."""

from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction, Shutdown
from launch.substitutions import LaunchConfiguration

from launch import LaunchDescription


def generate_launch_description():
    """Return the arguments and the process."""
    declared = [
        ("gz_args", "", "words behind gz sim, such as '-r shapes.sdf'"),
        ("gz_version", "8", "accepted; there is one version"),
        ("ign_args", "", "the older name of gz_args"),
        ("ign_version", "", "the older name of gz_version"),
        ("debugger", "false", "accepted; there is nothing to attach a debugger to"),
        ("on_exit_shutdown", "false", "end the launch when the world ends"),
    ]
    arguments = [
        DeclareLaunchArgument(name, default_value=value, description=text)
        for name, value, text in declared
    ]
    return LaunchDescription([*arguments, OpaqueFunction(function=_start)])


def _start(context):
    def value(name):
        return LaunchConfiguration(name).perform(context)

    command = "ign gazebo" if value("ign_args") and not value("gz_args") else "gz sim"
    on_exit = Shutdown() if value("on_exit_shutdown") != "false" else None
    return [
        ExecuteProcess(  # noqa: S604 - by a shell, as the original
            # One line for a shell, which is how quotes and $VARIABLES in the arguments count.
            cmd=[f"exec {command}", value("gz_args") or value("ign_args")],
            name="gazebo",
            output="screen",
            shell=True,
            on_exit=on_exit,
        )
    ]
