"""What a configuration of Gazebo's window does to a world: its control may let the world go."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.documents import read_text_limited

__all__ = ["lets_world_go"]

_CONTROL = re.compile(r"(?:lib)?WorldControl(?:\.so)?")
_DECLARATION = re.compile(r"\s*<\?xml.*?\?>", re.DOTALL)
_YES = frozenset({"true", "1"})
_NO = frozenset({"false", "0"})


def lets_world_go(world: str, gui_config: str, diagnostics: Diagnostics | None = None) -> bool:
    """Tell whether the window's ``WorldControl`` starts a world without ``-r``.

    It does where ``<start_paused>`` says no. A file of ``--gui-config`` counts in place of the
    world's own ``<gui>``.

    Args:
        world: the world's file, empty for the empty world.
        gui_config: the file that is named, empty for none.
        diagnostics: hears what is wrong in `gui_config`; the world's reader tells of the world.

    Raises:
        OSError, UnicodeDecodeError: `gui_config` cannot be read.
    """
    file = Path(gui_config or world)
    try:
        text = read_text_limited(file) if str(file) != "." else ""
    except (OSError, UnicodeDecodeError):
        if gui_config:
            raise
        return False
    # A configuration has no root of its own.
    inside = _DECLARATION.sub("", text, count=1)
    heard = diagnostics if gui_config and diagnostics is not None else Diagnostics()
    root = parse_xml(f"<gui>{inside}</gui>", str(file), heard)
    if root is None:
        return False
    guis = (root,) if gui_config else (tag for tag in root.walk() if tag.name == "gui")
    return any(_starts(plugin) for gui in guis for plugin in _plugins(gui))


def _plugins(gui: Tag) -> Iterable[Tag]:
    found = (tag for tag in gui.find_all("plugin"))
    return (tag for tag in found if _CONTROL.fullmatch(tag.attributes.get("filename", "")))


def _starts(control: Tag) -> bool:
    has_buttons = control.text_of("play_pause").lower() in _YES
    return has_buttons and control.text_of("start_paused").lower() in _NO
