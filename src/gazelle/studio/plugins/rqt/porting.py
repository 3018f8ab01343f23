"""The answer to a plug-in of rqt: what stands for its widgets, and a panel to begin with."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TypedDict

from gazelle.studio.errors import StudioError
from gazelle.studio.plugins.rqt.plugin_xml import RqtPlugin, rqt_plugins
from gazelle.studio.plugins.rqt.ui_files import FormWidget, form_layout, form_widgets
from gazelle.workspace import Workspace

__all__ = ["PortedForm", "PortedPlugin", "PortedWidget", "how_to_port"]

_UI = re.compile(r"['\"/]([\w.-]+\.ui)\b")
_HANDLED = ("Slider", "Number", "Checkbox", "Choice", "TextInput")


class PortedWidget(TypedDict):
    """A widget of Qt, and the Python expression that makes ours.

    Attributes:
        name: its `objectName`.
        qt: its class in Qt.
        line: in the `.ui` file.
        ours: empty when there is none.
        note: what to know about it.
    """

    name: str
    qt: str
    line: int
    ours: str
    note: str


class PortedForm(TypedDict):
    """A form of Qt Designer, and what stands for its widgets."""

    file: str
    widgets: list[PortedWidget]


class PortedPlugin(TypedDict):
    """How a plug-in of rqt becomes a panel.

    Attributes:
        manifest: file and line that name it.
        source: its file, empty where it is not known.
        target: where the panel belongs.
        code: of a panel to begin with.
    """

    name: str
    title: str
    text: str
    manifest: str
    source: str
    target: str
    forms: list[PortedForm]
    code: str


def how_to_port(name: str, workspace: Workspace) -> PortedPlugin:
    """Return the value of ``plugin.port``.

    Args:
        name: ``package/type``, or a package or type alone, as ``rqt -s`` takes them.
        workspace: whose packages are searched.

    Raises:
        StudioError: no package has such a plug-in.
    """
    plugins = rqt_plugins(workspace)
    wanted = [one for one in plugins if name in (one.name, one.type, one.package)]
    if not wanted:
        known = [one.name for one in plugins]
        raise StudioError(f"there is no plug-in of rqt '{name}'", known=known)
    plugin = wanted[0]
    forms = _forms(plugin)
    return {
        "name": plugin.name,
        "title": plugin.label,
        "text": _text(plugin),
        "manifest": f"{plugin.manifest}:{plugin.line}",
        "source": str(plugin.source or ""),
        "target": str(_target(plugin)),
        "forms": [
            {"file": str(form), "widgets": [_widget(one) for one in form_widgets(form)]}
            for form in forms
        ],
        "code": _code(plugin, forms),
    }


def _widget(one: FormWidget) -> PortedWidget:
    return {"name": one.name, "qt": one.qt, "line": one.line, "ours": one.ours, "note": one.note}


def _text(plugin: RqtPlugin) -> str:
    text = f"{plugin.type} is a plug-in of rqt: it draws with Qt, which a page in a browser cannot "
    text += "run. "
    if plugin.is_python:
        text += "Its code for topics and services stays; only its window is written anew, as a "
    else:
        text += "It is C++; its window and callbacks are written anew in Python, as a "
    return text + f"panel in {_target(plugin)}."


def _target(plugin: RqtPlugin) -> Path:
    return plugin.folder / "panels" / f"{_snake(_class_name(plugin))}.py"


def _class_name(plugin: RqtPlugin) -> str:
    last = re.split(r"\.|::", plugin.type)[-1]
    made = re.sub(r"\W|Plugin$", "", last) or "Mine"
    return made[0].upper() + made[1:]


def _snake(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def _forms(plugin: RqtPlugin) -> list[Path]:
    """Return the forms that the source names; all of the package when it names none."""
    every = sorted(plugin.folder.rglob("*.ui"))
    source = plugin.source
    text = source.read_text(encoding="utf-8", errors="replace") if source is not None else ""
    named = set(_UI.findall(text))
    return [form for form in every if form.name in named] or every


def _code(plugin: RqtPlugin, forms: list[Path]) -> str:
    """Return a panel with the widgets of the forms and their callbacks."""
    widgets = [one for form in forms for one in form_widgets(form) if one.ours]
    lines = [line for form in forms for line in form_layout(form, 2)]
    kinds = set(re.findall(r"^\s*(\w+)\(", "\n".join(lines), re.MULTILINE)) | {"Panel"}
    head = [
        f"from gazelle.studio.plugins import {', '.join(sorted(kinds))}",
        "",
        "",
        f"class {_class_name(plugin)}(Panel):",
        f'    title = "{plugin.label}"',
        "    widgets = (",
        *(lines or ['        # Slider("speed", min=0.0, max=1.0, unit="m/s"),']),
        "    )",
        "",
        "    def start(self, node):",
        "        self.node = node",
    ]
    return "\n".join([*head, *(line for one in widgets for line in _handler(one)), ""])


def _handler(widget: FormWidget) -> list[str]:
    kind = widget.ours.partition("(")[0]
    name = widget.ours.partition('"')[2].partition('"')[0]
    if kind == "Button":
        return ["", f"    def on_{name}(self):", f"        ...  # what {widget.qt}.clicked called"]
    if kind in _HANDLED:
        return ["", f"    def on_{name}(self, value):", f"        ...  # what {widget.qt} called"]
    return []
