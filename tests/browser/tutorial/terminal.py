"""Terminals in which a document's commands are typed, all on one graph."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ["Session", "open_panel"]


class Session:
    """What a person has open: ``roscore`` or a launch file first, windows beside it.

    Attributes:
        first: the first command.
        url: of the page that the windows share, as soon as one of them has said it.
    """

    def __init__(self, run: Callable[..., Any], line: str, **options: Any) -> None:
        self._run, self._options = run, options
        self.url = ""
        self.first = self.type(line)

    def type(self, line: str) -> Any:
        """Type a command line in a terminal of its own."""
        return self._run(*line.split(), **self._options)

    def opens(self, line: str, panel: str) -> Any:
        """Type a command that opens a panel; all of them share one page."""
        command = self.type(line)
        self.shows(command, panel)
        return command

    def shows(self, command: Any, panel: str) -> None:
        """Wait until a command has said where its panel is."""
        said = command.wait_for_line(rf"{panel}: http://127\.0\.0\.1:\d+/\?token=\w+$")
        url = said.split(f"{panel}: ")[1].strip()
        assert self.url in ("", url)
        self.url = url

    def eventually(self, condition: Callable[[], Any]) -> Any:
        """Return what a condition gives as soon as that is true."""
        return self.first.eventually(condition)

    def listen(self, topic: str, type_name: str) -> list[Any]:
        """Return a list that a topic's messages are added to, its first one already in it."""
        got: list[Any] = []
        self.first.node.create_subscription(topic, type_name, got.append)
        self.eventually(lambda: got)
        return got


def open_panel(seen: Any, title: str) -> None:
    """Choose a panel from the menu Panels."""
    seen.page.get_by_role("button", name="Panels", exact=True).click()
    menu = seen.page.get_by_role("menu", name="Panels")
    menu.get_by_role("menuitem").filter(has_text=title).first.click()
