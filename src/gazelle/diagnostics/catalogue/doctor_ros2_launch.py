"""Codes of the doctor: what a static reading of ROS 2 launch files shows."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "launch_ros2.static",
        "info",
        "A launch file of ROS 2 was read without running it",
        "Launch files in Python are programs. The doctor follows their plain parts and executes"
        " nothing; what it cannot follow is left out of its checks.",
        "give launch arguments as name:=value to follow other branches",
    ),
    Entry(
        "launch_ros2.unreadable",
        "error",
        "A launch file of ROS 2 cannot be read",
        "It is no Python 3, or has no generate_launch_description().",
        "mend it at the place shown",
        "Caught exception when trying to load file of format [py]",
    ),
    Entry(
        "launch_ros2.package-missing",
        "error",
        "A launch file names a package that is not there",
        "There is none of this name, and one that is nearly the same.",
        "correct the name",
        "PackageNotFoundError: package not found, searching: ",
    ),
    Entry(
        "launch_ros2.packages-elsewhere",
        "info",
        "A launch file uses packages of another place",
        "They are not in this workspace; a real ROS may have them installed.",
        "nothing, or add them to the workspace",
    ),
    Entry(
        "launch_ros2.file-missing",
        "error",
        "A launch file names a file that its package does not have",
        "The path leads nowhere, in the source folder and after installing.",
        "correct the path",
        "FileNotFoundError: [Errno 2] No such file or directory",
    ),
    Entry(
        "launch_ros2.executable-missing",
        "error",
        "A node's executable does not exist",
        "ROS 2 looks into lib/<package>, where build files and entry points put programs.",
        "correct the name, or install the program",
        "SubstitutionFailure: executable not found on the libexec directory",
    ),
    Entry(
        "launch_ros2.argument-undeclared",
        "error",
        "A launch configuration is read and never declared",
        "Launch stops when the configuration is asked for.",
        "declare it with DeclareLaunchArgument",
        "launch configuration does not exist",
    ),
    Entry(
        "launch_ros2.argument-unknown",
        "warning",
        "A launch argument is given that the file does not declare",
        "ROS 2 sets it and nothing reads it; there is one of nearly the same name.",
        "correct the name",
    ),
    Entry(
        "launch_ros2.argument-idle",
        "info",
        "A launch argument is declared and never read",
        "Giving it a value changes nothing.",
        "read it with LaunchConfiguration, or take it out",
    ),
    Entry(
        "launch_ros2.controller-missing",
        "warning",
        "A spawner asks for a controller that is not configured",
        "The controller manager has no type for it.",
        "use the name of the parameter file",
        "The 'type' param was not defined for",
    ),
    Entry(
        "launch_ros2.clocks",
        "warning",
        "Nodes run on the wall clock beside a simulator",
        "Their stamps and those of simulated sensors and transforms are decades apart.",
        "set use_sim_time for every node",
        "Lookup would require extrapolation into the past",
    ),
    Entry(
        "launch_ros2.command-words",
        "error",
        "The words of a Command run into each other",
        "Command joins its parts as they are.",
        "end the program's name with a blank",
        "executed command failed",
    ),
    Entry(
        "launch_ros2.unwrapped-command",
        "warning",
        "The output of a Command is read as YAML",
        "launch_ros tries to parse the value of a parameter that is not marked as a text, and a"
        " colon before a space makes a mapping of a robot description.",
        "ParameterValue(Command(…), value_type=str)",
        "Unable to parse the value of parameter robot_description as yaml",
    ),
)
