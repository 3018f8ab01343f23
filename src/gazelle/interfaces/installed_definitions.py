"""Texts of definitions as the ROS that is installed on this machine has them, comments and all.

Two kinds of files have them: ``share/PKG/msg/Name.msg``, and the Python modules that genpy makes
(``dist-packages/PKG/msg/_Name.py``), whose text stands between ``\"\"\"`` and is read, never run.
"""

from __future__ import annotations

import ast
import os
import re
import warnings
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from gazelle.interfaces.definition import RosVersion

__all__ = ["installed_texts"]

_SYSTEM = Path("/usr")
_DISTRIBUTIONS = Path("/opt/ros")
_PREFIXES = ("AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH")
_VARIABLES = (*_PREFIXES, "ROS_PACKAGE_PATH", "PYTHONPATH")
_MODULES = ("lib/python3/dist-packages", "lib/python2.7/dist-packages")
_LITERAL = re.compile(r'^  _full_text = (""".*?(?<!\\)""")$', re.MULTILINE | re.DOTALL)
_RULE = re.compile(r"\n={80}\nMSG: \S+\n")


def installed_texts(package: str, name: str, ros_version: RosVersion) -> Iterator[str]:
    """Yield the texts that this machine has for a message, nearest first; none is checked.

    Args:
        package: such as ``std_msgs``.
        name: such as ``Header``.
        ros_version: ROS 1's Python modules are looked at for ROS 1 only.
    """
    values = tuple(os.environ.get(variable, "") for variable in _VARIABLES)
    for folder in _share_folders(values, _SYSTEM, _DISTRIBUTIONS):
        places = [folder / package]
        if folder.name == package:  # ROS_PACKAGE_PATH names packages too
            places.append(folder)
        for place in places:
            text = _read(place / "msg" / f"{name}.msg")
            if text is not None:
                yield text
    if ros_version is RosVersion.ROS1:
        for folder in _module_folders(values, _SYSTEM, _DISTRIBUTIONS):
            text = _read(folder / package / "msg" / f"_{name}.py")
            if text is not None:
                yield from _text_of_module(text)


@lru_cache(maxsize=8)
def _share_folders(values: tuple[str, ...], system: Path, opt: Path) -> tuple[Path, ...]:
    ament, cmake, packages, _ = values
    found = [one / "share" for one in _prefixes(ament, cmake)]
    found[:0] = [Path(one) for one in packages.split(os.pathsep) if one]
    found += [one / "share" for one in _distributions(opt)]
    return tuple(dict.fromkeys([*found, system / "share"]))


@lru_cache(maxsize=8)
def _module_folders(values: tuple[str, ...], system: Path, opt: Path) -> tuple[Path, ...]:
    ament, cmake, _, python = values
    found = [Path(one) for one in python.split(os.pathsep) if one]
    prefixes = [*_prefixes(ament, cmake), *_distributions(opt), system]
    found += [one / folder for one in prefixes for folder in _MODULES]
    return tuple(one for one in dict.fromkeys(found) if one.is_dir())


def _prefixes(*values: str) -> list[Path]:
    return [Path(one) for value in values for one in re.split(f"[{os.pathsep};]", value) if one]


def _distributions(opt: Path) -> list[Path]:
    return sorted(opt.iterdir(), reverse=True) if opt.is_dir() else []


def _read(file: Path) -> str | None:
    try:
        return file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return None  # one candidate less; the caller has a text of its own


def _text_of_module(source: str) -> Iterator[str]:
    """Yield what stands before the texts of contained messages."""
    match = _LITERAL.search(source)
    if match is None:
        return
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # comments hold escapes that Python does not know
        try:
            text = str(ast.literal_eval(match[1]))
        except (SyntaxError, ValueError):
            return
    yield _RULE.split(text)[0]
