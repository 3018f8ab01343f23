"""The ROS that a shell has sourced, and the distributions there are."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from typing import NamedTuple

from gazelle.diagnostics import Diagnostics

__all__ = ["DISTRIBUTIONS", "Distribution", "check_environment", "sourced_distributions"]


class Distribution(NamedTuple):
    """A ROS distribution.

    Attributes:
        ros_version: 1 or 2.
        end: month in which its support ended or ends, ``YYYY-MM``.
        gazebo: the Gazebo it is used with.
        is_over: support has ended (as of Gazelle's own release).
    """

    name: str
    ros_version: int
    end: str
    gazebo: str
    is_over: bool = True


# REP-3 and REP-2000.
_ROWS = (
    Distribution("diamondback", 1, "2012-05", "Gazebo 0"),
    Distribution("electric", 1, "2013-01", "Gazebo 0"),
    Distribution("fuerte", 1, "2013-06", "Gazebo 1.0"),
    Distribution("groovy", 1, "2014-07", "Gazebo 1.5"),
    Distribution("hydro", 1, "2015-05", "Gazebo 1.9"),
    Distribution("indigo", 1, "2019-04", "Gazebo 2"),
    Distribution("jade", 1, "2017-05", "Gazebo 5"),
    Distribution("kinetic", 1, "2021-04", "Gazebo 7"),
    Distribution("lunar", 1, "2019-05", "Gazebo 7"),
    Distribution("melodic", 1, "2023-06", "Gazebo 9"),
    Distribution("noetic", 1, "2025-05", "Gazebo 11"),
    Distribution("dashing", 2, "2021-05", "Gazebo 9"),
    Distribution("eloquent", 2, "2020-11", "Gazebo 9"),
    Distribution("foxy", 2, "2023-06", "Gazebo 11"),
    Distribution("galactic", 2, "2022-12", "Gazebo 11"),
    Distribution("humble", 2, "2027-05", "Gazebo 11 or Fortress", False),
    Distribution("iron", 2, "2024-12", "Gazebo 11 or Fortress"),
    Distribution("jazzy", 2, "2029-05", "Harmonic", False),
    Distribution("kilted", 2, "2026-12", "Ionic", False),
    Distribution("rolling", 2, "", "Jetty", False),
)
DISTRIBUTIONS = {row.name: row for row in _ROWS}
_PLACE = re.compile(r"/opt/ros/(\w+)")
_VARIABLES = (
    "AMENT_PREFIX_PATH",
    "CMAKE_PREFIX_PATH",
    "LD_LIBRARY_PATH",
    "PYTHONPATH",
    "ROS_PACKAGE_PATH",
)
_CONDA = ("CONDA_PREFIX", "CONDA_DEFAULT_ENV")


def sourced_distributions(environ: Mapping[str, str]) -> dict[str, tuple[str, ...]]:
    """Return the distributions that the environment names, and the variables that do."""
    found: dict[str, list[str]] = {}
    named = environ.get("ROS_DISTRO", "").strip()
    if named:
        found.setdefault(named, []).append("ROS_DISTRO")
    for variable in _VARIABLES:
        for place in environ.get(variable, "").split(os.pathsep):
            match = _PLACE.search(place)
            if match and variable not in found.setdefault(match[1], []):
                found[match[1]].append(variable)
    return {name: tuple(variables) for name, variables in found.items()}


def check_environment(environ: Mapping[str, str], *, diagnostics: Diagnostics) -> None:
    """Report a sourced ROS that mixes two distributions, is out of support, or meets conda.

    Args:
        environ: environment variables of the shell.
        diagnostics: receives the findings.
    """
    found = sourced_distributions(environ)
    if len(found) > 1:
        shown = "; ".join(f"{name} in {', '.join(where)}" for name, where in found.items())
        text = f"two ROS distributions are sourced in this shell: {shown}. Gazelle uses neither's "
        text += "programs for its own work, but nodes of yours would import a mixture"
        diagnostics.report("package.ros-mixed", text, fix="open a new shell and source one of them")
    version = environ.get("ROS_VERSION", "").strip()
    named = DISTRIBUTIONS.get(environ.get("ROS_DISTRO", "").strip())
    if named is not None and version in {"1", "2"} and int(version) != named.ros_version:
        text = f"ROS_VERSION is {version} and ROS_DISTRO is {named.name}, which is a ROS "
        text += f"{named.ros_version}"
        fix = f"open a new shell and source /opt/ros/{named.name}/setup.bash"
        diagnostics.report("package.ros-mixed", text, fix=fix)
    conda = next((environ[name] for name in _CONDA if environ.get(name)), "")
    if conda and found and any("PYTHONPATH" in where for where in found.values()):
        text = f"conda ('{conda}') is active together with a sourced ROS: its Python would load "
        text += "ROS' compiled modules of another Python version"
        fix = "conda deactivate, or unset PYTHONPATH"
        diagnostics.report("package.ros-mixed", text, fix=fix)
    for name in found:
        known = DISTRIBUTIONS.get(name)
        if known is not None and known.is_over:
            text = f"the sourced ROS {name} is out of support since {known.end}; packages written "
            text += "for it run in Gazelle as they are"
            diagnostics.report("package.ros-ended", text)
