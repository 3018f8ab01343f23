"""Codes of parameters: their files, their values, and the names they share with robots."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

_VALUES = (
    Entry(
        "parameter.bad-value",
        "warning",
        "A parameter has a value of the wrong kind, beyond its limits, or none of those known",
        "The value cannot be read as what its controller, plug-in or node needs. Its default is"
        " used, as ROS and Gazebo do without a word, or stop.",
        "write a value as the message says",
    ),
    Entry(
        "parameter.idle",
        "info",
        "A parameter is known and has no effect here",
        "The original reads it; what it changes there does not exist here, or it changes nothing"
        " there either. The message says which.",
        "nothing to do; it can be removed",
        idle=True,
    ),
    Entry(
        "parameter.number-as-text",
        "warning",
        "A number is written as text",
        "YAML 1.1 reads 1e-3 as a text, and ROS would leave the parameter out. Gazelle takes the"
        " number.",
        "write 0.001 or 1.0e-3",
        "Could not load parameter",
    ),
    Entry(
        "parameter.unknown",
        "warning",
        "A controller, plug-in or node has no parameter of this name",
        "ROS and Gazebo read the names they know and never look at the others, so a mistyped one"
        " changes nothing and nobody says so: the default is used instead.",
        "correct the name, or take it out",
    ),
)

_FILES = (
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
        "parameters.controller-type",
        "error",
        "A controller's type is misspelt",
        "There is none of this name, and one that is nearly the same; or the key is not `type`.",
        "correct the type",
        "Could not load class; The 'type' param was not defined",
    ),
    Entry(
        "parameters.gains-joint",
        "warning",
        "Gains or constraints of a controller name a joint that it does not move",
        "They are listed by joint, and this name is nearly that of one of the controller's.",
        "correct the joint's name",
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

ENTRIES = (*_VALUES, *_FILES)
