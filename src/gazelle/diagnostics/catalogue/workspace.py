"""Codes of finding packages, models and files, and of building workspaces."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

_PACKAGES = (
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

_BUILDING = (
    Entry(
        "build.compiled-target",
        "warning",
        "A program or library of a package is not built",
        "There is no C++ compiler here. Everything else of the package is installed.",
        "pip install 'gazelle-sim[cpp]', which brings one, or install g++ or clang++",
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

ENTRIES = (*_PACKAGES, *_BUILDING)
