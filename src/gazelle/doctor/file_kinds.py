"""What a file is, seen from its name and its content."""

from __future__ import annotations

import re
from enum import Enum
from pathlib import Path

from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["Kind", "is_launch_yaml", "is_semantic", "kind_of", "looks_like"]

_PEEK_BYTES = 4096
_XML_SUFFIXES = (".urdf", ".xacro", ".sdf", ".world", ".xml", ".launch", ".model", ".srdf", ".test")
_YAML_SUFFIXES = (".yaml", ".yml")
_ROS2_SUFFIXES = (".launch.py", "_launch.py", ".launch.yaml", ".launch.yml", "_launch.yaml")
_MODEL_ROOTS = frozenset({"gazebo", "light", "model", "sdf", "world"})
# What only launch files of ROS 2 have: nodes are named by ``exec``, arguments by ``$(var …)``.
_ROS2_WORDS = re.compile(r"<node\b[^>]*\bexec\s*=|\$\((?:var|find-pkg-share|find-pkg-prefix)\s")


class Kind(Enum):
    """Kinds of files that can be examined; the value is the report's word."""

    LAUNCH = "launch"
    LAUNCH_ROS2 = "launch of ROS 2"
    ROBOT = "robot"
    WORLD = "world"
    MODEL = "model"
    SEMANTICS = "semantics"
    PARAMETERS = "parameters"
    MANIFEST = "package"


def looks_like(path: Path) -> bool:
    """Tell from its name alone whether a file may be one of those that can be examined."""
    name = path.name
    known = (*_XML_SUFFIXES, *_YAML_SUFFIXES, *_ROS2_SUFFIXES)
    return name in {"package.xml", "manifest.xml", "model.config"} or name.endswith(known)


def is_semantic(path: Path) -> bool:
    """Tell from its name whether a file is an SRDF, or the xacro of one."""
    return path.name.endswith((".srdf", ".srdf.xacro"))


def is_launch_yaml(path: Path) -> bool:
    """Tell a launch file of ROS 2 in YAML from other files in YAML, by name or content."""
    if not path.name.endswith(_YAML_SUFFIXES):
        return False
    return path.name.endswith(_ROS2_SUFFIXES) or _begins_launch(_start(path))


def kind_of(path: Path, diagnostics: Diagnostics) -> Kind | None:
    """Return what a file is; None, and a finding, when it is nothing that can be examined."""
    if path.name in {"package.xml", "manifest.xml"}:
        return Kind.MANIFEST
    try:
        start = _start(path)
    except OSError as error:
        text = f"'{path}' cannot be read: {error.strerror}"
        diagnostics.report("doctor.unreadable", text, SourceSpan(str(path)))
        return None
    if _is_binary(start):
        text = f"'{path}' is a binary file, not a text that describes something"
        diagnostics.report("doctor.unknown-file", text, SourceSpan(str(path)))
        return None
    return _kind_of_text(path, start, diagnostics)


def _start(path: Path) -> bytes:
    with path.open("rb") as stream:
        return stream.read(_PEEK_BYTES)


def _is_binary(start: bytes) -> bool:
    is_utf16 = start.startswith((b"\xff\xfe", b"\xfe\xff"))
    return b"\0" in start and not is_utf16


def _kind_of_text(path: Path, start: bytes, diagnostics: Diagnostics) -> Kind | None:
    name = path.name
    if name.endswith(_ROS2_SUFFIXES):
        return None if name.endswith(".py") and _is_launch_test(path) else Kind.LAUNCH_ROS2
    if name.endswith(_YAML_SUFFIXES):
        return Kind.LAUNCH_ROS2 if _begins_launch(start) else Kind.PARAMETERS
    if name == "model.config":
        return Kind.MODEL
    if is_semantic(path):
        return Kind.SEMANTICS
    if start.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        return _kind_of_xml(path, diagnostics)
    text = f"'{path}' is no XML, YAML or launch file"
    diagnostics.report("doctor.unknown-file", text, SourceSpan(str(path)))
    return None


def _is_launch_test(path: Path) -> bool:
    """Tell a test of launch_testing, which is named as a launch file, from a launch file."""
    text = path.read_bytes()
    return b"def generate_launch_description" not in text and b"generate_test_description" in text


def _begins_launch(start: bytes) -> bool:
    return re.search(rb"(?m)^launch\s*:", start) is not None


def _kind_of_xml(path: Path, diagnostics: Diagnostics) -> Kind | None:
    root = read_xml(path, diagnostics)
    if root is None:
        return None
    if root.name == "launch":
        text = path.read_text(encoding="utf-8", errors="replace")
        return Kind.LAUNCH_ROS2 if _ROS2_WORDS.search(text) else Kind.LAUNCH
    if root.name == "robot":
        return Kind.ROBOT
    if root.name in _MODEL_ROOTS:
        return Kind.WORLD if _has_world(root) else Kind.MODEL
    text = f"the outermost element is <{root.name}>: not a robot, a world, a model or a launch"
    diagnostics.report("doctor.unknown-file", text, root.span)
    return None


def _has_world(root: Tag) -> bool:
    return root.name == "world" or root.find("world") is not None
