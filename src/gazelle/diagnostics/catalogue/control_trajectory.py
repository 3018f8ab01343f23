"""Codes of the trajectory controllers."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "control.idle-gains",
        "info",
        "Gains of a controller have no effect",
        "A controller that commands positions hands them on; nothing computes a PID with the gains."
        " How stiffly the joint follows is the hardware's business.",
        "command 'effort' or 'velocity' to use the gains, or remove them",
        "No p gain specified for pid",
        idle=True,
    ),
    Entry(
        "control.no-deceleration",
        "warning",
        "A trajectory controller cannot decelerate when it is cancelled",
        "decelerate_on_cancel needs a deceleration and a velocity limit of each joint, and measured"
        " velocities. Without them the position is held at once.",
        "give constraints.<joint>.max_deceleration_on_cancel, <limit velocity=…> and the state"
        " interface velocity",
        "Falling back to hold position on cancel",
    ),
)
