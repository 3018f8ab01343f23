"""Codes of building workspaces."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "build.compiled-target",
        "warning",
        "A program or library of a package is not built",
        "Gazelle builds Python and data packages and has no compiler. Everything else of the"
        " package is installed.",
        "use a built-in node of Gazelle, a Python node, or build the package in real ROS",
        "No executable found; Couldn't find executable named",
    ),
    Entry(
        "build.unknown-type",
        "error",
        "A package has a build type that there are no rules for",
        "Its files are found from the source folder all the same.",
        "put ament_cmake, ament_python, catkin or cmake into <build_type>",
        "No task extension to 'build' a package",
    ),
    Entry(
        "build.cannot-write",
        "error",
        "A file of the build or install space cannot be written",
        "The folder belongs to somebody else, is read-only, or the disk is full.",
        "remove build and install, or choose others with --build-base and --install-base",
        "Permission denied",
    ),
    Entry(
        "build.test-not-run",
        "info",
        "A test of a package is not run",
        "It is C++, or needs a launcher of tests that is not here.",
        "run it in real ROS, or write it for pytest",
    ),
)
