"""Methods of settings."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.studio.params import Params
from gazelle.studio.session import Studio
from gazelle.studio.settings.layouts import (
    delete_layout,
    list_layouts,
    load_layout,
    save_layout,
)
from gazelle.studio.settings.perspectives import open_perspective
from gazelle.studio.settings.rviz_files import open_rviz

__all__ = ["METHODS"]

METHODS: dict[str, Callable[[Studio, Params], Any]] = {
    "layout.delete": delete_layout,
    "layout.list": list_layouts,
    "layout.load": load_layout,
    "layout.save": save_layout,
    "perspective.open": open_perspective,
    "rviz.open": open_rviz,
}
