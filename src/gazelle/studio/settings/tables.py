"""Methods of settings."""

from __future__ import annotations

from gazelle.studio.routing import Method, methods_without
from gazelle.studio.settings.layouts import (
    delete_layout,
    list_layouts,
    load_layout,
    save_layout,
)
from gazelle.studio.settings.rqt_perspectives import open_perspective
from gazelle.studio.settings.rviz_files import open_rviz

__all__ = ["METHODS"]

METHODS: dict[str, Method[object]] = methods_without(
    {
        "layout.delete": delete_layout,
        "layout.list": list_layouts,
        "layout.load": load_layout,
        "layout.save": save_layout,
        "perspective.open": open_perspective,
        "rviz.open": open_rviz,
    }
)
