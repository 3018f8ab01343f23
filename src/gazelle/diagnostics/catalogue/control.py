"""Codes of the control layer: parameters of controllers."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "control.double-parameter",
        "warning",
        "A parameter file has a key twice",
        "YAML keeps the last one and says nothing.",
        "remove one of them",
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
)
