"""``plugin.*``, the stream ``plugin`` and ``/plugin/…``."""

from __future__ import annotations

from typing import Any, Literal, TypedDict

from gazelle.studio.errors import StudioError
from gazelle.studio.http_answers import Answer
from gazelle.studio.plugins.panel_sources import Source
from gazelle.studio.plugins.rqt.plugin_xml import rqt_plugins
from gazelle.studio.plugins.rqt.porting import PortedPlugin, how_to_port
from gazelle.studio.plugins.shown_panels import ShownPanels
from gazelle.studio.request_params import Params
from gazelle.studio.routing import Method, Route, methods_without
from gazelle.studio.streams import Channel, OpenStream, StreamKind
from gazelle.workspace import Workspace

__all__ = [
    "METHODS",
    "ROUTES",
    "STREAMS",
    "PanelEntry",
    "PanelInfo",
    "file_answer",
    "list_panels",
    "open_panel",
    "port_panel",
    "reload_panel",
    "take_event",
]

_ENDINGS = (".js", ".mjs")


class PanelEntry(TypedDict):
    """A panel that could be opened.

    Attributes:
        problem: why it cannot, empty when it can.
    """

    name: str
    kind: Literal["panel", "rqt"]
    title: str
    group: str
    about: str
    problem: str


class PanelInfo(TypedDict):
    """A panel that is open.

    Attributes:
        module: where its ES module is.
    """

    title: str
    file: str
    module: str | None


def list_panels(shown_panels: ShownPanels, _params: Params) -> list[PanelEntry]:
    """``plugin.list``: what could be opened; no code of it runs."""
    panels: list[PanelEntry] = [
        {
            "name": source.name,
            "kind": "panel",
            "title": source.title,
            "group": source.texts.get("group", ""),
            "about": source.texts.get("about") or source.origin,
            "problem": source.problem,
        }
        for source in shown_panels.sources().values()
    ]
    foreign: list[PanelEntry] = [
        {
            "name": plugin.name,
            "kind": "rqt",
            "title": plugin.label,
            "group": "",
            "about": f"a plug-in of rqt in package {plugin.package}: how to port it",
            "problem": "",
        }
        for plugin in rqt_plugins(Workspace.discover())
    ]
    return panels + foreign


def open_panel(shown_panels: ShownPanels, channel: Channel, params: Params) -> OpenStream:
    """Stream ``plugin``: events of one panel, whose code starts with its first page."""
    shown = shown_panels.show(params.text("name"))
    leave = shown.follow(channel)
    source = shown.source
    script = _script(source)
    info: PanelInfo = {
        "title": source.title,
        "file": str(source.file),
        "module": f"/plugin/{source.name}.js" if script else None,
    }
    return OpenStream(leave, info)


def take_event(shown_panels: ShownPanels, params: Params) -> dict[str, Any]:
    """``plugin.event``: what a person did with a widget."""
    running = shown_panels.shown(params.text("name")).running
    if running is None:
        raise StudioError(f"the panel '{params.text('name')}' is not open")
    running.event(params.text("widget", ""), params.any("value", None))
    return {}


def reload_panel(shown_panels: ShownPanels, params: Params) -> dict[str, Any]:
    """``plugin.reload``: the panel begins anew with its file as it is now."""
    name = params.text("name")
    shown = shown_panels.shown(name)
    # A file that cannot be read now is no panel of the list; trying it tells why.
    shown.reload(shown_panels.sources().get(name, shown.source))
    return {}


def port_panel(params: Params) -> PortedPlugin:
    """``plugin.port``: how a plug-in of rqt becomes a panel."""
    return how_to_port(params.text("name"), Workspace.discover())


def file_answer(shown_panels: ShownPanels, rest: str) -> Answer | None:
    """``/plugin/<name>.js``: the ES module; ``/plugin/<name>/<widget>``: a picture."""
    name, slash, widget = rest.partition("/")
    if slash:
        try:
            return shown_panels.picture(name, widget)
        except StudioError:
            return None
    source = shown_panels.sources().get(name.removesuffix(".js"))
    path = _script(source) if source is not None and name.endswith(".js") else None
    if path is None:
        return None
    return Answer(path.read_bytes(), "text/javascript; charset=utf-8")


def _script(source: Source) -> Any:
    """Return the ES module's file: in the folder of the panel's file or below, nowhere else."""
    name = source.texts.get("module", "")
    folder = source.file.parent.resolve()
    path = (folder / name).resolve()
    inside = path.is_relative_to(folder) and path.suffix in _ENDINGS
    return path if name and inside and path.is_file() else None


METHODS: dict[str, Method[ShownPanels]] = {
    "plugin.event": take_event,
    "plugin.list": list_panels,
    **methods_without({"plugin.port": port_panel}),
    "plugin.reload": reload_panel,
}
STREAMS: dict[str, StreamKind[ShownPanels]] = {"plugin": StreamKind(latest=False, open=open_panel)}
ROUTES: dict[str, Route[ShownPanels]] = {"plugin": file_answer}
