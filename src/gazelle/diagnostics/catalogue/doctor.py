"""Codes of the doctor: what shows only when all files of a launch are looked at together."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "doctor.unreadable",
        "error",
        "A file cannot be read",
        "Nothing that needs it can work.",
        "let yourself read it: chmod u+r FILE",
        "Permission denied",
    ),
    Entry(
        "doctor.unknown-file",
        "error",
        "A file is of no kind that can be examined",
        "The doctor reads robots (URDF, xacro, SDF), worlds, models, launch files, SRDF, YAML "
        "parameters and packages.",
        "name one of those",
    ),
    Entry(
        "doctor.nothing",
        "warning",
        "There is nothing to examine",
        "The folder holds no file of a kind that the doctor knows.",
        "name a package, a folder with robots, worlds or launch files, or a file",
    ),
)
