"""The ROS that a shell has sourced."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.packages.distributions import DISTRIBUTIONS

__all__ = ["check_environment", "sourced_distributions"]

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
