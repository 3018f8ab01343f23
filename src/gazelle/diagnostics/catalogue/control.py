"""Codes of the control layer: parameters of controllers."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "control.bad-value",
        "warning",
        "A controller's parameter has the wrong type",
        "The value cannot be read as what the controller needs; its default is used.",
        "write a value of the right type",
        "Could not load parameter",
    ),
    Entry(
        "control.double-parameter",
        "warning",
        "A parameter file has a key twice",
        "YAML keeps the last one and says nothing.",
        "remove one of them",
    ),
    Entry(
        "control.idle-parameter",
        "info",
        "A controller's parameter has no effect",
        "The key is known and changes nothing here; the message says why.",
        "remove it",
        idle=True,
    ),
    Entry(
        "control.parameters-of-others",
        "warning",
        "The parameter files are for nodes of another namespace",
        "Names of ROS 2 parameter files are full names: controller_manager is not the"
        " /robot1/controller_manager of a robot in a namespace.",
        "write /**/controller_manager",
        "The 'type' param was not defined for",
    ),
    Entry(
        "control.no-ros-parameters",
        "warning",
        "A parameter file of ROS 2 lacks ros__parameters",
        "Such files are written node by node, the parameters below ros__parameters. Gazelle reads"
        " the file as ROS 1 wrote them; real ROS 2 would refuse it.",
        "add the level: name: / ros__parameters: / parameters",
        "Cannot have a value before ros__parameters",
    ),
    Entry(
        "control.parameter-file",
        "error",
        "A parameter file cannot be read",
        "It is missing, not UTF-8, not YAML, or has a value no parameter can have.",
        "mend the file at the place given",
        "failed to parse yaml params file",
    ),
    Entry(
        "control.number-as-text",
        "warning",
        "A number of a controller is written as text",
        "YAML 1.1 reads 1e-3 as a text, and ROS would leave the parameter out. Gazelle takes the"
        " number.",
        "write 0.001 or 1.0e-3",
        "Could not load parameter",
    ),
    Entry(
        "control.unknown-parameter",
        "warning",
        "A controller does not know a parameter",
        "A mistyped key changes nothing in ROS and nobody says so.",
        "use the name of the controller's table",
    ),
)
