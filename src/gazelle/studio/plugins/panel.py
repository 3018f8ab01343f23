"""What a user's panel derives from."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

if TYPE_CHECKING:
    from gazelle.studio.plugins.panel_node import PanelNode
    from gazelle.studio.plugins.widgets import Part

__all__ = ["Panel", "PanelLink"]


class PanelLink(Protocol):
    """What stands between a panel and the pages that show it."""

    def value(self, name: str) -> Any:
        """Return a widget's value."""

    def set(self, name: str, value: Any) -> None:
        """Show another value."""

    def add(self, name: str, values: Iterable[float], time_s: float | None) -> None:
        """Add to a plot's curves."""

    def change(self, name: str, properties: Mapping[str, Any]) -> None:
        """Replace a widget by one with other properties."""

    def every(self, period_s: float, callback: Callable[[], Any]) -> None:
        """Call something again and again."""

    def send(self, value: Any) -> None:
        """Hand a value to the panel's ES module."""


class Panel:
    """A panel of the page. All pages that show it share one object of the class.

    A widget ``speed`` calls ``on_speed(self, value)``, a button ``stop`` calls ``on_stop(self)``,
    unless the widget names another method. What is called by the panel's widgets, topics,
    services and timers is never called twice at a time. An exception is shown in the panel with
    file and line; the panel goes on.

    Attributes:
        title: in the tab and in the menu; the class's name when empty.
        group: of the Panels menu, one of rqt's (``Robot Tools``, ``Topics`` …) or ``Plugins``.
        about: a short line for the menu.
        widgets: what it shows, from above to below.
        module: file name of an ES module beside the panel's file, for drawing of your own.
    """

    title: ClassVar[str] = ""
    group: ClassVar[str] = "Plugins"
    about: ClassVar[str] = ""
    widgets: ClassVar[tuple[Part, ...]] = ()
    module: ClassVar[str] = ""

    _link: PanelLink | None = None

    def start(self, node: PanelNode) -> None:
        """Called once, when the first page shows the panel."""

    def stop(self) -> None:
        """Called when no page shows it any more; topics are closed without it."""

    def on_message(self, value: Any) -> None:
        """Called with what the panel's ES module sends."""

    def __getitem__(self, name: str) -> Any:
        """Return a widget's value."""
        return self._linked().value(name)

    def __setitem__(self, name: str, value: Any) -> None:
        """Show a value on all pages; no callback is called.

        An `Image` takes a ``sensor_msgs`` picture, an array (H, W), (H, W, 3) or (H, W, 4) of
        bytes, or the bytes of a PNG or JPEG file.
        """
        self._linked().set(name, value)

    def add(self, name: str, *values: float, time_s: float | None = None) -> None:
        """Add a point to every curve of a `Plot`, in the order of its curves.

        Args:
            name: of the plot.
            values: one for each curve, NaN for a gap.
            time_s: the graph's time when None.
        """
        self._linked().add(name, values, time_s)

    def change(self, name: str, **properties: Any) -> None:
        """Change a widget: ``self.change("stop", enabled=False)``, ``options=…``, ``max=…``."""
        self._linked().change(name, properties)

    def every(self, period_s: float, callback: Callable[[], Any]) -> None:
        """Call something every so many seconds of real time, until the panel stops."""
        self._linked().every(period_s, callback)

    def send(self, value: Any) -> None:
        """Hand a JSON value to the panel's ES module on all pages."""
        self._linked().send(value)

    def _linked(self) -> PanelLink:
        if self._link is None:
            text = f"{type(self).__name__}: widgets have values from start() on, not in __init__()"
            raise RuntimeError(text)
        return self._link
