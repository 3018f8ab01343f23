"""RViz's panel in a page, used as a person does."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ["RvizPage", "stamped"]


def stamped(frame: str = "map") -> dict[str, Any]:
    """A header in a frame."""
    return {"frame_id": frame}


class RvizPage:
    """The panels rviz and displays of a page.

    Attributes:
        seen: the look at the page.
    """

    def __init__(self, seen: Any, bench: Any) -> None:
        self.seen, self._bench = seen, bench
        self._eventually: Callable[[Callable[[], Any]], Any] = bench.eventually
        self.eventually(lambda: seen.page.evaluate("Boolean(window.gazelle?.scene)"))

    def eventually(self, condition: Callable[[], Any]) -> Any:
        """Return what a condition gives as soon as that is true."""

        def patient() -> Any:
            self.seen.page.wait_for_timeout(50)
            return condition()

        return self._eventually(patient)

    def add(self, topic: str, display: str) -> None:
        """Add a display by its topic, in the dialog."""
        panel = self.seen.panel("displays")
        panel.get_by_role("button", name="Add", exact=True).click()
        dialog = self.seen.page.get_by_role("dialog", name="Add a display")
        dialog.get_by_role("tab", name="By topic").click()
        rows = dialog.get_by_role("option").filter(has_text=topic)
        rows.filter(has_text=f"{display} ·").first.click()

    def report(self) -> dict[str, Any]:
        """What the view tells of itself."""
        return dict(self.seen.page.evaluate("gazelle.scene('rviz')"))

    def display(self, name: str) -> dict[str, Any]:
        """What a display tells of itself."""
        return dict(self.report()["displays"][name])

    def counts(self, name: str) -> dict[str, int]:
        """What a display draws, in numbers; nothing before it is in the list."""
        return dict(self.report()["displays"].get(name, {}).get("counts", {}))

    def shows(self, name: str, **wanted: int) -> None:
        """Wait until a display draws so many of each."""
        last: dict[str, int] = {}

        def there() -> bool:
            last.update(self.counts(name))
            return all(last.get(key) == value for key, value in wanted.items())

        try:
            self.eventually(there)
        except AssertionError:
            raise AssertionError(f"{name}: {last}, {self.display(name)['status']}") from None

    def set(self, display: str, prop: str, value: str | bool) -> None:
        """Type a property of a display into its row."""
        row = self.opened(display)
        field = row.get_by_label(prop, exact=True).first
        if isinstance(value, bool):
            field.set_checked(value)
        elif field.evaluate("field => field.tagName") == "SELECT":
            field.select_option(value)
        else:
            field.fill(value)
            field.press("Enter")

    def opened(self, display: str) -> Any:
        """A display's row in the tree with its properties."""
        row = self.row(display)
        if row.get_attribute("aria-expanded") == "false":
            row.get_by_role("button", name=f"Properties of {display}").click()
        return row

    def row(self, display: str) -> Any:
        """A display's row in the tree."""
        return self.seen.panel("displays").get_by_role("treeitem", name=display, exact=True)

    def project(self, x: float, y: float, z: float = 0.0) -> tuple[float, float]:
        """Where a point of the scene is on the page."""
        at = self.seen.page.evaluate(f"gazelle.project([{x}, {y}, {z}], 'rviz')")
        return at["x"], at["y"]

    def drag(self, begin: tuple[float, float], end: tuple[float, float]) -> None:
        """Press at a place of the page and let go at another."""
        mouse = self.seen.page.mouse
        mouse.move(*begin)
        mouse.down()
        mouse.move((begin[0] + end[0]) / 2, (begin[1] + end[1]) / 2, steps=3)
        mouse.move(*end, steps=3)
        mouse.up()
