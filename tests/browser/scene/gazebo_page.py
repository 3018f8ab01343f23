"""Gazebo's panels in a page, used as a person does."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ["GazeboPage"]


class GazeboPage:
    """The panels gazebo, entities, inspector, insert and joints-force of a page.

    Attributes:
        seen: the look at the page.
        simulation: the world it shows.
    """

    def __init__(
        self, seen: Any, simulation: Any, eventually: Callable[[Callable[[], Any]], Any]
    ) -> None:
        self.seen, self.simulation, self._eventually = seen, simulation, eventually
        self.eventually(lambda: seen.page.evaluate("Boolean(window.gazelle?.scene)"))

    def eventually(self, condition: Callable[[], Any]) -> Any:
        """Return what a condition gives as soon as that is true."""

        def patient() -> Any:
            self.seen.page.wait_for_timeout(50)
            return condition()

        return self._eventually(patient)

    def report(self) -> dict[str, Any]:
        """What the view tells of itself."""
        return dict(self.seen.page.evaluate("gazelle.scene('gazebo')"))

    def pose(self, body: str) -> list[float]:
        """Where the page draws a body."""
        return list(self.seen.page.evaluate(f"gazelle.pose('{body}', 'gazebo')"))

    def screen(self, body: str) -> tuple[float, float]:
        """Where the middle of a body is on the page."""
        at = self.seen.page.evaluate(f"gazelle.screen('{body}', 'gazebo')")
        return at["x"], at["y"]

    def overlays(self, mode: str) -> int:
        """How many bodies show a view mode."""
        return int(self.seen.page.evaluate(f"gazelle.overlays('{mode}')"))

    def click(self, body: str, button: str = "left") -> None:
        """Click a body in the view."""
        self.seen.page.mouse.click(*self.screen(body), button=button)

    def tool(self, name: str) -> None:
        """Choose a tool."""
        self.panel("gazebo").get_by_role("button", name=name, exact=True).click()

    def view(self, name: str) -> None:
        """Choose an entry of the menu View."""
        self.panel("gazebo").get_by_role("button", name="View", exact=True).click()
        self.seen.page.get_by_role("menuitemcheckbox", name=name).click()

    def panel(self, kind: str) -> Any:
        """The panel of a kind, its tab in front."""
        found = self.seen.panel(kind)
        titles = {
            "entities": "World",
            "inspector": "Properties",
            "joints-force": "Joints",
            "insert": "Insert",
        }
        if kind in titles and not found.is_visible():
            self.seen.page.locator(".dv-tab").filter(has_text=titles[kind]).click()
        return found

    def drag(self, begin: tuple[float, float], end: tuple[float, float]) -> None:
        """Press at a place of the page and let go at another."""
        mouse = self.seen.page.mouse
        mouse.move(*begin)
        mouse.down()
        mouse.move((begin[0] + end[0]) / 2, (begin[1] + end[1]) / 2, steps=3)
        mouse.move(*end, steps=3)
        mouse.up()
