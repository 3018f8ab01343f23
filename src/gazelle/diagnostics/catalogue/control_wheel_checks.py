"""Codes of the comparison of wheels' parameters with the robot's geometry."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "control.wheel-geometry",
        "warning",
        "A base's wheel parameters disagree with the robot's geometry",
        "Commands and odometry are computed from the parameters, the motion comes from the wheels. "
        "Multipliers are left aside: they are for calibration.",
        "write the geometry's values, calibrate with the multipliers",
        "odometry drifts; robot turns too little or too much",
    ),
)
