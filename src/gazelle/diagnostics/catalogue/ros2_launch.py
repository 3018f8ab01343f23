"""Codes of running launch files of ROS 2."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "ros2_launch.exception",
        "error",
        "A launch file raised an error",
        "The launch stops, as in ROS 2. The line shown is the innermost one of the user's files.",
        "mend it at the place shown; `ros2 launch --debug` prints the whole traceback",
        "Caught exception in launch (see debug for traceback)",
    ),
    Entry(
        "ros2_launch.argument-missing",
        "error",
        "A launch argument has neither value nor default",
        "The file declares it and does not run without it.",
        "give it as name:=value, or with launch_arguments of the include",
        "Included launch description missing required argument",
    ),
    Entry(
        "ros2_launch.argument-choice",
        "error",
        "A launch argument has a value that is none of its choices",
        "The file lists the values it may have.",
        "use one of them",
        "provided value is not valid. Valid options are",
    ),
    Entry(
        "ros2_launch.substitution",
        "error",
        "A substitution has no value",
        "What is asked for does not exist, or its command failed.",
        "declare the argument, set the variable, or run the command by hand",
        "SubstitutionFailure",
    ),
    Entry(
        "ros2_launch.bad-condition",
        "error",
        "A condition is neither true nor false",
        "IfCondition and UnlessCondition take true, false, 1 and 0.",
        "compare values with EqualsSubstitution or PythonExpression",
        "invalid condition expression, expected one of [true, 1, false, 0]",
    ),
    Entry(
        "ros2_launch.bad-element",
        "error",
        "A launch file in XML or YAML has an element or attribute that does not exist",
        "ROS 2 refuses the whole file.",
        "correct the name",
        "Unexpected attribute(s) found in",
    ),
    Entry(
        "ros2_launch.file-missing",
        "error",
        "A launch file does not exist",
        "The path leads nowhere.",
        "correct the path; package files are found with FindPackageShare",
        "[Errno 2] No such file or directory",
    ),
    Entry(
        "ros2_launch.bad-file",
        "error",
        "A file is no launch file",
        "It cannot be read as Python, XML or YAML, or it does not return a launch description.",
        "mend it at the place shown",
        "The launch file may have a syntax error, or its format is unknown",
    ),
    Entry(
        "ros2_launch.import",
        "error",
        "A launch file imports what is not here",
        "launch, launch_ros and message packages are here; other packages have to be in the "
        "workspace, or installed.",
        "correct the name, or put the package into the workspace",
        "ModuleNotFoundError: No module named",
    ),
    Entry(
        "ros2_launch.package-missing",
        "error",
        "A package that a launch file names is not found",
        "Packages are found in the workspace, among those that Gazelle brings, and in an "
        "installed ROS.",
        "correct the name, or put the package's sources into the workspace's src",
        "PackageNotFoundError: package not found, searching",
    ),
    Entry(
        "ros2_launch.executable-missing",
        "error",
        "The executable of a node does not exist",
        "Neither the package, nor the nodes of Gazelle, nor an installed ROS has it.",
        "correct executable=, or add the script: in scripts/ with an executable bit, or as "
        "console_scripts in setup.py",
        "executable not found on the libexec directory",
    ),
    Entry(
        "ros2_launch.bad-name",
        "error",
        "A node or namespace has a name that ROS does not allow",
        "Names are letters, digits and _, and do not begin with a digit.",
        "correct the name",
        "must not contain characters other than alphanumerics or '_'",
    ),
    Entry(
        "ros2_launch.parameter-value",
        "error",
        "A value is none that a parameter can have",
        "Parameters are bools, numbers, texts and lists of one of them; a text is read as YAML.",
        "a text that is no YAML, such as a robot description: ParameterValue(…, value_type=str) of "
        "launch_ros.parameter_descriptions",
        "If the parameter is meant to be a string, try wrapping it in",
    ),
    Entry(
        "ros2_launch.parameter-file",
        "warning",
        "A file of parameters does not exist",
        "The node starts without it, with its own defaults, as in ROS 2.",
        "correct the path",
        "Parameter file path is not a file",
    ),
    Entry(
        "ros2_launch.include-cycle",
        "error",
        "Launch files include each other without end",
        "The chain of includes is cut, ROS 2 would go on until Python's recursion limit.",
        "take one of the includes out, or give it a condition",
        "RecursionError: maximum recursion depth exceeded",
    ),
    Entry(
        "ros2_launch.process-not-started",
        "error",
        "A process of a launch file cannot be started",
        "The rest of the launch goes on, as in ROS 2.",
        "correct the name, or install the program",
        "exception occurred while executing process",
    ),
)
