"""The page's generated sources."""

from __future__ import annotations

import json
from collections.abc import Callable

from gazelle.bag.formats import OWN_FORMATS
from gazelle.bag.storage import Encoding
from gazelle.studio.displays.display import display_row
from gazelle.studio.displays.registry import DISPLAYS
from gazelle.studio.protocol import STREAMS
from gazelle.studio.typescript.interfaces import interface, type_text
from gazelle.studio.typescript.messages import ADDED, ALIASES, MESSAGES, ROS_MESSAGES
from gazelle.studio.typescript.ros import ros_interfaces

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


def _drawings() -> str:
    used: dict[str, set[str]] = {}
    rows = []
    for display in DISPLAYS.values():
        module, _, constant = display.drawing.partition(":")
        used.setdefault(module, set()).add(constant)
        rows.append(f"  {display.name}: {constant},\n")
    imports = [
        f"import {{ {', '.join(sorted(names))} }} from '../{module}';\n"
        for module, names in sorted(used.items())
    ]
    return (
        _HEAD.format(what="What draws the displays of `gazelle.studio.displays.registry`")
        + "import type { Drawing } from '../displays/display';\n"
        + "".join(imports)
        + "import type { DisplayName } from './displays';\n\n"
        + f"export const DRAWINGS: Record<DisplayName, Drawing> = {{\n{''.join(rows)}}};\n"
    )


def _bags() -> str:
    kinds = {Encoding.ROS1: "ROS 1", Encoding.CDR: "rosbag2"}
    rows = "".join(
        f"  [{json.dumps(one.suffix.removeprefix('.'))},"
        f" {json.dumps(f'{kinds[one.encoding]} {one.suffix}')}],\n"
        for one in OWN_FORMATS
    )
    return (
        _HEAD.format(what="What topics are recorded into: the formats of `gazelle.bag.formats`")
        + f"export const BAG_FORMATS = [\n{rows}] as const;\n"
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
    "bags.ts": _bags,
    "displays.ts": _displays,
    "drawings.ts": _drawings,
    "messages.ts": _messages,
    "streams.ts": _streams,
}
"""Their names and what gives their texts."""
