"""``perspective.open``: rqt's ``.perspective`` file as panels of the page."""

from __future__ import annotations

import ast
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from gazelle.documents import read_text_limited
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params

__all__ = ["open_perspective", "perspective_value"]

_MANAGER = "pluginmanager"
_RUNNING = "running-plugins"
# Settings that are topics: of the plug-in, ours.
_SETTINGS = {"rqt_plot": ("topics", "curves"), "rqt_image_view": ("topic", "topic")}
_USUAL = "The panels that are there stay."


def open_perspective(params: Params) -> dict[str, Any]:
    """``perspective.open``: of a ``path`` on this machine or of a ``text``."""
    if "text" in params:
        return perspective_value(params.text("text"), params.text("name", "the perspective"))
    path = Path(params.text("path")).expanduser()
    try:
        return perspective_value(read_text_limited(path), str(path))
    except OSError as error:
        raise StudioError(f"cannot read {path}: {error.strerror}", hint=_USUAL) from None
    except UnicodeDecodeError as error:
        raise StudioError(f"cannot read {path}: {error}", hint=_USUAL) from None


def perspective_value(text: str, name: str) -> dict[str, Any]:
    """Return ``{"panels": [{"kind", "params"}]}`` of a perspective.

    Raises:
        StudioError: it is no perspective.
    """
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise StudioError(f"{name} is no perspective: {error}") from None
    groups = content.get("groups", {}) if isinstance(content, dict) else {}
    manager = groups.get(_MANAGER, {}) if isinstance(groups, dict) else {}
    running = _value(manager, _RUNNING)
    if not isinstance(running, dict):
        raise StudioError(f"{name} is no perspective: it names no running plug-ins")
    return {"panels": list(_panels(running, manager.get("groups", {})))}


def _panels(running: Mapping[Any, Any], groups: Any) -> Iterator[dict[str, Any]]:
    for plugin, numbers in sorted(running.items(), key=lambda item: str(item[0])):
        kind, _, class_name = str(plugin).partition("/")
        for number in numbers if isinstance(numbers, list) else ():
            key = f"plugin__{kind}__{class_name}__{number}"
            settings = _plugin_settings(groups, key)
            yield {"kind": kind, "params": _params(kind, settings)}


def _plugin_settings(groups: Any, key: str) -> Any:
    found = groups.get(key, {}) if isinstance(groups, dict) else {}
    inner = found.get("groups", {}) if isinstance(found, dict) else {}
    return inner.get("plugin", {}) if isinstance(inner, dict) else {}


def _params(kind: str, settings: Any) -> dict[str, Any]:
    theirs, ours = _SETTINGS.get(kind, ("", ""))
    value = _value(settings, theirs) if theirs else None
    if not value:
        return {}
    if ours == "curves":
        names = value if isinstance(value, list) else [value]
        return {ours: [str(name) for name in names]}
    return {ours: str(value)}


def _value(group: Any, key: str) -> Any:
    """Values are kept as Python's own text; what Qt has packed says nothing to a page."""
    entry = group.get("keys", {}).get(key) if isinstance(group, dict) else None
    text = entry.get("repr") if isinstance(entry, dict) else None
    if not isinstance(text, str):
        return None
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError, RecursionError, MemoryError):
        return None
