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
        "control.idle-parameter",
        "info",
        "A controller's parameter has no effect",
        "The key is known and changes nothing here; the message says why.",
        "remove it",
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
