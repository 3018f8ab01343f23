"""Codes of finding packages, models and files."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "workspace.bad-manifest",
        "warning",
        "A package.xml cannot be read or is incomplete",
        "The package is used under its folder's name, without its exports and dependencies.",
        "correct package.xml at the place shown",
        "Error: could not parse package.xml",
    ),
    Entry(
        "workspace.duplicate-package",
        "warning",
        "Two packages of one source tree have the same name",
        "The one whose folder comes first counts; which one ROS takes is a matter of chance.",
        "remove one, or put a file CATKIN_IGNORE (ROS 2: COLCON_IGNORE) into its folder",
        "Multiple packages found with the same name",
    ),
)
