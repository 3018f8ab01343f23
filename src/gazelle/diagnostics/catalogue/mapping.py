"""Codes of logs of robots, and of mapping."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "mapping.bad-line",
        "warning",
        "A line of a log cannot be read",
        "A number is missing or is none, so the line says nothing certain; the others are used.",
        "delete the line, or write it as the format says",
    ),
    Entry(
        "mapping.lua",
        "error",
        "A configuration of cartographer is not understood",
        "Configurations are Lua: assignments, tables, arithmetic, functions and include; loops are "
        "not. The file has to return its table of options.",
        "write it as cartographer_ros' own configurations are",
        "Check failed: status == 0",
    ),
    Entry(
        "mapping.no-scans",
        "error",
        "A log holds no scans with odometry",
        "Mapping needs both: scans of a lidar, and where odometry saw the robot at those times.",
        "record the scan topic together with /tf (or /odom), or name the scan topic",
    ),
    Entry(
        "mapping.log-unreadable",
        "error",
        "A log is in no format that is known",
        "Known are CARMEN logs (FLASER, ROBOTLASER1), numpy archives with t, scans and odo, and "
        "bags.",
        "convert it to a CARMEN log or to a bag",
    ),
    Entry(
        "mapping.stamps",
        "warning",
        "Stamps of a log do not tell the time",
        "Scans are taken in the order of the file, so the map is none the worse; how long it "
        "lasted is not known, and relations that are given by time are not found.",
        "convert the log again, or record it on a machine whose clock is not set on the way",
    ),
    Entry(
        "mapping.scan-without-pose",
        "warning",
        "Scans could not be placed by odometry",
        "No transform from odometry's frame to the lidar was known at their times.",
        "publish the transform of the lidar's frame, and odometry, while scans are recorded",
        "MessageFilter: Dropped 100.00% of messages so far",
    ),
)
