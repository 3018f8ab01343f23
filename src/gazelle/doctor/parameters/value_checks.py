"""Values that YAML, roslaunch and ROS 2 read otherwise than they look, or that have no effect."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from gazelle.diagnostics import Diagnostics, Severity, SourceSpan
from gazelle.doctor.parameters.parameter_file import MARK, Document, Layout, plain, scalars
from gazelle.documents.yaml import YamlMapping, YamlNode, YamlScalar, YamlSequence, duplicates
from gazelle.nodes.unsupported_parameters import (
    misspelt_parameters,
    node_of_name,
    unsupported_parameters,
)

__all__ = ["check_idle", "check_values", "key_span", "nodes_in"]

_ADDED_UP = "rcl adds the two up, programs in Python see the last one only"
# PyYAML's own tables (YAML 1.1 without y and n), and rcl_yaml_param_parser's, which has them.
_ROS1_FLAGS = re.compile(r"(?i:yes|no|on|off|true|false)")
_ROS2_FLAGS = re.compile(r"[YyNn]|(?i:yes|no|on|off|true|false)")
_PLAIN_FLAGS = re.compile(r"(?i:true|false)")
# Longer ones are no numbers that somebody meant to be octal or not.
_OCTAL = re.compile(r"[-+]?0\d{1,20}")
_BASE_60 = re.compile(r"[-+]?[1-9]\d*(?::[0-5]?\d)+(?:\.\d*)?")
_NO_POINT = re.compile(r"[-+]?(?:\d+[eE][-+]?\d+|\d*\.?\d+[eE]\d+)")
_NAME_KEY = re.compile(r"(?:^|_)(?:joints?|links?|frames?|names?|axes|axis|tip|root|group)(?:_|$)")
_KINDS = {"bool": "bool", "int": "integer", "float": "double", "str": "string"}


def check_idle(document: Document, diagnostics: Diagnostics) -> None:
    """Report what the nodes of a file read and do not use, or nearly read, each at its line.

    Args:
        document: a file of ROS 2: names of nodes, ``ros__parameters``, parameters.
        diagnostics: receives ``parameter.idle`` and ``parameter.unknown``.
    """
    for path, values in nodes_in(document.root):
        node = node_of_name(path[-1])
        found = plain(values)
        if not node or not isinstance(found, dict):
            continue
        owner = f"/{'/'.join(path)}"
        for item in unsupported_parameters(node, found, 2):
            text = f"{owner}: parameter '{item.key}' has no effect here: {item.reason}"
            diagnostics.report("parameter.idle", text, key_span(values, item.key))
        for wrong in misspelt_parameters(node, found, 2):
            text = f"{owner}: parameter '{wrong.key}' is not known; it has no effect"
            span = key_span(values, wrong.key)
            diagnostics.report("parameter.unknown", text, span, fix=wrong.hint)


def check_values(
    document: Document,
    layout: Layout,
    ros_version: int,
    diagnostics: Diagnostics,
    *,
    joints: Collection[str] = (),
) -> None:
    """Report values that are not what they look like.

    Args:
        document: the file.
        layout: what it is.
        ros_version: which ROS reads it.
        diagnostics: receives the findings.
        joints: names of the robot's joints.
    """
    _check_doubles(document.root, diagnostics, adds_up=layout is Layout.ROS2)
    for key, node, inside in scalars(document.root):
        if not node.is_plain or "$(" in node.text:
            continue
        _check_flag(key, node, inside, ros_version, joints, diagnostics)
        _check_number(key, node, ros_version, diagnostics)
        # MoveIt's planners take their parameters as texts.
        if ros_version == 1 and layout is not Layout.MOVEIT:
            _check_point(key, node, layout, diagnostics)
    if layout is Layout.ROS2 and ros_version == 2:
        _check_lists(document.root, diagnostics, is_inside=False)
    if ros_version == 1:
        _check_keys(document.root, diagnostics)


def nodes_in(
    node: YamlMapping, above: tuple[str, ...] = ()
) -> Iterator[tuple[tuple[str, ...], YamlNode]]:
    """Yield the nodes of a file of ROS 2, the parts of their names, with their parameters."""
    for key, value in node.pairs:
        if key.text == MARK and above:
            yield above, value
        elif isinstance(value, YamlMapping):
            yield from nodes_in(value, (*above, key.text.strip("/")))


def key_span(node: YamlNode, name: str) -> SourceSpan:
    """Return the place of a key; levels may be written as mappings or with dots."""
    place = node
    words = name.split(".")
    while words and isinstance(node, YamlMapping):
        for count in range(len(words), 0, -1):
            key = ".".join(words[:count])
            pair = node.pair(key)
            if pair is not None:
                place, node, words = pair[0], pair[1], words[count:]
                break
        else:
            break
    return place.span


def _check_flag(
    key: str,
    node: YamlScalar,
    inside: YamlNode,
    ros_version: int,
    joints: Collection[str],
    diagnostics: Diagnostics,
) -> None:
    """Report words such as ``y`` and ``on`` where a name is meant."""
    flags = _ROS1_FLAGS if ros_version == 1 else _ROS2_FLAGS
    if not flags.fullmatch(node.text) or _PLAIN_FLAGS.fullmatch(node.text):
        return
    is_name = node.text in joints or _NAME_KEY.search(key.lower()) is not None
    if isinstance(inside, YamlSequence):
        others = [item for item in inside.items if isinstance(item, YamlScalar)]
        is_name = is_name or not all(flags.fullmatch(item.text) for item in others)
    if not is_name:
        return
    reader = "roslaunch" if ros_version == 1 else "ROS 2"
    outcome = "true" if node.text[0].lower() == "y" or node.text.lower() == "on" else "false"
    text = f"{reader} reads {node.text} of '{key}' as {outcome}, not as a name"
    if ros_version == 2 and isinstance(inside, YamlSequence):
        text += " (Sequence should be of same type. Value type 'bool' do not belong at line_num "
        text += f"{node.span.line})"
    fix = f"write '{node.text}' with quotes"
    diagnostics.report("parameters.word-as-flag", text, node.span, fix=fix)


def _check_number(key: str, node: YamlScalar, ros_version: int, diagnostics: Diagnostics) -> None:
    text, fix = "", ""
    if _OCTAL.fullmatch(node.text) and not re.search("[89]", node.text):
        read = int(node.text, 8)
        if str(read) != node.text.lstrip("+").lstrip("0") and read:
            text = f"{node.text} of '{key}' is read as {read}: a number with a 0 in front is octal"
            fix = f"write {node.text.lstrip('0')}, or '{node.text}' for a text"
    elif ros_version == 1 and _BASE_60.fullmatch(node.text):
        text = f"{node.text} of '{key}' is read as a number to the base 60 by roslaunch"
        fix = f"write '{node.text}' with quotes"
    if text:
        diagnostics.report("parameters.number-form", text, node.span, fix=fix)


def _check_point(key: str, node: YamlScalar, layout: Layout, diagnostics: Diagnostics) -> None:
    """Report numbers such as 1e-3, which YAML 1.1 takes for a text."""
    if not _NO_POINT.fullmatch(node.text) or node.tag != "str":
        return
    value = float(node.text)
    text = f"'{key}' is the text '{node.text}' for roslaunch and no number: YAML 1.1 wants a point"
    text += " and a sign, as in 1.0e-3; nodes that ask for a number do not get it"
    fix = f"write {value!r}" if "e" not in repr(value) else f"write {value:.1e}"
    # What the node of such a file does with a text is not known.
    severity = Severity.WARNING if layout is Layout.ROS1 else Severity.INFO
    diagnostics.report("parameter.number-as-text", text, node.span, fix=fix, severity=severity)


def _check_doubles(node: YamlNode, diagnostics: Diagnostics, *, adds_up: bool = False) -> None:
    """Report keys that a mapping has twice.

    rcl adds the parameters of a node up when its name comes twice (``find_node`` of its YAML
    parser): only what stands below ``ros__parameters`` is replaced.
    """
    if isinstance(node, YamlSequence):
        for item in node.items:
            _check_doubles(item, diagnostics)
    if not isinstance(node, YamlMapping):
        return
    doubles = duplicates(node)
    for key, value in node.pairs:
        name = key.text
        is_above = adds_up and name != MARK
        _check_doubles(value, diagnostics, adds_up=is_above)
        first = doubles.get(key)
        if first is not None and name != "<<":
            text = f"key '{name}' is there twice, first in line {first.span.line}; "
            text += _ADDED_UP if is_above else "the last one counts"
            severity = Severity.INFO if is_above else None
            diagnostics.report("control.double-parameter", text, key.span, severity=severity)


def _check_keys(node: YamlNode, diagnostics: Diagnostics) -> None:
    """Report keys that PyYAML reads as something else than a text."""
    if not isinstance(node, YamlMapping):
        return
    for key, value in node.pairs:
        _check_keys(value, diagnostics)
        if isinstance(key, YamlScalar) and key.is_plain and _is_odd(key.text):
            text = f"the key {key.text} is no text for roslaunch, but "
            text += "a truth value; parameters have names (dictionary key must be string)"
            fix = f"write '{key.text}': with quotes"
            diagnostics.report("parameters.word-as-flag", text, key.span, fix=fix)


def _is_odd(word: str) -> bool:
    return _ROS1_FLAGS.fullmatch(word) is not None


def _check_lists(node: YamlNode, diagnostics: Diagnostics, *, is_inside: bool) -> None:
    """Report lists of several types, which parameters of ROS 2 cannot be."""
    if isinstance(node, YamlMapping):
        for key, value in node.pairs:
            inside = is_inside or key.text == MARK
            _check_lists(value, diagnostics, is_inside=inside)
        return
    if not is_inside or not isinstance(node, YamlSequence):
        return
    kinds = [_kind(item) for item in node.items]
    known = [kind for kind in kinds if kind]
    odd = next((place for place, kind in enumerate(kinds) if kind and kind != known[0]), None)
    if odd is None or kinds[odd] == "bool":
        return
    item = node.items[odd]
    text = f"a list of {known[0]}s has a value of type {kinds[odd]} (Sequence should be of same "
    text += f"type. Value type '{kinds[odd]}' do not belong at line_num {item.span.line})"
    fix = "write all numbers with a point: 1.0" if "double" in kinds else "use one type"
    diagnostics.report("parameters.mixed-list", text, item.span, fix=fix)


def _kind(node: YamlNode) -> str:
    """Return a value's type as ROS 2's parser sees it; empty for what is no plain value."""
    if not isinstance(node, YamlScalar) or "$(" in node.text:
        return ""
    if not node.is_plain:
        return "string"
    if _ROS2_FLAGS.fullmatch(node.text):
        return "bool"
    if _NO_POINT.fullmatch(node.text):
        return "double"
    return _KINDS.get(node.tag, "string")
