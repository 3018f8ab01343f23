"""Codes of the doctor: parameter files, and the names they share with robots."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "parameters.layout",
        "error",
        "A parameter file of ROS 2 is not laid out as node, ros__parameters, parameters",
        "ROS 2's parser refuses the whole file for one such line; Gazelle reads what it can.",
        "put all values below ros__parameters",
        "Cannot have a value before ros__parameters",
    ),
    Entry(
        "parameters.empty",
        "error",
        "ros__parameters has nothing below it",
        "ROS 2's parser refuses the whole file, and no node that gets it starts.",
        "write ros__parameters: {}",
        "Couldn't parse params file: No value at line",
    ),
    Entry(
        "parameters.ros2-layout",
        "warning",
        "A parameter file of ROS 2 is loaded by ROS 1",
        "roslaunch takes every level for a name; Gazelle looks through ros__parameters.",
        "take the level out",
        "Could not load controller because the type was not specified",
    ),
    Entry(
        "parameters.word-as-flag",
        "warning",
        "A name is read as a truth value",
        "YAML 1.1 has yes, no, on and off for true and false; ROS 2's parser y and n too.",
        "put the name in quotes",
        "Sequence should be of same type. Value type 'bool' do not belong",
    ),
    Entry(
        "parameters.number-form",
        "warning",
        "A number is read as another one",
        "A 0 in front makes a number octal; for roslaunch a colon makes it one to the base 60.",
        "write the number plainly, or a text with quotes",
    ),
    Entry(
        "parameters.mixed-list",
        "error",
        "A list of a ROS 2 parameter has values of several types",
        "Parameters of ROS 2 are lists of one type; 1 and 1.0 are two.",
        "write all numbers with a point",
        "Sequence should be of same type",
    ),
    Entry(
        "parameters.wrong-type",
        "warning",
        "A parameter of ROS 2 has the wrong type of number",
        "Nodes declare their parameters with a type, and 1 is no double there. Gazelle takes it.",
        "write 1.0 for a double, 1 for an integer",
        "parameter has invalid type: Wrong parameter type",
    ),
    Entry(
        "parameters.colon-in-description",
        "warning",
        "A robot description is no plain text for YAML",
        "ros2_control's plug-ins of Gazebo pass it on as YAML, and a colon before a space makes a"
        " mapping of it (gazebo_ros2_control#295). Gazelle passes it as it is.",
        "take the colon out of the comment",
        "Couldn't parse parameter override rule",
    ),
    Entry(
        "parameters.interface-claim",
        "warning",
        "A controller needs an interface that its joint does not have",
        "A controller's type or its command_interfaces say what it commands; transmission or"
        " <ros2_control> say what there is.",
        "use one and the same interface in both files",
        "Could not find resource in hardware_interface; Command interface does not exist",
    ),
    Entry(
        "parameters.srdf-name",
        "warning",
        "An SRDF names something that the robot does not have",
        "MoveIt prints an error and leaves the element out.",
        "use the names of the URDF",
        "is not known to URDF",
    ),
    Entry(
        "parameters.moveit-name",
        "warning",
        "A file of MoveIt names a joint or group that is not there",
        "The entry has no effect, and the joint or group that was meant has none.",
        "use the names of URDF and SRDF",
        "No kinematics solver instantiated for group",
    ),
)
