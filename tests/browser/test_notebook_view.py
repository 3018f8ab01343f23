"""A simulation's live view inside of another page, as notebooks put it into a cell."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.simulator import Simulation

_CART = """<robot name="cart"><link name="world"/><link name="cart"><inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  <visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <joint name="slide" type="prismatic"><parent link="world"/><child link="cart"/>
  <axis xyz="1 0 0"/><limit lower="-9" upper="9" effort="50" velocity="9"/></joint></robot>"""


class _Notebook(ThreadingHTTPServer):
    """A page of another origin with a cell's output in it."""

    def __init__(self, html: str) -> None:
        body = f"<!doctype html><meta charset='utf-8'><body>{html}</body>".encode()

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                self.send_response(200)
                self.send_header("Content-Type", "text/html; charset=utf-8")
                self.end_headers()
                self.wfile.write(body)

            def log_message(self, *_: object) -> None:
                """Say nothing."""

        super().__init__(("127.0.0.1", 0), Handler)
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def url(self, host: str) -> str:
        return f"http://{host}:{self.server_port}/"


@pytest.fixture
def sim() -> Iterator[Simulation]:
    """A cart on a rail."""
    with Simulation.load(_CART, world="empty") as made:
        yield made


@pytest.fixture
def opened(browser: Any) -> Iterator[Callable[..., Any]]:
    """Opens a cell's output in a page of an origin of its own."""
    with contextlib.ExitStack() as stack:

        def make(html: str, host: str = "localhost") -> Any:
            notebook = _Notebook(html)
            stack.callback(notebook.server_close)
            stack.callback(notebook.shutdown)
            context = browser.new_context()
            stack.callback(context.close)
            page = context.new_page()
            page.set_default_timeout(stretched() * 1000)
            page.goto(notebook.url(host))
            return page

        yield make


def _frame(page: Any) -> Any:
    page.wait_for_selector("iframe[title=Gazelle]")
    return page.frames[1]


@pytest.mark.parametrize("host", ["localhost", "127.0.0.1"])
def test_the_robot_moves_in_a_cell_while_a_program_steps_it(
    sim: Simulation, opened: Callable[..., Any], host: str
) -> None:
    view = sim.view(real_time_factor=None)
    page = opened(view.bundle()["text/html"], host)  # type: ignore[attr-defined]
    frame = _frame(page)

    def drawn_x() -> float:
        page.wait_for_timeout(50)
        pose = frame.evaluate("window.gazelle?.pose?.('cart::cart', 'gazebo')")
        return float(pose[0]) if pose else -1.0

    frame.wait_for_selector(".light[data-state=open]")
    eventually(lambda: abs(drawn_x()) < 1e-3)
    sim.joint("slide").command_velocity(0.5)
    sim.run(seconds=3.0)
    eventually(lambda: abs(drawn_x() - sim.joint("slide").position) < 1e-3)
    assert sim.joint("slide").position > 1.0


def test_a_page_of_another_origin_is_shown_nothing(
    sim: Simulation, opened: Callable[..., Any]
) -> None:
    view = sim.view()
    html = view.bundle()["text/html"]  # type: ignore[attr-defined]
    own = _frame(opened(html))
    own.wait_for_selector(".light[data-state=open]")
    other = opened(html)
    other.wait_for_selector("iframe[title=Gazelle]")
    # Chromium shows a page of its own where it may not show the one that is asked for.
    eventually(lambda: other.wait_for_timeout(50) or other.frames[1].url.startswith("chrome-error"))
    assert view.watchers == 1


def test_a_view_that_has_ended_leaves_the_picture(
    sim: Simulation, opened: Callable[..., Any]
) -> None:
    view = sim.view()
    html = view.bundle()["text/html"]  # type: ignore[attr-defined]
    view.close()
    page = opened(html)
    page.wait_for_selector("[data-gazelle-view][data-ready]")
    page.wait_for_load_state("networkidle")
    assert page.locator("iframe").count() == 0
    assert "The live page is here while the kernel runs" in page.inner_text("body")


def test_the_values_under_the_mouse_are_told_in_a_chart(
    sim: Simulation, opened: Callable[..., Any]
) -> None:
    sim.joint("slide").command_velocity(0.5)
    sim.run(seconds=1.0)
    page = opened(sim.plot("slide/velocity").bundle()["text/html"])  # type: ignore[attr-defined]
    box = page.locator("svg").bounding_box()
    page.mouse.move(box["x"] + 0.8 * box["width"], box["y"] + 0.5 * box["height"])
    page.get_by_text("slide/velocity = 0.5").wait_for()
