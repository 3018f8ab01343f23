"""The page's generated sources."""

from __future__ import annotations

import json
from collections.abc import Callable

from gazelle.studio.catalogue import STREAMS
from gazelle.studio.displays.display import display_row
from gazelle.studio.displays.registry import DISPLAYS
from gazelle.studio.typescript.messages import ADDED, ALIASES, MESSAGES, ROS_MESSAGES
from gazelle.studio.typescript.ros import ros_interfaces
from gazelle.studio.typescript.types import interface, type_text

__all__ = ["FILES", "FOLDER"]

FOLDER = "studio/src/generated"
_HEAD = "/** {what}. Generated: `python -m gazelle.studio.typescript`. */\n"


def _displays() -> str:
    rows = "".join(
        f"  {row.name}: {json.dumps(display_row(row), ensure_ascii=False)},\n"
        for row in DISPLAYS.values()
    )
    return (
        _HEAD.format(what="The rows of `gazelle.studio.displays.registry`")
        + "import type { DisplayRow } from './messages';\n\n"
        + f"export const DISPLAY_ROWS = {{\n{rows}}} satisfies Record<string, DisplayRow>;\n\n"
        + "export type DisplayName = keyof typeof DISPLAY_ROWS;\n"
    )


def _messages() -> str:
    aliases = (f"export type {name} = {type_text(kind)};\n" for name, kind in ALIASES.items())
    of_ros = ros_interfaces(ROS_MESSAGES, ADDED)
    text = "\n".join((*map(interface, MESSAGES), *of_ros, *aliases))
    json_type = "import type { Json } from '../json';\n" if "Json" in text else ""
    what = "What the server sends, as its Python types declare it"
    return f"{_HEAD.format(what=what)}{json_type}\n{text}"


def _streams() -> str:
    latest = [name for name, kind in sorted(STREAMS.items()) if kind.latest]
    rows = "".join(f"  {json.dumps(name)},\n" for name in latest)
    return (
        _HEAD.format(what="Streams of which only the newest item counts; these are acknowledged")
        + f"export const LATEST_STREAMS: ReadonlySet<string> = new Set([\n{rows}]);\n"
    )


FILES: dict[str, Callable[[], str]] = {
    "displays.ts": _displays,
    "messages.ts": _messages,
    "streams.ts": _streams,
}
"""Their names and what gives their texts."""
