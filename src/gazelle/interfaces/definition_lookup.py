"""Name → definition, for messages, services and actions of both generations."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from gazelle.errors import NotFoundError
from gazelle.interfaces.definition import Definition, Field, FieldType, RosVersion
from gazelle.interfaces.definition_library import Library, Source
from gazelle.interfaces.ros1_conversion import as_ros_version, definition_text
from gazelle.interfaces.type_names import split_name

if TYPE_CHECKING:
    from gazelle.diagnostics import Diagnostics

__all__ = ["exists", "known_types", "read_definition"]

_SERVICE_PARTS = ("_Request", "_Response")
_ACTION_PARTS = ("_Goal", "_Result", "_Feedback")
_UUID = FieldType("unique_identifier_msgs/msg/UUID")
_TIME = FieldType("builtin_interfaces/msg/Time")


def read_definition(library: Library, name: str, ros_version: RosVersion) -> Definition:
    """Return a message's definition by the rules of one generation.

    One written for that generation comes first; else the other generation's is translated.

    Args:
        library: has the texts.
        name: full name; parts of services and actions are ``pkg/srv/Name_Request`` and so on.
        ros_version: whose rules.

    Raises:
        NotFoundError: nothing defines it.
        UserFileError: its text has errors.
    """
    package, part, bare = split_name(name)
    other = RosVersion.ROS1 if ros_version is RosVersion.ROS2 else RosVersion.ROS2
    for candidate in (ros_version, other):
        where = _where(library, package, part, bare, candidate)
        if where is not None:
            found = _read(library, f"{package}/{part}/{bare}", where, candidate)
            return as_ros_version(found, ros_version)
    raise _not_found(library, name, part, bare)


def exists(library: Library, name: str) -> bool:
    """Return whether something defines this message, without reading its text."""
    package, part, bare = split_name(name)
    return any(_where(library, package, part, bare, one) is not None for one in RosVersion)


def known_types(library: Library, part: str = "msg", package: str = "") -> tuple[str, ...]:
    """Return the full names of all types of a part (``msg``, ``srv``, ``action``), sorted.

    Messages that ROS 1 makes from actions (``FibonacciActionGoal`` …) are in the list too.
    """
    names = set()
    for ros_version in RosVersion:
        for owner, its_part, bare in library.block_names(ros_version, package):
            if its_part == part:
                names.add(f"{owner}/{part}/{bare}")
            if its_part == "action" and part == "msg" and ros_version is RosVersion.ROS1:
                names |= {f"{owner}/msg/{bare}{suffix}" for suffix in _DERIVED}
    return tuple(sorted(names))


def _where(
    library: Library, package: str, part: str, bare: str, ros_version: RosVersion
) -> tuple[str, str] | None:
    """Return part and name of the file that defines a message, None when there is none."""
    if part == "msg":
        if library.find_source(package, "msg", bare, ros_version):
            return "msg", bare
        if ros_version is RosVersion.ROS1:
            for suffix in _DERIVED:
                base = bare.removesuffix(suffix)
                if base != bare and library.find_source(package, "action", base, ros_version):
                    return "action", base
        return None
    pattern = _SRV_NAME if part == "srv" else _ACTION_NAME
    match = re.fullmatch(pattern, bare)
    if match and library.find_source(package, part, match[1], ros_version):
        return part, match[1]
    return None


def _read(
    library: Library, name: str, where: tuple[str, str], ros_version: RosVersion
) -> Definition:
    from gazelle.interfaces.parser import parse_message, split_parts

    package, part, bare = split_name(name)
    file_part, file_name = where
    source = library.find_source(package, file_part, file_name, ros_version)
    if source is None:
        raise NotFoundError("type", name)
    diagnostics = _collector(source)
    if file_part == "msg":
        found = parse_message(
            source.text, name, ros_version, diagnostics=diagnostics, file=source.file
        )
        _check_references(library, found, source.file, 1, diagnostics)
        _raise_findings(diagnostics)
        return found
    suffixes = _SERVICE_PARTS if file_part == "srv" else _ACTION_PARTS
    pieces = split_parts(source.text, len(suffixes), file=source.file, diagnostics=diagnostics)
    found_parts: dict[str, Definition] = {}
    for suffix, (text, line) in zip(suffixes, pieces or (), strict=False):
        piece = f"{package}/{file_part}/{file_name}{suffix}"
        found_parts[suffix] = parse_message(
            text, piece, ros_version, diagnostics=diagnostics, file=source.file, first_line=line
        )
        _check_references(library, found_parts[suffix], source.file, line, diagnostics)
    _raise_findings(diagnostics)
    suffix = bare[len(file_name) :]
    if part == "msg":
        return _ros1_action_message(package, file_name, suffix, found_parts)
    if suffix in found_parts:
        return found_parts[suffix]
    fields = _implied_fields(package, part, file_name)[suffix]
    return Definition(name, ros_version, (), fields, definition_text((), fields, ros_version))


def _collector(source: Source) -> Diagnostics | None:
    """Users' files are checked and reported; Gazelle's own data is right (tests see to it)."""
    if not source.is_own:
        return None
    from gazelle.diagnostics import Diagnostics

    return Diagnostics()


def _raise_findings(diagnostics: Diagnostics | None) -> None:
    if diagnostics is not None:
        diagnostics.raise_if_errors()


def _ros1_action_message(
    package: str, name: str, suffix: str, parts: dict[str, Definition]
) -> Definition:
    """Messages that genaction writes for an action; actionlib's documented layout."""
    full = f"{package}/msg/{name}{suffix}"
    if f"_{suffix}" in parts:
        part = parts[f"_{suffix}"]
        return Definition(full, RosVersion.ROS1, part.constants, part.fields, part.text)
    own = f"{package}/msg/{name}"
    header = Field("header", FieldType("std_msgs/msg/Header"))
    status = Field("status", FieldType("actionlib_msgs/msg/GoalStatus"))
    fields = {
        "ActionGoal": (
            header,
            Field("goal_id", FieldType("actionlib_msgs/msg/GoalID")),
            Field("goal", FieldType(f"{own}Goal")),
        ),
        "ActionResult": (header, status, Field("result", FieldType(f"{own}Result"))),
        "ActionFeedback": (header, status, Field("feedback", FieldType(f"{own}Feedback"))),
        "Action": (
            Field("action_goal", FieldType(f"{own}ActionGoal")),
            Field("action_result", FieldType(f"{own}ActionResult")),
            Field("action_feedback", FieldType(f"{own}ActionFeedback")),
        ),
    }[suffix]
    text = "\n".join(
        f"{item.type.text(RosVersion.ROS1).removeprefix(package + '/')} {item.name}"
        for item in fields
    ).replace("std_msgs/Header header", "Header header")
    return Definition(full, RosVersion.ROS1, (), fields, text)


def _implied_fields(package: str, part: str, name: str) -> dict[str, tuple[Field, ...]]:
    """Messages that rosidl adds to services and actions (REP-2012, ROS 2 actions design)."""
    own = f"{package}/{part}/{name}"
    stamp = Field("stamp", _TIME)
    goal_id = Field("goal_id", _UUID)
    status = Field("status", FieldType("int8"))
    return {
        "_SendGoal_Request": (goal_id, Field("goal", FieldType(f"{own}_Goal"))),
        "_SendGoal_Response": (Field("accepted", FieldType("bool")), stamp),
        "_GetResult_Request": (goal_id,),
        "_GetResult_Response": (status, Field("result", FieldType(f"{own}_Result"))),
        "_FeedbackMessage": (goal_id, Field("feedback", FieldType(f"{own}_Feedback"))),
    }


def _check_references(
    library: Library,
    found: Definition,
    file: str,
    first_line: int,
    diagnostics: Diagnostics | None,
) -> None:
    if diagnostics is None:
        return
    from gazelle.diagnostics import SourceSpan, did_you_mean

    for item in found.fields:
        if not item.type.is_message or exists(library, item.type.base):
            continue
        short = item.type.base.replace("/msg/", "/")
        line, column = _place(found.text, item.name, first_line)
        near = did_you_mean(item.type.base, known_types(library))
        span = SourceSpan(file, line, column)
        message = f"type '{short}' is not known"
        diagnostics.report("interfaces.unknown-type", message, span, fix=near)


def _place(text: str, field_name: str, first_line: int) -> tuple[int, int]:
    for number, line in enumerate(text.splitlines(), first_line):
        if match := re.match(rf"(\s*)\S+\s+{field_name}\b", line):
            return number, len(match[1]) + 1
    return first_line, 0


def _not_found(library: Library, name: str, part: str, bare: str) -> NotFoundError:
    from gazelle.diagnostics import nearest_names

    shown = name.replace("/msg/", "/")
    kind = {"msg": "message type", "srv": "service type", "action": "action type"}[part]
    everything = known_types(library, part)
    base = bare.partition("_")[0] if part != "msg" else bare
    same_name = tuple(item for item in everything if item.rsplit("/", 1)[1] == base)
    near = same_name[:3] or nearest_names(name, everything)
    return NotFoundError(
        kind,
        shown,
        nearest=near,
        hint="a package's own types are found when the package is in the workspace "
        "(ROS: Unable to load msg)",
    )


_DERIVED = (
    "ActionGoal",
    "ActionResult",
    "ActionFeedback",
    "Action",
    "Goal",
    "Result",
    "Feedback",
)
_SRV_NAME = r"(\w+?)_(?:Request|Response)"
_ACTION_NAME = (
    r"(\w+?)_(?:Goal|Result|Feedback|SendGoal_Request|SendGoal_Response"
    r"|GetResult_Request|GetResult_Response|FeedbackMessage)"
)
