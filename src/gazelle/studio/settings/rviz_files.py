"""``rviz.open``: a ``.rviz`` file as the page takes it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, NotRequired, TypedDict

from gazelle.documents import read_text_limited
from gazelle.documents.yaml import YamlError, read_yaml
from gazelle.studio.displays.methods import find_display
from gazelle.studio.displays.registry import DISPLAYS
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params

__all__ = ["RvizDisplay", "RvizFile", "RvizTool", "RvizView", "open_rviz", "rviz_value"]

_GROUPS = ("Group",)
_TOPICS = dict.fromkeys(
    ("Topic", *(name for display in DISPLAYS.values() for name in display.topic_names))
)
# Of the views: RViz's word, ours.
_NUMBERS: dict[str, Literal["distance", "yaw", "pitch", "scale", "angle"]] = {
    "Distance": "distance",
    "Yaw": "yaw",
    "Pitch": "pitch",
    "Scale": "scale",
    "Angle": "angle",
}
_KNOWN_PARTS = ("Panels", "Visualization Manager", "Window Geometry", "Preferences", "Toolbars")
_USUAL = "The displays that are there stay."

RvizDisplay = TypedDict(
    "RvizDisplay",
    {
        "class": str,
        "name": str,
        "enabled": bool,
        "topic": NotRequired[str],
        "properties": dict[str, Any],
    },
)
"""A display as a file lists it; layouts keep the topic among the properties."""

RvizTool = TypedDict("RvizTool", {"class": str, "topic": str, "properties": dict[str, Any]})
"""A tool as a file lists it."""


class RvizView(TypedDict, total=False):
    """Where a file looks from, metres and rad; what it does not say is not there.

    Attributes:
        scale: pixels per metre.
    """

    kind: str
    distance: float
    yaw: float
    pitch: float
    scale: float
    angle: float
    focal: Annotated[list[float], 3]


class RvizFile(TypedDict):
    """What a `.rviz` file says.

    Attributes:
        unknown: its parts that mean nothing here.
    """

    fixed_frame: str
    background: str
    displays: list[RvizDisplay]
    view: RvizView
    tools: list[RvizTool]
    panels: list[str]
    unknown: list[str]


def open_rviz(params: Params) -> RvizFile:
    """``rviz.open``: of a ``path`` on this machine or of a ``text``."""
    if "text" in params:
        return rviz_value(params.text("text"), params.text("name", "the .rviz file"))
    path = Path(params.text("path")).expanduser()
    try:
        return rviz_value(read_text_limited(path), str(path))
    except OSError as error:
        raise StudioError(f"cannot read {path}: {error.strerror}", hint=_USUAL) from None
    except UnicodeDecodeError as error:
        raise StudioError(f"cannot read {path}: {error}", hint=_USUAL) from None


def rviz_value(text: str, name: str) -> RvizFile:
    """Return frame, displays, view, tools and panels of a ``.rviz`` file of either generation.

    Raises:
        StudioError: it is no such file; says where.
    """
    content = _content(text, name)
    manager = content.get("Visualization Manager")
    if not isinstance(manager, Mapping):
        raise StudioError(
            f"{name} is no .rviz file: it has no 'Visualization Manager'",
            known=[str(key) for key in content],
        )
    options = _mapping(manager.get("Global Options"))
    return {
        "fixed_frame": str(options.get("Fixed Frame", "")),
        "background": str(options.get("Background Color", "")),
        "displays": list(_displays(manager.get("Displays"))),
        "view": _view(_mapping(_mapping(manager.get("Views")).get("Current"))),
        "tools": [_tool(tool) for tool in _list(manager.get("Tools"))],
        "panels": [str(panel.get("Class", "")) for panel in _list(content.get("Panels"))],
        "unknown": sorted(str(key) for key in content if key not in _KNOWN_PARTS),
    }


def _content(text: str, name: str) -> Mapping[str, Any]:
    try:
        content = read_yaml(text, name).value
    except YamlError as error:
        problem = error.problem
        raise StudioError(f"{problem.span}: not YAML: {problem.what}") from None
    if not isinstance(content, Mapping):
        raise StudioError(f"{name} is no .rviz file: it holds {type(content).__name__}")
    return content


def _displays(found: Any, group: str = "", *, enabled: bool = True) -> Iterator[RvizDisplay]:
    """Yield all displays; those of a group have its name before theirs, and are off where it is."""
    for item in _list(found):
        short = _short(item.get("Class", ""))
        on = enabled and bool(item.get("Enabled", item.get("Value", True)))
        name = f"{group}{item.get('Name', short)}"
        if short in _GROUPS:
            yield from _displays(item.get("Displays"), f"{name}/", enabled=on)
            continue
        display = find_display(short)
        topics = (*_TOPICS, *(display.topic_names if display else ()))
        topic = next((_topic(item[key]) for key in topics if _topic(item.get(key))), "")
        skipped = {"Class", "Enabled", "Name", "Value", *topics}
        properties = {str(key): _plain(item[key]) for key in item if key not in skipped}
        if short == "RobotModel" and not topic and "Robot Description" in item:
            topic = _absolute(str(item["Robot Description"]))
        yield {
            "class": short,
            "name": name,
            "enabled": on,
            "topic": topic,
            "properties": properties,
        }


def _tool(item: Mapping[str, Any]) -> RvizTool:
    skipped = {"Class", "Topic"}
    return {
        "class": _short(item.get("Class", "")),
        "topic": _topic(item.get("Topic")),
        "properties": {str(key): _plain(item[key]) for key in item if key not in skipped},
    }


def _view(current: Mapping[str, Any]) -> RvizView:
    """Return the view in the page's words; what the file does not say is left out."""
    if not current:
        return {}
    value: RvizView = {"kind": _short(current.get("Class", "Orbit"))}
    for theirs, ours in _NUMBERS.items():
        if isinstance(current.get(theirs), int | float):
            value[ours] = _number(current[theirs])
    focal = _mapping(current.get("Focal Point"))
    if focal:
        value["focal"] = [_number(focal.get(axis)) for axis in "XYZ"]
    elif "X" in current and "Y" in current:
        value["focal"] = [_number(current["X"]), _number(current["Y"]), 0.0]
    return value


def _number(value: Any) -> float:
    """Return a number, also one that YAML 1.1 takes for a text such as ``1e-3``; 0 for others."""
    try:
        number = float(value) if isinstance(value, int | float | str) else 0.0
    except (ValueError, OverflowError):
        return 0.0
    return number if math.isfinite(number) else 0.0


def _topic(value: Any) -> str:
    """ROS 2 writes a topic with its quality of service: ``{Value: /scan, Depth: 5 …}``."""
    if isinstance(value, Mapping):
        value = value.get("Value", "")
    return _absolute(str(value)) if value else ""


def _absolute(name: str) -> str:
    return name if name.startswith("/") else f"/{name}"


def _short(name: Any) -> str:
    """``rviz/LaserScan`` and ``rviz_default_plugins/LaserScan`` are one display."""
    return str(name).rpartition("/")[2]


def _plain(value: Any) -> Any:
    """Return a value that JSON knows."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return value if isinstance(value, bool | int | float | str) or value is None else str(value)


def _mapping(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, Mapping) else {}


def _list(value: Any) -> list[Mapping[str, Any]]:
    return [item for item in value if isinstance(item, Mapping)] if isinstance(value, list) else []
