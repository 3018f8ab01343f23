"""Codes of reading parameters: of controllers, plug-ins and nodes alike."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
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
