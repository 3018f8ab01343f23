"""Robot descriptions as parameters of ROS 2: text that its YAML parser must take for a string."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["check_description_text"]

# Where libyaml ends a plain scalar: a colon before white space, a number sign behind it.
_END = re.compile(r":(?=\s)|(?<=\s)#")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_PLUGINS = re.compile(r"gazebo_ros2_control|ign_ros2_control")
_SHOWN = 60


def check_description_text(
    text: str, *, file: str, diagnostics: Diagnostics, sources: Sequence[Path] = ()
) -> None:
    """Report what keeps a robot description from being passed to a ROS 2 node as a parameter.

    gazebo_ros2_control and ign_ros2_control hand the text to the controller manager as
    ``-p robot_description:=…``, which is read as YAML (gazebo_ros2_control#295). A colon before
    white space makes a mapping of it; such colons stand in comments, as a rule.

    Args:
        text: URDF, expanded; texts without one of these plug-ins have no such finding.
        file: name for the places.
        diagnostics: receives the findings.
        sources: files that the text was expanded from, to say where a comment was written.
    """
    if not _PLUGINS.search(text):
        return
    comments = list(_COMMENT.finditer(text))
    for comment in comments:
        end = _END.search(text, comment.start() + 4, comment.end() - 3)
        if end is not None:
            shown = " ".join(comment[0].split())
            shown = f"{shown[:_SHOWN]}…" if len(shown) > _SHOWN else shown
            place = _written(comment[0], end.start() - comment.start(), sources)
            _report(
                place or _span(text, end.start(), file), end[0], f"the comment {shown}", diagnostics
            )
    outside = next((end for end in _END.finditer(text) if not _is_inside(end, comments)), None)
    if outside is not None:
        _report(_span(text, outside.start(), file), outside[0], "the description", diagnostics)


def _is_inside(end: re.Match[str], comments: list[re.Match[str]]) -> bool:
    return any(comment.start() <= end.start() < comment.end() for comment in comments)


def _written(comment: str, offset: int, sources: Sequence[Path]) -> SourceSpan | None:
    """Return the place of a comment in the files it may have come from."""
    for path in sources:
        try:
            text = path.read_text(encoding="utf-8", errors="replace")
        except OSError:
            continue
        start = text.find(comment)
        if start >= 0:
            return _span(text, start + offset, str(path))
    return None


def _span(text: str, start: int, file: str) -> SourceSpan:
    line = text.count("\n", 0, start) + 1
    return SourceSpan(file, line, start - text.rfind("\n", 0, start), 1)


def _report(span: SourceSpan, found: str, what: str, diagnostics: Diagnostics) -> None:
    sign = "a colon before a space" if found == ":" else "a # behind a space"
    message = f"{what} has {sign}: ros2_control's plug-in of Gazebo passes the description as a "
    message += "YAML parameter, where that ends the text (Couldn't parse parameter override rule); "
    message += "Gazelle passes it as it is"
    fix = f"take the '{found}' out, or the whole comment"
    diagnostics.report("parameters.colon-in-description", message, span, fix=fix)
