"""Which launch file a command line means."""

from __future__ import annotations

import os
from pathlib import Path

from gazelle.cli.tool import ToolError
from gazelle.diagnostics import did_you_mean
from gazelle.workspace.ament_index import get_package_share_directory, known_workspace

__all__ = ["is_launch_file", "launch_file_of", "launch_files_below"]

_ENDINGS = ("launch.py", ".launch", "launch.xml", "launch.yaml", "launch.yml")
_PRUNED = frozenset({"__pycache__", "build", "install", "log", "node_modules"})


def is_launch_file(name: str) -> bool:
    """Tell whether a file's name is one of launch files."""
    return name.endswith(_ENDINGS)


def launch_files_below(folder: str) -> list[Path]:
    """Return the launch files in a folder and below."""
    return [path for path in _files_below(folder) if is_launch_file(path.name)]


def launch_file_of(package: str, name: str) -> Path:
    """Return the file of a name anywhere in a package.

    Raises:
        PackageNotFoundError: there is no such package.
        ValueError: the package's name is not legal.
        ToolError: there is no such file, or more than one.
    """
    share = get_package_share_directory(package)
    # A file that is there at two places is one file.
    places: dict[Path, Path] = {}
    for path in _files_below(share):
        if path.name == name:
            places.setdefault(path.resolve(), path)
    found = list(places.values())
    if len(found) == 1:
        return found[0]
    if found:
        listed = ", ".join(f"'{path}'" for path in found)
        raise ToolError(
            f"file '{name}' was found more than once in the share directory of package "
            f"'{package}': [{listed}]\n  fix: ros2 launch {found[0]}"
        )
    raise ToolError(
        f"file '{name}' was not found in the share directory of package '{package}' which is at "
        f"'{share}'{_instead(share, package, name)}"
    )


def _instead(share: str, package: str, name: str) -> str:
    direct = Path(share) / name
    if direct.is_file():
        # ROS 2 takes a bare name only.
        return f"\n  fix: ros2 launch {package} {direct.name}"
    names = sorted({path.name for path in launch_files_below(share)})
    found = known_workspace().packages.get(package)
    note = f"\n  {found.note_on_files}" if found is not None and found.note_on_files else ""
    if not names:
        return f"\n  package '{package}' has no launch files{note}"
    near = did_you_mean(name, names)
    return f"\n  {near}" if near else f"\n  it has: {', '.join(names)}{note}"


def _files_below(folder: str) -> list[Path]:
    files: list[Path] = []
    for root, folders, names in os.walk(folder):
        folders[:] = sorted(
            one for one in folders if one not in _PRUNED and not one.startswith(".")
        )
        files += [Path(root, one) for one in sorted(names)]
    return files
