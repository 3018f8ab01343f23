"""A message's text together with the texts of all that it contains, as bags carry it.

MD5 sums and hashes leave comments out, so one type has many texts. The one that counts is, in
this order: the text that came in with the messages, the file of the user's own package, the file
that is installed on this machine when it means the same, and Gazelle's own, which has no comments.

Two kinds of installed files have them: ``share/PKG/msg/Name.msg``, and the Python modules that
genpy makes (``dist-packages/PKG/msg/_Name.py``), whose text stands between triple quotes and is
read, never run.
"""

from __future__ import annotations

import ast
import os
import re
import warnings
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from gazelle.errors import GazelleError
from gazelle.interfaces.definition import Definition, RosVersion
from gazelle.interfaces.message_base import Types
from gazelle.interfaces.parser import parse_message
from gazelle.interfaces.rihs01 import type_hash
from gazelle.interfaces.ros1_md5sum import md5sum
from gazelle.interfaces.type_names import canonical_name, ros1_name, split_name

__all__ = ["KeptTexts", "installed_texts", "ros1_definition", "ros2_definition"]

_SYSTEM = Path("/usr")
_DISTRIBUTIONS = Path("/opt/ros")
_PREFIXES = ("AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH")
_VARIABLES = (*_PREFIXES, "ROS_PACKAGE_PATH", "PYTHONPATH")
_MODULES = ("lib/python3/dist-packages", "lib/python2.7/dist-packages")
_LITERAL = re.compile(r'^  _full_text = (""".*?(?<!\\)""")$', re.MULTILINE | re.DOTALL)
_FULL_TEXT_RULE = re.compile(r"\n={80}\nMSG: \S+\n")
_RULE = "=" * 80 + "\n"
_PART = re.compile(r"\n=+\s*\nMSG: ")


def installed_texts(package: str, name: str, ros_version: RosVersion) -> Iterator[str]:
    """Yield the texts that this machine has for a message, nearest first; none is checked.

    Args:
        package: such as ``std_msgs``.
        name: such as ``Header``.
        ros_version: ROS 1's Python modules are looked at for ROS 1 only.
    """
    values = tuple(os.environ.get(variable, "") for variable in _VARIABLES)
    for folder in _share_folders(values, _SYSTEM, _DISTRIBUTIONS):
        folders = [folder / package]
        if folder.name == package:  # ROS_PACKAGE_PATH names packages too
            folders.append(folder)
        for below in folders:
            text = _read(below / "msg" / f"{name}.msg")
            if text is not None:
                yield text
    if ros_version is RosVersion.ROS1:
        for folder in _module_folders(values, _SYSTEM, _DISTRIBUTIONS):
            text = _read(folder / package / "msg" / f"_{name}.py")
            if text is not None:
                yield from _text_of_module(text)


def ros1_definition(types: Types, name: str) -> str:
    """Return a message's text and, behind rules of ``=``, those of all it contains.

    The layout, to the byte, is that of genpy's ``_full_text``.

    Raises:
        NotFoundError: nothing defines it.
    """
    full = canonical_name(name)
    kept = types.kept_text(full, RosVersion.ROS1)
    if kept:
        return kept
    text = _own_text(types, full, RosVersion.ROS1) + "\n"
    for item in _contained(types, full, []):
        text += f"{_RULE}MSG: {ros1_name(item)}\n{_own_text(types, item, RosVersion.ROS1)}\n"
    return text[:-1]


def ros2_definition(types: Types, name: str) -> str:
    """Return a message's text and those of all it contains, as rosbag2 writes ``ros2msg`` schemas.

    Raises:
        NotFoundError: nothing defines it.
    """
    full = canonical_name(name)
    return types.kept_text(full, RosVersion.ROS2) or _ros2_text(types, full, set())


class KeptTexts:
    """Whole texts that came in with types that mean the same here."""

    def __init__(self, types: Types) -> None:
        """Begin without texts.

        Args:
            types: says what types mean here.
        """
        self._types = types
        self._kept: dict[tuple[str, RosVersion], tuple[str, str]] = {}

    def keep(self, name: str, ros_version: RosVersion, text: str) -> bool:
        """Keep a text when it means what is known here; return whether it does.

        Args:
            name: ``pkg/Name`` or ``pkg/msg/Name``.
            ros_version: whose rules it follows.
            text: with the texts of all that the message contains.
        """
        full = canonical_name(name)
        known = self._kept.get((full, ros_version))
        if known is not None and known[1] == text:
            return True
        try:
            own = self._types.definition(full, ros_version)
        except GazelleError:
            return False
        if not text.strip() or not _means(own, _PART.split(text, maxsplit=1)[0]):
            return False
        self._kept[full, ros_version] = (_meaning(self._types, full, ros_version), text)
        return True

    def find(self, name: str, ros_version: RosVersion) -> str:
        """Return the text of a type, empty when none came in or the type has changed since."""
        full = canonical_name(name)
        found = self._kept.get((full, ros_version))
        if found is None:
            return ""
        meaning, text = found
        return text if meaning == _meaning(self._types, full, ros_version) else ""


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
    yield _FULL_TEXT_RULE.split(text)[0]


def _meaning(types: Types, name: str, ros_version: RosVersion) -> str:
    return md5sum(types, name) if ros_version is RosVersion.ROS1 else type_hash(types, name)


def _ros2_text(types: Types, name: str, seen: set[str]) -> str:
    """A type's text and, by name, those it contains: depth first, each once (rosbag2_cpp)."""
    text = _own_text(types, name, RosVersion.ROS2)
    fields = types.definition(name, RosVersion.ROS2).fields
    for base in sorted({item.type.base for item in fields if item.type.is_message}):
        if base not in seen:
            seen.add(base)
            text += f"\n{_RULE}MSG: {ros1_name(base)}\n{_ros2_text(types, base, seen)}"
    return text


def _own_text(types: Types, name: str, ros_version: RosVersion) -> str:
    key = ("text", name, ros_version)
    return types.remembered(key, lambda: _text(types, name, ros_version))


def _text(types: Types, name: str, ros_version: RosVersion) -> str:
    own = types.definition(name, ros_version)
    package, part, bare = split_name(name)
    source = types.find_source(package, part, bare, ros_version)
    if source is not None and source.is_own:
        return source.text
    if part == "msg":
        for text in installed_texts(package, bare, ros_version):
            if _means(own, text):
                return text
    return own.text + "\n" if own.text else ""


def _means(own: Definition, text: str) -> bool:
    """Whether a text defines the same as a definition: what sums and hashes are made of."""
    try:
        other = parse_message(text, own.name, own.ros_version, diagnostics=None, file="")
    except (GazelleError, ValueError):
        return False
    kinds = [(item.name, item.type) for item in own.fields]
    if [(item.name, item.type) for item in other.fields] != kinds:
        return False
    if own.ros_version is RosVersion.ROS2:
        return True
    constants = [(item.type, item.name, item.text) for item in own.constants]
    return [(item.type, item.name, item.text) for item in other.constants] == constants


def _contained(types: Types, name: str, found: list[str]) -> list[str]:
    """All messages inside, each once, in the order of genmsg: depth first."""
    for item in types.definition(name, RosVersion.ROS1).fields:
        base = item.type.base
        if item.type.is_message and base not in found:
            found.append(base)
            _contained(types, base, found)
    return found
