"""The panel MotionPlanning of a page, used as a person does."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from tests.browser.scene.rviz_page import RvizPage

__all__ = ["MotionPanel"]


class MotionPanel:
    """The panel beside RViz's view.

    Attributes:
        rviz: the view.
        panel: the panel itself.
        eventually: returns what a condition gives as soon as that is true.
    """

    def __init__(self, seen: Any, bench: Any) -> None:
        self.rviz = RvizPage(seen, bench)
        self.eventually: Callable[[Callable[[], Any]], Any] = self.rviz.eventually
        self.panel = seen.panel("motion_planning")
        self.panel.wait_for()

    @property
    def page(self) -> Any:
        """Playwright's page."""
        return self.rviz.seen.page

    def counts(self) -> dict[str, int]:
        """What the display draws."""
        return self.rviz.counts("MotionPlanning")

    def shows(self, **wanted: int) -> None:
        """Wait until the display draws so many of each."""
        self.rviz.shows("MotionPlanning", **wanted)

    def well(self) -> None:
        """Wait until the display has nothing to complain about."""
        last: dict[str, Any] = {}

        def is_well() -> bool:
            last.update(self.rviz.report()["displays"].get("MotionPlanning", {}))
            return bool(last.get("level") == "ok" and last["counts"]["goal"])

        try:
            self.eventually(is_well)
        except AssertionError:
            raise AssertionError(f"MotionPlanning: {last.get('status')}") from None

    def tab(self, name: str) -> None:
        """Bring a tab to the front."""
        self.panel.get_by_role("tab", name=name).click()

    def button(self, name: str) -> Any:
        """A button of the panel."""
        return self.panel.get_by_role("button", name=name, exact=True)

    def press(self, name: str) -> None:
        """Press a button of the panel."""
        self.button(name).click()

    def choose(self, field: str, value: str) -> None:
        """Choose an option of a list."""
        self.panel.get_by_label(field, exact=True).select_option(value)

    def type(self, field: str, text: str) -> None:
        """Type into a field."""
        found = self.panel.get_by_label(field, exact=True)
        found.fill(text)
        found.press("Enter")

    def check(self, text: str, on: bool = True) -> None:
        """Set a check box."""
        self.panel.get_by_role("checkbox", name=text).set_checked(on)

    def says(self, words: str, line: str = "Result") -> str:
        """Wait until a status line says something; returns the line."""
        found = self.panel.get_by_role("status", name=line, include_hidden=True)
        last = ""

        def said() -> bool:
            nonlocal last
            last = str(found.inner_text())
            return words in last

        try:
            self.eventually(said)
        except AssertionError:
            raise AssertionError(f"{line} says {last!r}, not {words!r}") from None
        return last

    def place_of(self, joints: list[str]) -> list[float]:
        """Where the goal has joints, as the tab Joints tells."""
        return [float(self.panel.get_by_label(f"{name} position").input_value()) for name in joints]

    def drag(
        self,
        axis: str,
        by: float,
        marker: str = "goal",
        at: tuple[float, float, float] | None = None,
    ) -> None:
        """Pull an arrow of a marker outwards.

        Args:
            axis: of the arrow.
            by: in lengths of the arrow; below 0 the one at its other end is pulled.
            marker: its name.
            at: where in the fixed frame the page shall have it first.
        """
        control = f"gazelle.handle('{marker}', 'move_{axis}', {1 if by > 0 else -1})"

        def grasp() -> Any:
            found = self.page.evaluate(control)
            if not found or at is None:
                return found
            x, y = self.rviz.project(*at)
            is_there = math.dist((x, y), (found["middle"]["x"], found["middle"]["y"])) < 3
            return is_there and found

        begin = self.eventually(grasp)
        along = [abs(by) * (begin[side] - begin["middle"][side]) for side in "xy"]
        mouse = self.page.mouse
        mouse.move(begin["x"], begin["y"])
        mouse.down()
        mouse.move(begin["x"] + along[0], begin["y"] + along[1], steps=6)
        mouse.up()

    def names(self) -> list[str]:
        """The objects that the tab Scene Objects lists."""
        rows = self.panel.locator("[data-object]")
        return list(rows.evaluate_all("rows => rows.map((row) => row.dataset.object)"))

    def add_solid(self, shape: str, **sizes: float) -> None:
        """Add a shape in the tab Scene Objects."""
        self.choose("Shape", shape)
        for name, size in sizes.items():
            self.panel.get_by_label(f"{shape} {name} (m)").fill(str(size))
        chosen = self.panel.locator("[data-object][aria-selected=true]")
        before = self.names()
        self.press("Add")
        self.eventually(lambda: len(self.names()) > len(before))
        self.eventually(
            lambda: chosen.count() and chosen.get_attribute("data-object") not in before
        )

    def place_object(self, **numbers: float) -> None:
        """Type where the chosen object shall be."""
        for name, value in numbers.items():
            self.type(f"Object {name}", str(value))
