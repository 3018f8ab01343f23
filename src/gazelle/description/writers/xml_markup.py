"""XML that is being written: elements, comments, numbers in their shortest exact form."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from textwrap import wrap
from xml.sax.saxutils import escape, quoteattr

from gazelle.description.writers.output_files import OutputFiles
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics, Severity
from gazelle.geometry import Pose, quat_xyzw_from_rpy

__all__ = [
    "Markup",
    "exact_rpy",
    "from_tag",
    "head_comments",
    "number",
    "numbers",
    "report_addresses",
    "tidy",
    "xyz_rpy",
]

_MAX = 40
_WIDTH = 96
_DECIMALS = 12


@dataclass(slots=True)
class Markup:
    """An element; a comment when it has no name."""

    name: str
    attributes: dict[str, str] = field(default_factory=dict)
    text: str = ""
    children: list[Markup] = field(default_factory=list)

    def add(self, name: str, text: str = "", /, **attributes: str) -> Markup:
        """Append a child and return it."""
        child = Markup(name, dict(attributes), text)
        self.children.append(child)
        return child

    def comment(self, text: str) -> None:
        """Append a comment; it is wrapped, and no text can end it early."""
        self.children.append(Markup("", text=text))

    def to_text(self, head: Iterable[str] = ()) -> str:
        """Return the document, a declaration and these comments before it."""
        lines = ['<?xml version="1.0"?>']
        lines += [line for text in head for line in _comment_lines(text, "")]
        return "\n".join([*lines, *_lines(self, ""), ""])


def head_comments(source: str, found: Diagnostics) -> list[str]:
    """Return comments: where the file comes from, and what was lost or said differently.

    Args:
        source: name of the file converted, or of its format.
        found: the conversion's findings.
    """
    comments = [f"Converted by gazelle convert from {source}."]
    lost = [item.message for item in found if item.severity >= Severity.WARNING]
    changed = [item.message for item in found if item.severity < Severity.WARNING]
    for title, messages in (("Not in this file:", lost), ("Said differently:", changed)):
        shown = [f"- {message}" for message in messages[:_MAX]]
        if len(messages) > _MAX:
            shown.append(f"- and {len(messages) - _MAX} more")
        if shown:
            comments.append("\n".join([title, *shown]))
    return comments


def report_addresses(output_files: OutputFiles, diagnostics: Diagnostics) -> None:
    """Report files that must be copied to where their new address leads."""
    for address, path in output_files.to_copy.items():
        message = f"'{path}' is named {address} and is not there yet"
        diagnostics.report("convert.file-address", message)


def number(value: float) -> str:
    """Return the shortest text that is read back as the same number."""
    if isinstance(value, int):
        return str(value)
    text = repr(float(value))
    text = text.removesuffix(".0")
    return "0" if text == "-0" else text


def numbers(values: Iterable[float]) -> str:
    """Return numbers separated by spaces."""
    return " ".join(map(number, values))


def tidy(value: float) -> float:
    """Return a computed length or angle without the noise of its last digits."""
    return round(value, _DECIMALS) + 0.0


def exact_rpy(pose: Pose) -> tuple[float, float, float]:
    """Return roll, pitch, yaw that give the rotation back to rounding, at the poles too.

    `Pose.rpy_rad` takes an arc sine, which loses half of the digits at ±90° of pitch. Here roll is
    read from what is left of the rotation when the yaw found has been taken away.
    """
    m = pose.matrix()
    yaw = math.atan2(m[1, 0], m[0, 0]) if math.hypot(m[0, 0], m[1, 0]) > 1e-12 else 0.0
    sine, cosine = math.sin(yaw), math.cos(yaw)
    pitch = math.atan2(-m[2, 0], cosine * m[0, 0] + sine * m[1, 0])
    roll = math.atan2(sine * m[0, 2] - cosine * m[1, 2], cosine * m[1, 1] - sine * m[0, 1])
    return (roll, pitch, yaw)


def xyz_rpy(pose: Pose) -> tuple[str, str]:
    """Return a pose's metres and radians as texts, without the noise of their last digits."""
    return numbers(map(tidy, pose.position_m)), numbers(_short_rpy(pose))


def from_tag(tag: Tag) -> Markup:
    """Return an element of a file as it was, text in several lines with its indentation."""
    lines = tag.raw_text.strip("\n").rstrip() if not tag.children else ""
    text = tag.raw_text.rstrip(" ") if "\n" in lines else tag.text
    return Markup(tag.name, dict(tag.attributes), text, [from_tag(child) for child in tag.children])


def _short_rpy(pose: Pose) -> tuple[float, float, float]:
    """Return the shortest angles whose rotation is the same; at the poles noise is large."""
    roll, pitch, yaw = exact_rpy(pose)
    for digits in (4, 6, 8, 10):
        short = (round(roll, digits) + 0.0, round(pitch, digits) + 0.0, round(yaw, digits) + 0.0)
        turn = quat_xyzw_from_rpy(short)
        side = math.copysign(1.0, sum(a * b for a, b in zip(pose.quat_xyzw, turn, strict=True)))
        away = max(abs(a - side * b) for a, b in zip(pose.quat_xyzw, turn, strict=True))
        if away < 1e-13:
            return short
    return tidy(roll), tidy(pitch), tidy(yaw)


def _lines(markup: Markup, indent: str) -> list[str]:
    if not markup.name:
        return _comment_lines(markup.text, indent)
    attributes = "".join(f" {key}={quoteattr(value)}" for key, value in markup.attributes.items())
    head = f"{indent}<{markup.name}{attributes}"
    if not markup.children:
        text = escape(markup.text)
        return [f"{head}>{text}</{markup.name}>" if text else f"{head}/>"]
    inner = [f"{indent}  {escape(markup.text)}"] if markup.text else []
    inner += [line for child in markup.children for line in _lines(child, indent + "  ")]
    return [f"{head}>", *inner, f"{indent}</{markup.name}>"]


def _comment_lines(text: str, indent: str) -> list[str]:
    safe = text.replace("--", "- -")
    safe = f"{safe} " if safe.endswith("-") else safe
    paragraphs = [
        line for part in safe.split("\n") for line in wrap(part, _WIDTH - len(indent) - 10) or [""]
    ]
    if len(paragraphs) == 1:
        return [f"{indent}<!-- {paragraphs[0]} -->"]
    return [f"{indent}<!--", *(f"{indent}  {line}".rstrip() for line in paragraphs), f"{indent}-->"]
