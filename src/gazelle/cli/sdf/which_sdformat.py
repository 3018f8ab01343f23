"""Which sdformat ``gz sdf`` is: Gazebo 11's, or the newer one where the new Gazebo is in use.

Both Gazebos call their command ``gz``, and on a machine one of them is installed. Here the
surroundings say which: the ROS distribution, variables, packages, the file itself, its place.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from gazelle.description.sdformat_emulation.release import Release
from gazelle.workspace import Workspace

__all__ = ["sdformat_release"]

# What each distribution's Gazebo reads SDF with; the last ones' own are newer than any here.
_OF_DISTRO = {
    "foxy": Release.V12,
    "galactic": Release.V12,
    "humble": Release.V12,
    "iron": Release.V12,
    "jazzy": Release.V14,
    "kilted": Release.V14,
    "lyrical": Release.V14,
    "rolling": Release.V14,
}
_NEW_DISTROS = frozenset({"jazzy", "kilted", "lyrical", "rolling"})
_OLD_RELEASES = frozenset({"citadel", "dome", "edifice", "fortress"})
_NEWEST_TEXT = re.compile(r"<sdf\s[^>]*version\s*=\s*[\"']1\.1\d")
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
_MAX_SIZE = 1_000_000


def sdformat_release(argv: Iterable[str], environ: Mapping[str, str]) -> Release:
    """Return the sdformat that a command line means; Gazebo 11's where nothing speaks of gz.

    Args:
        argv: those behind ``gz sdf``; none ask for the surroundings alone.
        environ: environment variables.
    """
    argv = list(argv)
    options = {word.partition("=")[0] for word in argv if word.startswith("-")}
    if options & _NEW_OPTIONS or options & _CLASSIC_OPTIONS:
        return _newer(argv, environ) if options & _NEW_OPTIONS else Release.V9
    if environ.get("ROS_DISTRO", "") in _NEW_DISTROS:
        return _newer(argv, environ)
    if any(_NEW_VARIABLES.fullmatch(name) for name in environ):
        return _newer(argv, environ)
    if any(environ.get(name) for name in _CLASSIC_VARIABLES):
        return Release.V9
    files = [path for path in map(Path, argv) if path.is_file()]
    if any(_speaks_of_gz(path) for path in files):
        return _newer(argv, environ)
    is_new = _knows_gz(Workspace.discover(environ=environ))
    return _newer(argv, environ) if is_new else Release.V9


def _newer(argv: Iterable[str], environ: Mapping[str, str]) -> Release:
    """Return which of the newer ones: the distribution's, ``GZ_VERSION``'s, else the file's."""
    named = _OF_DISTRO.get(environ.get("ROS_DISTRO", ""))
    version = environ.get("GZ_VERSION") or environ.get("IGNITION_VERSION")
    if version:
        return Release.V12 if version in _OLD_RELEASES else Release.V14
    if named is not None:
        return named
    files = (path for path in map(Path, argv) if path.is_file())
    is_newest = any(_NEWEST_TEXT.search(_start_of(path)) for path in files)
    return Release.V14 if is_newest else Release.V12


def _speaks_of_gz(path: Path) -> bool:
    """Tell whether a file's place or its text has the new Gazebo's names."""
    if any(_NEW_PACKAGES.fullmatch(part) for part in path.resolve().parts[:-1]):
        return True
    return _NEW_TEXT.search(_start_of(path)) is not None


def _start_of(path: Path) -> str:
    with path.open("rb") as file:
        return file.read(_MAX_SIZE).decode("utf-8", "replace")


def _knows_gz(workspace: Workspace) -> bool:
    """Tell whether the user's packages depend on the new Gazebo, alone or beside the old one."""
    names = {name for package in workspace.user_packages for name in package.depends}
    return any(_NEW_PACKAGES.fullmatch(name) for name in names)
