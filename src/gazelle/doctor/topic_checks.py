"""Both ends of the topics of a launch: messages of two types, and names that were misspelt."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from gazelle.diagnostics import Diagnostics, nearest_names
from gazelle.diagnostics.suggestions import likeness
from gazelle.doctor.packages.dependency_checks import is_slip
from gazelle.doctor.script_topics import TopicEnd, TopicUse

__all__ = ["check_topic_names", "check_topic_types", "is_typo", "same_type"]

# What a script says counts less than what a simulator or a built-in node does.
_SURE = 100
_SURELY = 0.85
_SHOWN = 3
_SHORT = 5
_SHORT_WORD = 3
# Listened to without a publisher in the launch: by hand, by RViz, by a teleoperation of its own.
_FROM_OUTSIDE = frozenset({"cmd_vel", "clicked_point", "goal", "initialpose", "tf", "tf_static"})


def check_topic_types(
    ends: Sequence[TopicEnd], diagnostics: Diagnostics, *, ros_version: int
) -> None:
    """Report scripts that send or expect another type than the other end of a topic.

    Args:
        ends: those that are known; there may be more.
        diagnostics: receives the findings.
        ros_version: of the launch.
    """
    by_topic: dict[str, list[TopicEnd]] = {}
    for end in ends:
        if end.type:
            by_topic.setdefault(end.topic, []).append(end)
    for topic_ends in by_topic.values():
        for end in topic_ends:
            if end.use is not None:
                _check_type(end, topic_ends, diagnostics, ros_version)


def check_topic_names(
    ends: Sequence[TopicEnd],
    diagnostics: Diagnostics,
    *,
    is_whole: bool,
    others: Iterable[str] = (),
    where: str = "in this launch",
    of_namespaces: bool = True,
) -> None:
    """Report names in scripts that nobody else uses, where nearly the same name would have met.

    Args:
        ends: those that are known.
        diagnostics: receives the findings.
        is_whole: there are no more.
        others: topics that nodes of which no more is known may have.
        where: the nodes are, in words.
        of_namespaces: also those that differ in their namespaces only.
    """
    taken = frozenset(others)
    for end in ends:
        is_met = any(one.topic == end.topic and one.publishes != end.publishes for one in ends)
        if end.use is None or is_met or (end.topic in taken and not is_whole):
            continue
        if not end.publishes and end.topic.rpartition("/")[2] in _FROM_OUTSIDE:
            continue
        near = _meant(end, ends, is_whole)
        is_same = near.rpartition("/")[2] == end.topic.rpartition("/")[2]
        if near and (of_namespaces or not is_same):
            _report_name(end, end.use, near, diagnostics, where)


def is_typo(name: str, other: str) -> bool:
    """Tell a slip of the fingers from names that differ on purpose: ``scan_1``, ``cam_l``."""
    words, others = re.split(r"[/_]", name), re.split(r"[/_]", other)
    if len(words) != len(others) or _digits(name) != _digits(other):
        return False
    pairs = [(a, b) for a, b in zip(words, others, strict=True) if a != b]
    return is_slip(name, other) and all(max(len(a), len(b)) >= _SHORT_WORD for a, b in pairs)


def same_type(one: str, other: str) -> bool:
    """Tell whether two types may be the same; a package may be unknown."""
    (package, name), (other_package, other_name) = _parts(one), _parts(other)
    same_package = not package or not other_package or package == other_package
    return name == other_name and same_package


def _check_type(
    end: TopicEnd, topic_ends: Sequence[TopicEnd], diagnostics: Diagnostics, ros_version: int
) -> None:
    others = [one for one in topic_ends if one.publishes != end.publishes]
    own = [one for one in topic_ends if one.node == end.node and one.publishes == end.publishes]
    # Of several types in branches of one script, one may be right.
    if not others or any(same_type(one.type, other.type) for one in own for other in others):
        return
    rival = max(others, key=lambda one: (_weight(one, topic_ends), one.publishes))
    if rival.use is not None:
        mine, its = _weight(end, topic_ends), _weight(rival, topic_ends)
        if mine > its or (mine == its and end.publishes):
            return
    _report_type(end, others, rival.type, diagnostics, ros_version)


def _weight(end: TopicEnd, topic_ends: Sequence[TopicEnd]) -> int:
    """Return how much speaks for the type of an end."""
    same = [one for one in topic_ends if same_type(one.type, end.type)]
    return sum(1 if one.use is not None else _SURE for one in same)


def _report_type(
    end: TopicEnd,
    others: Sequence[TopicEnd],
    wanted: str,
    diagnostics: Diagnostics,
    ros_version: int,
) -> None:
    assert end.use is not None
    names = list(dict.fromkeys(_named(one) for one in others if same_type(one.type, wanted)))
    rest = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    who = ", ".join(names[:_SHOWN]) + rest
    own, its = _of_ros1(end.type), _of_ros1(wanted)
    if end.publishes:
        does = "listens to" if len(names) == 1 else "listen to"
        text = f"'{end.node}' publishes '{end.topic}' as {own}, and {who} {does} it as {its}"
    else:
        does = "publishes" if len(names) == 1 else "publish"
        text = f"'{end.node}' listens to '{end.topic}' as {own}, and {who} {does} it as {its}"
    text += ": no message arrives"
    package, name = _parts(wanted)
    fix = f"from {package}.msg import {name}" if package else f"use {name}"
    phrase = f"topic types do not match: [{own}] vs. [{its}]"
    if ros_version != 1:
        phrase = f"Cannot echo topic '{end.topic}', as it contains more than one type"
    span = end.use.type_span
    diagnostics.report("doctor.topic-type", text, span, fix=fix, phrase=phrase)


def _named(end: TopicEnd) -> str:
    if end.use is None:
        return f"'{end.node}'"
    span = end.use.type_span
    return f"'{end.node}' ({span.file.rpartition('/')[2]}:{span.line})"


def _report_name(
    end: TopicEnd, use: TopicUse, near: str, diagnostics: Diagnostics, where: str
) -> None:
    verb, does = ("publishes", "listen to") if end.publishes else ("listens to", "publish")
    text = f"'{end.node}' {verb} '{end.topic}', which nobody {where} is known to {does}; there is "
    text += f"'{near}'"
    written = _as_written(near, end.topic, use.name)
    fix = f"did you mean '{written}'?"
    diagnostics.report("doctor.topic-misspelt", text, use.name_span, fix=fix)


def _as_written(near: str, topic: str, name: str) -> str:
    """Return a topic as the script would name it, in whose namespace it may be."""
    around = topic.removesuffix(name) if not name.startswith(("/", "~")) else topic
    return near.removeprefix(around) if around != topic and near.startswith(around) else near


def _meant(end: TopicEnd, ends: Sequence[TopicEnd], is_whole: bool) -> str:
    """Return the topic that a name is nearly, empty where none is near enough."""
    fitting = [
        one
        for one in ends
        if one.publishes != end.publishes and one.node != end.node and _may_be(one, end, is_whole)
    ]
    alike = [one for one in fitting if _digits(one.topic) == _digits(end.topic)]
    slips = sorted({one.topic for one in alike if is_typo(end.topic, one.topic)})
    if slips:
        return slips[0]
    if not is_whole:
        return ""
    served = {one.topic for one in ends if one.publishes == end.publishes}
    last = end.topic.rpartition("/")[2]
    unmet = [one for one in fitting if one.topic not in served and one.type and end.type]
    same = {one.topic for one in unmet if one.topic.rpartition("/")[2] == last}
    if len(same) == 1:
        return same.pop()
    free = [one.topic for one in unmet if one in alike]
    near = nearest_names(end.topic, free, count=1)
    # What a script sends may be for somebody outside; two ends that lack each other are near.
    if not near or (end.publishes and likeness(end.topic, near[0]) < _SURELY):
        return ""
    return near[0]


def _may_be(one: TopicEnd, end: TopicEnd, is_whole: bool) -> bool:
    if one.topic == end.topic:
        return False
    if not one.type or not end.type:
        return is_whole and len(end.topic) > _SHORT
    return same_type(one.type, end.type)


def _digits(topic: str) -> str:
    """Return the digits of a topic: those with others are numbered on purpose."""
    return re.sub(r"\D", "", topic)


def _parts(name: str) -> tuple[str, str]:
    package, _, last = name.rpartition("/")
    return package.partition("/")[0], last


def _of_ros1(name: str) -> str:
    package, last = _parts(name)
    return f"{package}/{last}" if package else last
