"""A YAML file with parameters: its outermost mapping, and whether ROS can read its layout."""

from __future__ import annotations

import enum
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle.control.controllers.registry import known_types
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean, nearest_names
from gazelle.doctor.packages.dependency_checks import is_slip
from gazelle.documents import read_text_limited
from gazelle.documents.yaml import (
    ProblemKind,
    YamlError,
    YamlMapping,
    YamlNode,
    YamlProblem,
    YamlScalar,
    YamlSequence,
    problem_of,
    read_yaml_documents,
    value_of,
)

__all__ = [
    "MARK",
    "Document",
    "Layout",
    "check_layout",
    "is_controller_type",
    "layout_of",
    "plain",
    "read_document",
    "scalars",
]

_MAX_LENGTH = 5_000_000
MARK = "ros__parameters"
_MOVEIT_KEYS = frozenset(
    {
        "cartesian_limits", "controller_list", "default_velocity_scaling_factor", "joint_limits",
        "initial_positions", "kinematics_solver", "moveit_controller_manager", "planner_configs",
        "moveit_simple_controller_manager", "octomap_frame", "planning_plugin", "sensors",
        "trajectory_execution",
    }
)  # fmt: skip
_MAP_KEYS = frozenset({"free_thresh", "negate", "occupied_thresh", "origin"})


@dataclass(frozen=True, slots=True)
class Document:
    """One YAML document.

    Attributes:
        file: its path.
        root: the outermost mapping.
    """

    file: Path
    root: YamlMapping

    def find(self, *keys: str) -> YamlNode | None:
        """Return the value below these keys; None when there is none."""
        node: YamlNode | None = self.root
        for key in keys:
            pair = node.pair(key) if isinstance(node, YamlMapping) else None
            node = None if pair is None else pair[1]
        return node

    @staticmethod
    def keys(node: YamlNode | None) -> tuple[str, ...]:
        """Return the keys of a mapping, none for anything else."""
        if not isinstance(node, YamlMapping):
            return ()
        return tuple(key.text for key, _ in node.pairs if isinstance(key, YamlScalar))

    def key(self, node: YamlNode, name: str) -> YamlNode:
        """Return the node of a key in a mapping; the mapping itself when it has none such."""
        pair = node.pair(name) if isinstance(node, YamlMapping) else None
        return node if pair is None else pair[0]


class Layout(enum.Enum):
    """Kinds of YAML files in packages of robots."""

    ROS2 = "node: ros__parameters: …"
    ROS1 = "names of the ROS 1 parameter server"
    MOVEIT = "a part of MoveIt's configuration"
    MAP = "a map's description"
    OTHER = "anything else"


def read_document(path: Path, diagnostics: Diagnostics) -> Document | None:
    """Read a file; None (and an error reported) when it is no YAML, None for lists and texts."""
    try:
        if path.stat().st_size > _MAX_LENGTH:
            return None
        documents = read_yaml_documents(read_text_limited(path), str(path))
    except (OSError, UnicodeDecodeError) as error:
        _report(problem_of(error, str(path)), diagnostics)
        return None
    problem = documents[-1].problem if documents else None
    if problem is not None:
        _report(problem, diagnostics)
        return None
    root = documents[0].root if len(documents) == 1 else None
    return Document(path, root) if isinstance(root, YamlMapping) else None


def plain(node: YamlNode) -> Any:
    """Return a node as Python values, by YAML 1.1 as roslaunch reads it."""
    if isinstance(node, YamlMapping):
        return {key.text: plain(value) for key, value in node.pairs}
    if isinstance(node, YamlSequence):
        return [plain(item) for item in node.items]
    try:
        return value_of(node)
    except YamlError:
        return node.text


def scalars(node: YamlNode, name: str = "") -> Iterator[tuple[str, YamlScalar, YamlNode]]:
    """Yield every scalar value with the last key above it and the node it stands in."""
    if isinstance(node, YamlMapping):
        inner = [(key.text, value) for key, value in node.pairs]
    else:
        inner = [(name, item) for item in node.items] if isinstance(node, YamlSequence) else []
    for key, value in inner:
        if isinstance(value, YamlScalar):
            yield key, value, node
        else:
            yield from scalars(value, key)


def layout_of(document: Document) -> Layout:
    """Return what a file is, by its keys."""
    keys = set(document.keys(document.root))
    if _marks(document.root):
        return Layout.ROS2
    # Descriptions of cameras have a resolution, too, and no threshold.
    if {"image", "resolution"} <= keys and keys & _MAP_KEYS:
        return Layout.MAP
    inner = {key for name in keys for key in document.keys(document.find(name))}
    if keys & _MOVEIT_KEYS or "kinematics_solver" in inner or "planner_configs" in inner:
        return Layout.MOVEIT
    if _has_controllers(document.root):
        return Layout.ROS1
    return Layout.OTHER


def check_layout(
    document: Document, layout: Layout, ros_version: int | None, diagnostics: Diagnostics
) -> None:
    """Report a layout that the file's own generation of ROS refuses or misunderstands.

    Args:
        document: the file.
        layout: what it is.
        ros_version: which ROS loads it; None when that is not known.
        diagnostics: receives the findings.
    """
    if layout is Layout.ROS2:
        _check_mistyped(document.root, diagnostics)
        _check_values_above(document.root, diagnostics)
        if ros_version == 1:
            _report_ros2_in_ros1(document, diagnostics)
    elif ros_version == 2 and layout in {Layout.ROS1, Layout.OTHER}:
        mistyped = _check_mistyped(document.root, diagnostics)
        if layout is Layout.ROS1 and not mistyped:
            _report_ros1_in_ros2(document, diagnostics)


def _report(problem: YamlProblem, diagnostics: Diagnostics) -> None:
    span: SourceSpan | None = problem.span
    match problem.kind:
        case ProblemKind.UNREADABLE:
            message = f"parameter file '{problem.span.file}' cannot be read: {problem.what}"
            span = None
        case ProblemKind.NOT_UTF8:
            message = f"parameter file cannot be read: {problem.text}"
        case ProblemKind.TAB_INDENT:
            message = "parameter file is not YAML: the line is indented with a tab (found "
            message += "character '\\t' that cannot start any token)"
        case _:
            message = f"parameter file is not YAML: {problem.what}"
    diagnostics.report("control.parameter-file", message, span, fix=problem.fix)


def _report_ros2_in_ros1(document: Document, diagnostics: Diagnostics) -> None:
    mark = _marks(document.root)[0]
    text = f"the file has '{MARK}', as ROS 2 writes files; roslaunch would make it a part of the "
    text += f"names: /controller/{MARK}/type. Gazelle looks through it"
    fix = f"take the level {MARK} out for ROS 1"
    diagnostics.report("parameters.ros2-layout", text, mark.span, fix=fix)


def _report_ros1_in_ros2(document: Document, diagnostics: Diagnostics) -> None:
    key = document.root.pairs[0][0]
    text = f"the file has no '{MARK}'; it is read as ROS 1 wrote such files, real ROS 2 would "
    text += "refuse it (Cannot have a value before ros__parameters)"
    fix = f"write: {key.text}: / {MARK}: / …"
    diagnostics.report("control.no-ros-parameters", text, key.span, fix=fix)


def _check_mistyped(node: YamlMapping, diagnostics: Diagnostics) -> bool:
    """Report keys that were to be ``ros__parameters``; tell whether there is one."""
    found = False
    for key, value in node.pairs:
        if not isinstance(value, YamlMapping) or key.text == MARK:
            continue
        word = key.text
        if _is_mistyped(word):
            text = f"'{word}' is no '{MARK}': two underscores behind ros, the parameters of the "
            text += "node are not seen (Cannot have a value before ros__parameters)"
            hint = did_you_mean(word, [MARK])
            diagnostics.report("parameters.layout", text, key.span, fix=hint)
            found = True
        else:
            found = _check_mistyped(value, diagnostics) or found
    return found


# What people write who have seen it and do not look it up.
_MEANT_MARK = frozenset({"param", "parameters", "params", "ros_param", "ros_parameters"})


def _is_mistyped(word: str) -> bool:
    is_near = word.startswith("ros") and "param" in word and bool(nearest_names(word, [MARK]))
    return is_near and word != MARK


def _check_values_above(
    node: YamlMapping, diagnostics: Diagnostics, parent: YamlNode | None = None
) -> None:
    """Report values beside ``ros__parameters``, where only names of nodes can stand."""
    names = [key.text for key, _ in node.pairs]
    values = [key for key, value in node.pairs if not isinstance(value, YamlMapping)]
    above = parent.text if isinstance(parent, YamlScalar) else ""
    if parent is not None and above in _MEANT_MARK and values and MARK not in names:
        text = f"'{above}' is taken for the name of a node, and '{values[0].text}' stands "
        text += f"above '{MARK}' (Cannot have a value before ros__parameters); real ROS 2 refuses "
        text += "the whole file"
        fix = f"did you mean '{MARK}'?"
        diagnostics.report("parameters.layout", text, parent.span, fix=fix)
        return
    for key, value in node.pairs:
        if isinstance(value, YamlMapping):
            if key.text != MARK and not _is_mistyped(key.text):
                _check_values_above(value, diagnostics, key)
        elif key.text == MARK:
            _report_empty(key, value, diagnostics)
        else:
            place = "beside" if MARK in names else "above"
            text = f"'{key.text}' stands {place} '{MARK}', where names of nodes are (Cannot have "
            text += "a value before ros__parameters); real ROS 2 refuses the whole file"
            fix = f"indent it below {MARK}:"
            diagnostics.report("parameters.layout", text, key.span, fix=fix)


def _report_empty(key: YamlNode, value: YamlNode, diagnostics: Diagnostics) -> None:
    text = f"'{MARK}' has nothing below it: real ROS 2 refuses the whole file (No value at line "
    text += f"{key.span.line})"
    if isinstance(value, YamlScalar) and value.text:
        text = f"'{MARK}' has the value '{value.text}' and no parameters below it"
    fix = f"write {MARK}: {{}}, or leave the node out"
    diagnostics.report("parameters.empty", text, key.span, fix=fix)


def _marks(node: YamlNode) -> list[YamlNode]:
    found: list[YamlNode] = []
    if isinstance(node, YamlMapping):
        for key, value in node.pairs:
            found += [key] if key.text == MARK else _marks(value)
    return found


def is_controller_type(text: str) -> bool:
    """Tell whether a type is that of a controller of ours, or one with a slip in it."""
    name = text.replace("::", "/")
    if name in known_types():
        return True
    near = nearest_names(name, known_types(), count=1) if "/" in name else ()
    return bool(near) and is_slip(name, near[0])


def _has_controllers(node: YamlNode) -> bool:
    if not isinstance(node, YamlMapping):
        return False
    for key, value in node.pairs:
        if key.text == "type" and isinstance(value, YamlScalar):
            if is_controller_type(value.text):
                return True
        elif _has_controllers(value):
            return True
    return False
