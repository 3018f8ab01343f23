"""What shows the running world."""

import shlex

from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction, Shutdown
from launch.substitutions import LaunchConfiguration

from launch import LaunchDescription

SWITCHES = {"version": "print the version and end", "verbose": "tell more"}
SWITCHES["help"] = "print the options and end"


def generate_launch_description():
    """Return the arguments and the process."""
    declared = [
        *((name, "false", text) for name, text in SWITCHES.items()),
        ("extra_gazebo_args", "", "more options"),
        ("gdb", "false", "accepted; there is nothing to attach a debugger to"),
        ("valgrind", "false", "accepted; there is nothing to watch the memory of"),
        ("gui_required", "false", "end the launch when the view is closed"),
    ]
    arguments = [
        DeclareLaunchArgument(name, default_value=value, description=text)
        for name, value, text in declared
    ]
    return LaunchDescription([*arguments, OpaqueFunction(function=_start)])


def _start(context):
    def value(name):
        return LaunchConfiguration(name).perform(context)

    command = ["gzclient", *(f"--{name}" for name in SWITCHES if value(name).lower() == "true")]
    command += shlex.split(value("extra_gazebo_args"))
    on_exit = Shutdown() if value("gui_required").lower() == "true" else None
    return [ExecuteProcess(cmd=command, output="screen", on_exit=on_exit)]
