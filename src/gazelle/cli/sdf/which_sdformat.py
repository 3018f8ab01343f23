"""Which sdformat ``gz sdf`` is: Gazebo 11's, or the newer one where the new Gazebo is in use.

Both Gazebos call their command ``gz``, and on a machine one of them is installed. Here the
surroundings say which: the ROS distribution, variables, packages, the file itself, its place.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from gazelle.description.sdformat.release import Release
from gazelle.workspace import Workspace

__all__ = ["sdformat_release"]

_NEW_DISTROS = frozenset({"jazzy", "kilted", "lyrical", "rolling"})
_CLASSIC_VARIABLES = ("GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH", "GAZEBO_PLUGIN_PATH")
_NEW_VARIABLES = re.compile(r"(?:GZ|IGN)_(?:SIM|GAZEBO|VERSION|CONFIG_PATH|FUEL)\w*")
_NEW_PACKAGES = re.compile(
    r"(?:ros_(?:gz|ign)(?:_\w+)?|(?:gz|ign)_ros2_control|(?:gz|ignition)[-_]\w+|sdformat(?:1[0-9])?)"
)
_NEW_TEXT = re.compile(
    r"gz-sim-|gz::sim|ignition-gazebo-|ignition::gazebo|<(?:gz|ignition):"
    r"|<sdf\s[^>]*version\s*=\s*[\"']1\.(?:[89]|1\d)"
)
_NEW_OPTIONS = frozenset(
    {"-g", "--graph", "-i", "--preserve-includes", "--degrees", "--snap-to-degrees",
     "--snap-tolerance", "--inertial-stats", "--versions", "--force-version"}
)  # fmt: skip
_CLASSIC_OPTIONS = frozenset({"-c", "--convert", "-o", "--doc", "-v", "--version", "--verbose"})
_LARGEST = 1_000_000


def sdformat_release(words: Iterable[str], environ: Mapping[str, str]) -> Release:
    """Return the sdformat that a command line means; Gazebo 11's where nothing speaks of gz.

    Args:
        words: those behind ``gz sdf``; none ask for the surroundings alone.
        environ: environment variables.
    """
    words = list(words)
    options = {word.partition("=")[0] for word in words if word.startswith("-")}
    if options & _NEW_OPTIONS or options & _CLASSIC_OPTIONS:
        return Release.V12 if options & _NEW_OPTIONS else Release.V9
    if environ.get("ROS_DISTRO", "") in _NEW_DISTROS:
        return Release.V12
    if any(_NEW_VARIABLES.fullmatch(name) for name in environ):
        return Release.V12
    if any(environ.get(name) for name in _CLASSIC_VARIABLES):
        return Release.V9
    files = [path for path in map(Path, words) if path.is_file()]
    if any(_speaks_of_gz(path) for path in files):
        return Release.V12
    return _of_packages(Workspace.discover(environ=environ))


def _speaks_of_gz(path: Path) -> bool:
    """Tell whether a file's place or its text has the new Gazebo's names."""
    if any(_NEW_PACKAGES.fullmatch(part) for part in path.resolve().parts[:-1]):
        return True
    with path.open("rb") as file:
        return _NEW_TEXT.search(file.read(_LARGEST).decode("utf-8", "replace")) is not None


def _of_packages(workspace: Workspace) -> Release:
    """Return what the user's packages depend on; those that know both run the newer one."""
    names = {
        name
        for package in workspace.packages.values()
        if not package.is_builtin
        for name in package.depends
    }
    is_new = any(_NEW_PACKAGES.fullmatch(name) for name in names)
    return Release.V12 if is_new else Release.V9
