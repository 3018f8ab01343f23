"""Codes of PIDs in controllers."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "control.bad-gains",
        "error",
        "The bounds of a PID contradict each other",
        "control_toolbox skips such gains; here p, i and d are used, without integral.",
        "let i_clamp_min be at most i_clamp_max, and u_clamp_min at most u_clamp_max",
        "received i_min > i_max, skip new gains",
    ),
    Entry(
        "control.integral-without-clamp",
        "info",
        "A PID has an integral gain and no i_clamp",
        "In ROS 1 and in ROS 2 up to Iron i_clamp defaults to 0, which bounds the integral's part"
        " to nothing; newer ROS 2 leaves it unbounded. Gazelle does what the robot's generation"
        " does.",
        "write i_clamp (or i_clamp_max and i_clamp_min), or leave i out",
    ),
)
