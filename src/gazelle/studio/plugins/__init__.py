"""Panels of your own on the page: derive from `Panel`, list widgets, write callbacks."""

from __future__ import annotations

from gazelle.studio.plugins.panel import Panel
from gazelle.studio.plugins.panel_node import PanelNode
from gazelle.studio.plugins.widgets import (
    Button,
    Checkbox,
    Choice,
    Column,
    Image,
    Label,
    Number,
    Plot,
    Row,
    Slider,
    Table,
    TextInput,
    Widget,
)

__all__ = [
    "Button",
    "Checkbox",
    "Choice",
    "Column",
    "Image",
    "Label",
    "Number",
    "Panel",
    "PanelNode",
    "Plot",
    "Row",
    "Slider",
    "Table",
    "TextInput",
    "Widget",
]
