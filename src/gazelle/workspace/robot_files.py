"""Which files of a folder describe a robot or a world that stands for itself."""

from __future__ import annotations

from pathlib import Path

__all__ = ["ROBOT_SUFFIXES", "robot_files"]

ROBOT_SUFFIXES = (".urdf", ".urdf.xacro", ".xacro", ".sdf", ".world")
"""How their names end, the likeliest first."""

_FOLDERS = ("urdf", "robots", "robot", "xacro", "models", "sdf", "worlds", ".")
_PIECES = ("macro", "common", "material", "gazebo", "properties", "inertial", "plugin", "sensor")
"""Words in the names of xacro files that other files include."""


def robot_files(folder: Path) -> tuple[Path, ...]:
    """Return the descriptions in a package's folder that stand for themselves, likeliest first."""
    found: dict[Path, None] = {}
    for name in _FOLDERS:
        here = folder / name
        if not here.is_dir():
            continue
        files = sorted(here.iterdir() if name == "." else here.rglob("*"))
        for suffix in ROBOT_SUFFIXES:
            found |= {path: None for path in files if path.name.endswith(suffix)}
    whole = [path for path in found if not _is_piece(path)]
    robots = [path for path in whole if path.suffix != ".world"]
    return tuple(robots or whole or found)


def _is_piece(path: Path) -> bool:
    return path.suffix == ".xacro" and any(word in path.name.lower() for word in _PIECES)
