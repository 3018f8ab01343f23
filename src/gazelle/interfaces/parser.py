"""Text of .msg, .srv and .action files → definitions, with findings at line and column."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from gazelle.errors import InterfaceError
from gazelle.interfaces.definition import (
    FORMATS,
    Array,
    Constant,
    Definition,
    Field,
    FieldType,
    RosVersion,
)
from gazelle.interfaces.definition_values import constant_value, default_value

if TYPE_CHECKING:
    from gazelle.diagnostics import Diagnostics

__all__ = ["parse_message", "split_parts"]

_TYPE = re.compile(
    r"(?P<base>[A-Za-z][\w/]*)(?:<=(?P<string>\d+))?(?P<array>\[(?P<bound><=)?(?P<size>\d*)\])?$"
)
_NAME = re.compile(r"[A-Za-z]\w*$")
_STRING_CONSTANT = re.compile(r"(w?string(?:<=\d+)?)\s+(\w+)\s*=(.*)$")
_PRIMITIVES = frozenset(FORMATS) | {"string", "wstring"}
_TIMES = {"time": "builtin_interfaces/msg/Time", "duration": "builtin_interfaces/msg/Duration"}


class _Reading:
    def __init__(
        self, name: str, ros_version: RosVersion, file: str, diagnostics: Diagnostics | None
    ) -> None:
        self.name = name
        self.ros_version = ros_version
        self.file = file
        self.diagnostics = diagnostics
        self.constants: list[Constant] = []
        self.fields: list[Field] = []
        self.line = ""
        self.number = 0

    def report(self, code: str, message: str, word: str = "", *, fix: str = "") -> None:
        if self.diagnostics is None:
            raise InterfaceError(f"{self.file}:{self.number}: {message}")
        from gazelle.diagnostics import SourceSpan

        column = self.line.find(word) + 1 if word else 0
        span = SourceSpan(self.file, self.number, column, len(word) if column else 0)
        self.diagnostics.report(code, message, span, fix=fix)


def split_parts(
    text: str, count: int, *, file: str, diagnostics: Diagnostics | None
) -> tuple[tuple[str, int], ...] | None:
    """Split a service's or action's text at its ``---`` lines.

    Args:
        text: the whole file.
        count: how many parts there must be: 2 of a service, 3 of an action.
        file: name of the file in findings.
        diagnostics: takes the finding; None as in `parse_message`.

    Returns:
        Text and number of the first line of each part; None when the count is wrong.

    Raises:
        InterfaceError: the count is wrong and nothing takes the finding.
    """
    parts: list[list[str]] = [[]]
    starts = [1]
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip() == "---":
            parts.append([])
            starts.append(number + 1)
        else:
            parts[-1].append(line)
    if len(parts) != count:
        kind = "a service" if count == 2 else "an action"
        reading = _Reading("", RosVersion.ROS2, file, diagnostics)
        reading.number = starts[-1] - 1 if len(parts) > 1 else 1
        reading.report(
            "interfaces.missing-separator",
            f"{kind} has {count - 1} line(s) of '---', this file has {len(parts) - 1}",
        )
        return None
    return tuple(("\n".join(part), start) for part, start in zip(parts, starts, strict=True))


def parse_message(
    text: str,
    name: str,
    ros_version: RosVersion,
    *,
    diagnostics: Diagnostics | None,
    file: str = "",
    first_line: int = 1,
) -> Definition:
    """Read the text of one message (or of one part of a service or action).

    Args:
        text: the definition.
        name: full name, such as ``my_robot/msg/Battery``; bare type names are of its package.
        ros_version: ROS 1 knows ``time``, ``duration``, bare ``Header`` and no defaults.
        diagnostics: takes all findings; lines with errors are left out of the result. None for
            texts that have none, such as Gazelle's own data.
        file: name of the file in findings; the message's name in angle brackets when empty.
        first_line: number of the text's first line in the file.

    Returns:
        The definition of all lines that are right.

    Raises:
        InterfaceError: there is a finding and nothing that takes it.
    """
    reading = _Reading(name, ros_version, file or f"<{name}>", diagnostics)
    for number, line in enumerate(text.splitlines(), first_line):
        reading.line, reading.number = line, number
        _read_line(reading)
    return Definition(name, ros_version, tuple(reading.constants), tuple(reading.fields), text)


def _read_line(reading: _Reading) -> None:
    line = reading.line.strip()
    if not line or line.startswith(("#", "@")):
        return
    if match := _STRING_CONSTANT.match(line):
        _add_constant(reading, match[1], match[2], _string_text(match[3], reading.ros_version))
        return
    code = _without_comment(line)
    tokens = code.split(None, 1)
    if len(tokens) < 2:
        reading.report(
            "interfaces.bad-line", f"'{code}' has a type but no name, or the reverse", code
        )
        return
    kind, rest = tokens
    if re.match(r"\w+\s*=(?!=)", rest):
        name, _, value = rest.partition("=")
        _add_constant(reading, kind, name.strip(), value.strip())
    else:
        name, _, default = rest.partition(" ")
        _add_field(reading, kind, name.strip(), default.strip())


def _without_comment(line: str) -> str:
    quote = ""
    for index, letter in enumerate(line):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "\"'":
            quote = letter if letter in line[index + 1 :] else ""
        elif letter == "#":
            return line[:index].strip()
    return line


def _string_text(text: str, ros_version: RosVersion) -> str:
    """A ROS 1 string constant is the rest of the line, comments included (genmsg)."""
    return text.strip() if ros_version is RosVersion.ROS1 else _without_comment(text.strip())


def _add_constant(reading: _Reading, kind: str, name: str, text: str) -> None:
    base = kind.partition("<=")[0]
    if base not in _PRIMITIVES:
        reading.report("interfaces.bad-type", f"a constant cannot be of type '{kind}'", kind)
        return
    if not _new_name(reading, name):
        return
    try:
        value = constant_value(base, text, quoted=reading.ros_version is RosVersion.ROS2)
    except ValueError as error:
        reading.report("interfaces.bad-value", f"{kind} {name}: {error}", text)
        return
    reading.constants.append(Constant(name, base, value, text))


def _add_field(reading: _Reading, kind: str, name: str, default: str) -> None:
    parsed = _field_type(reading, kind)
    if parsed is None or not _new_name(reading, name):
        return
    value = None
    if default:
        if reading.ros_version is RosVersion.ROS1:
            reading.report(
                "interfaces.bad-line",
                f"'{default}' follows the field's name; ROS 1 fields have no default",
                default,
                fix=f"write '{kind} {name}', or '{kind} {name.upper()}={default}' for a constant",
            )
            return
        if parsed.is_message:
            reading.report("interfaces.bad-value", f"{kind} fields have no default", default)
            return
        try:
            value = default_value(parsed, default)
        except ValueError as error:
            reading.report("interfaces.bad-value", f"{kind} {name}: {error}", default)
            return
    reading.fields.append(Field(name, parsed, value))


def _new_name(reading: _Reading, name: str) -> bool:
    if not _NAME.match(name):
        reading.report("interfaces.bad-name", f"'{name}' cannot be a name", name)
        return False
    known = {item.name for item in reading.constants} | {item.name for item in reading.fields}
    if name in known:
        reading.report("interfaces.repeated-name", f"'{name}' is there already", name)
        return False
    return True


def _field_type(reading: _Reading, text: str) -> FieldType | None:
    match = _TYPE.match(text)
    base = _resolved(reading, match["base"]) if match else None
    if match is None or base is None:
        from gazelle.diagnostics import did_you_mean

        near = did_you_mean(text, sorted(_PRIMITIVES))
        reading.report("interfaces.bad-type", f"'{text}' is not a type", text, fix=near)
        return None
    if match["string"] and base not in ("string", "wstring"):
        reading.report("interfaces.bad-type", f"only strings have a bound, {base} not", text)
        return None
    size = int(match["size"] or 0)
    if not match["array"]:
        array = Array.ONE
    elif match["bound"] or not match["size"]:
        array = Array.SEQUENCE
    else:
        array = Array.FIXED
    return FieldType(base, array, size, int(match["string"] or 0))


def _resolved(reading: _Reading, base: str) -> str | None:
    if base in _PRIMITIVES:
        return base
    if base in _TIMES:
        return base if reading.ros_version is RosVersion.ROS1 else _TIMES[base]
    if base == "Header" and reading.ros_version is RosVersion.ROS1:
        return "std_msgs/msg/Header"
    parts = base.split("/")
    if len(parts) == 1 and base[0].isupper():
        return f"{reading.name.split('/', 1)[0]}/msg/{base}"
    if len(parts) == 2 and all(parts):
        return f"{parts[0]}/msg/{parts[1]}"
    if len(parts) == 3 and parts[1] in ("msg", "srv", "action") and all(parts):
        return base
    return None
