"""A world, empty unless ``world`` names one, with the arguments that launch files count on."""

import shlex

from launch.actions import (
    DeclareLaunchArgument,
    ExecuteProcess,
    LogInfo,
    OpaqueFunction,
    Shutdown,
)
from launch.substitutions import LaunchConfiguration

from launch import LaunchDescription

# Arguments that are options without a value when they are true.
SWITCHES = {
    "version": "print the version and end",
    "verbose": "tell more",
    "lockstep": "let time wait for sensors",
    "help": "print the options and end",
    "pause": "wait for play",
    "record": "write a state log",
    "minimal_comms": "no longer has an effect",
}
# Arguments that are options with a value when they are not empty.
VALUES = {
    "initial_sim_time": "seconds to begin with",
    "physics": "the engine asked for",
    "play": "a state log to play",
    "record_encoding": "of the state log",
    "record_path": "of the state log",
    "record_period": "of the state log",
    "record_filter": "of the state log",
    "seed": "of all noise",
    "iters": "end after so many steps",
    "profile": "settings of the physics",
}
# Plug-ins of gazebo_ros.
PLUGINS = {"init": "true", "factory": "true", "force_system": "true", "state": "false"}


def generate_launch_description():
    """Return the arguments and the process."""
    declared = [
        ("world", "worlds/empty.world", "a path, or a name on GAZEBO_RESOURCE_PATH"),
        *((name, "false", text) for name, text in SWITCHES.items()),
        *((name, "", text) for name, text in VALUES.items()),
        *((name, yes, f"load libgazebo_ros_{name}.so") for name, yes in PLUGINS.items()),
        ("extra_gazebo_args", "", "more options"),
        ("params_file", "", "a file of parameters"),
        ("gdb", "false", "accepted; there is nothing to attach a debugger to"),
        ("valgrind", "false", "accepted; there is nothing to watch the memory of"),
        ("server_required", "false", "end the launch when the world ends"),
    ]
    arguments = [
        DeclareLaunchArgument(name, default_value=value, description=text)
        for name, value, text in declared
    ]
    return LaunchDescription([*arguments, OpaqueFunction(function=_start)])


def _start(context):
    given = _Given(context)
    command = ["gzserver", *shlex.split(given["world"])]
    command += [f"--{name}" for name in SWITCHES if given.says_yes(name)]
    command += [f"--{name}={given[name]}" for name in VALUES if given[name]]
    for name in PLUGINS:
        if given.says_yes(name):
            command += ["-s", f"libgazebo_ros_{name}.so"]
    if given["params_file"]:
        command += ["--ros-args", "--params-file", given["params_file"], "--"]
    command += shlex.split(given["extra_gazebo_args"])
    on_exit = Shutdown() if given.says_yes("server_required") else None
    tools = [name for name in ("gdb", "valgrind") if given.says_yes(name)]
    said = [LogInfo(msg=f"{name} is not started: gzserver is written in Python") for name in tools]
    return [*said, ExecuteProcess(cmd=command, output="both", on_exit=on_exit)]


class _Given:
    """The arguments' values."""

    def __init__(self, context):
        self._context = context

    def __getitem__(self, name):
        return LaunchConfiguration(name).perform(self._context)

    def says_yes(self, name):
        return self[name].lower() == "true"
