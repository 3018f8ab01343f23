"""A replay opened from a file: the robot moves, curves are drawn, nobody is asked for anything."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.patience import eventually, stretched
from tests.recorded import messages, rolling

from gazelle.recording import Recording
from gazelle.studio.replay import write_html

_EVIL = "</script><img src=x onerror=document.title='hit'>"


class _Opened:
    """A page from a file.

    Attributes:
        page: Playwright's page.
        asked: the addresses it asked for beside its own.
        problems: console errors and exceptions.
    """

    def __init__(self, context: Any, path: Path) -> None:
        self.page = context.new_page()
        self.asked: list[str] = []
        self.problems: list[str] = []
        own = path.as_uri()
        self.page.on("request", lambda one: self.asked.append(one.url))
        self.page.on("pageerror", lambda error: self.problems.append(str(error)))
        self.page.on(
            "console",
            lambda one: self.problems.append(one.text) if one.type in ("error", "warning") else 0,
        )
        self.page.goto(own)
        # A page that forbids eval lets no script of Playwright's wait.
        self.until("globalThis.shownReplay?.stage.view.drawn > 1")
        self.asked.remove(own)

    def until(self, condition: str) -> None:
        """Wait until something is true in the page."""
        eventually(lambda: self.page.evaluate(condition))

    def place(self, body: str) -> list[float]:
        """Where a body is drawn."""
        return list(
            self.page.evaluate(
                "name => { const {stage} = shownReplay;"
                "const one = stage.assembly.bodies.find((b) => b.value.name === name);"
                "return one.root.position.toArray(); }",
                body,
            )
        )


@pytest.fixture
def opened(browser: Any, tmp_path: Path) -> Iterator[Callable[..., _Opened]]:
    """Opens recordings; no page may have an error or ask for anything."""
    contexts, pages = [], []

    def make(recording: Recording, size: tuple[int, int] = (900, 600), **more: Any) -> _Opened:
        path = write_html(recording, tmp_path / f"{len(pages)}.html", title=more.pop("title", None))
        context = browser.new_context(viewport={"width": size[0], "height": size[1]}, **more)
        context.set_default_timeout(stretched() * 1000)
        contexts.append(context)
        pages.append(_Opened(context, path))
        return pages[-1]

    yield make
    for context in contexts:
        context.close()
    assert [(one.asked, one.problems) for one in pages] == [([], [])] * len(pages)


def _odom(t: float) -> dict[str, Any]:
    return {"pose": {"pose": {"position": {"x": t, "y": math.sin(t)}}}}


def _recording(seconds: float = 3.0) -> Recording:
    return rolling(seconds, topics=(messages("/odom", "nav_msgs/Odometry", seconds, 20.0, _odom),))


def test_time_moves_the_robot_values_and_keys_move_time(opened: Callable) -> None:
    look = opened(_recording())
    page = look.page
    assert look.place("cart::body")[0] == pytest.approx(0.0, abs=1e-3)
    page.keyboard.press("ArrowRight")
    assert look.place("cart::body")[0] == pytest.approx(1.0, abs=1e-3)
    page.keyboard.press("Shift+ArrowRight")
    assert look.place("cart::body")[0] == pytest.approx(1.04, abs=1e-3)
    slider = page.get_by_role("slider", name="Time")
    assert slider.get_attribute("aria-valuetext") == "1.0 of 3.00 seconds"
    page.get_by_text("/odom", exact=True).click()
    page.locator("tr", has_text="pose.pose.position.x").get_by_text("1", exact=True).wait_for()
    page.keyboard.press("End")
    page.locator("tr", has_text="pose.pose.position.x").get_by_text("2.95").wait_for()
    page.keyboard.press("Home")
    page.get_by_role("button", name="Play").click()
    look.until("shownReplay.player.time_s > 0.1")
    page.get_by_role("button", name="Pause").click()
    assert look.place("cart::body")[0] > 0.1
    assert page.get_by_role("combobox", name="Speed").input_value() == "1"


def test_the_robot_is_seen_and_curves_are_drawn(opened: Callable, tmp_path: Path) -> None:
    look = opened(_recording())
    page = look.page
    look.until("shownReplay.stage.following === 'cart'")
    page.evaluate("shownReplay.player.seek(2)")
    page.wait_for_timeout(0)
    page.evaluate("shownReplay.stage.view.drawNow()")
    page.screenshot(path=tmp_path / "a.png")
    seen = np.asarray(Image.open(tmp_path / "a.png").convert("RGB")).astype(int)
    red = (seen[..., 0] > 90) & (seen[..., 0] > 2 * seen[..., 1])
    assert 0.01 < red[:, :600].mean() < 0.4
    assert "x" in page.get_by_role("list", name="Curves").inner_text()
    drawn = page.evaluate(
        "(() => { const c = shownReplay.topics.plot.canvas; const d = c.getContext('2d')"
        ".getImageData(0, 0, c.width, c.height).data; let n = 0;"
        "for (let i = 3; i < d.length; i += 4) n += d[i] > 0; return n; })()"
    )
    assert drawn > 500


def test_it_is_light_where_the_person_wants_that_and_narrow_screens_have_all(
    opened: Callable,
) -> None:
    page = opened(_recording(), (380, 700), color_scheme="light").page
    assert page.evaluate("document.documentElement.dataset.theme") == "light"
    for role, name in (("slider", "Time"), ("button", "Play"), ("combobox", "Follow")):
        box = page.get_by_role(role, name=name).bounding_box()
        assert box is not None and box["x"] >= 0 and box["x"] + box["width"] <= 380
    page.get_by_role("button", name="Light or dark").click()
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    page.get_by_role("button", name="Topics").click()
    assert not page.get_by_role("complementary", name="Topics").is_visible()


def test_names_with_markup_are_shown_as_they_are(opened: Callable) -> None:
    words = messages("/word", "std_msgs/String", 1.0, 5.0, lambda _t: {"data": _EVIL})
    whole = rolling(1.0, name=f"cart{_EVIL}", topics=(replace(words, name=f"/{_EVIL}"),))
    page = opened(whole, title=_EVIL).page
    assert page.title() == _EVIL
    assert page.locator("img").count() == 0
    assert page.get_by_role("heading", name=_EVIL).is_visible()
    page.locator("summary").first.click()
    assert page.locator("td.value").inner_text() == _EVIL
    assert _EVIL in page.get_by_role("combobox", name="Follow").inner_text()


def test_it_works_in_a_frame_that_may_nothing_but_run_scripts(browser: Any, tmp_path: Path) -> None:
    from gazelle.studio.replay import render_html

    context = browser.new_context()
    page = context.new_page()
    page.set_content("<iframe sandbox='allow-scripts' width='600' height='400'></iframe>")
    page.evaluate(
        "html => document.querySelector('iframe').srcdoc = html", render_html(_recording(1.0))
    )
    page.frame_locator("iframe").get_by_role("slider", name="Time").wait_for()
    context.close()
