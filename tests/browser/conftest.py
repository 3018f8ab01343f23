"""A real browser on a real page: graphs with a Studio, and who looks at it.

Screenshots go to the folder ``GAZELLE_SCREENSHOTS`` names, or to the test's own temporary folder.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.graph import Graph, Node
from gazelle.interfaces import fill, message_type
from gazelle.studio import Server, Studio

# A browser that draws in software wants the machine for itself: these run after all others, by
# `pytest tests/browser`, not beside them in the processes of `pytest -n auto`.
collect_ignore_glob = ["*"] if "PYTEST_XDIST_WORKER" in os.environ else []

_CHROMIUM = ("chromium", "chromium-browser", "google-chrome")
_FLAGS = (
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)
_PAGE = Path(__file__).parents[2] / "src" / "gazelle" / "studio" / "page" / "index.html"


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """A headless Chromium that all tests of a process share."""
    api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    program = next(filter(None, map(shutil.which, _CHROMIUM)), None)
    if program is None:
        pytest.skip(f"no Chromium is installed (looked for {', '.join(_CHROMIUM)})")
    with api.sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=program, args=list(_FLAGS))
        yield started
        started.close()


class Look:
    """A page in a browser, and what went wrong in it.

    Attributes:
        page: Playwright's page.
        problems: console errors, exceptions, blocked or foreign requests.
    """

    def __init__(self, context: Any, folder: Path, name: str) -> None:
        self.page = context.new_page()
        self.problems: list[str] = []
        self.expected: list[str] = []
        self._folder = folder
        self._name = name
        self.page.on("console", self._on_console)
        self.page.on("pageerror", lambda error: self.problems.append(f"exception: {error}"))
        self.page.on("request", self._on_request)

    def panel(self, kind: str) -> Any:
        """The panel of a kind."""
        return self.page.locator(f"[data-panel='{kind}']")

    def toast(self) -> str:
        """Return the text of the newest message at the corner, as soon as there is one."""
        toast = self.page.locator(".toast").last
        toast.wait_for()
        return str(toast.inner_text())

    def shot(self, name: str = "") -> Path:
        """Save a screenshot."""
        path = self._folder / f"{self._name}{'-' if name else ''}{name}.png"
        self.page.screenshot(path=path)
        return path

    def expect_problem(self, pattern: str) -> None:
        """Let a regular expression's problems pass: the test brings them about."""
        self.expected.append(pattern)

    def unexpected(self) -> list[str]:
        """Return the problems that no test asked for."""
        return [
            one for one in self.problems if not any(re.search(each, one) for each in self.expected)
        ]

    def _on_console(self, message: Any) -> None:
        if message.type == "error":
            self.problems.append(f"console: {message.text} {message.location.get('url', '')}")

    def _on_request(self, request: Any) -> None:
        if not re.match(r"(http|ws)://127\.0\.0\.1[:/]|data:|blob:", request.url):
            self.problems.append(f"foreign request: {request.url}")


@pytest.fixture
def look(browser: Any, request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Any]:
    """Opens pages: ``look(url, "rqt_plot", "rqt_topic", theme="light")``; a failed test leaves a
    screenshot, and no page may have a console error or ask another machine for anything."""
    folder = Path(os.environ.get("GAZELLE_SCREENSHOTS") or tmp_path)
    folder.mkdir(parents=True, exist_ok=True)
    opened: list[tuple[Any, Look]] = []

    def make(
        url: str, *panels: str, theme: str = "dark", size: tuple[int, int] = (1280, 800)
    ) -> Look:
        context = browser.new_context(
            viewport={"width": size[0], "height": size[1]}, accept_downloads=True
        )
        context.set_default_timeout(stretched() * 1000)
        name = re.sub(r"\W+", "_", request.node.name)
        found = Look(context, folder, name if not opened else f"{name}-{len(opened) + 1}")
        opened.append((context, found))
        found.page.add_init_script(f"localStorage['gazelle.theme'] ??= '{theme}'")
        found.page.goto(f"{url}&panels={','.join(panels)}" if panels else url)
        found.page.locator(".light[data-state=open]").wait_for()
        return found

    yield make
    for context, found in opened:
        with contextlib.suppress(Exception):
            found.shot()
        context.close()
    for _, found in opened:
        assert not found.unexpected()


class Bench:
    """A graph with a Studio, and a node that plays the robot.

    Attributes:
        graph: the graph.
        node: the test's node.
        url: of the page.
    """

    def __init__(self, graph: Graph, node: Node, url: str) -> None:
        self.graph, self.node, self.url = graph, node, url
        self._publishers: dict[str, Any] = {}
        self._stop = threading.Event()
        self._threads: list[threading.Thread] = []

    def publish(self, topic: str, type_name: str, **fields: Any) -> None:
        """Publish one message."""
        message_class = message_type(type_name)
        if topic not in self._publishers:
            self._publishers[topic] = self.node.create_publisher(topic, message_class)
        message = message_class()
        fill(message, fields)
        self._publishers[topic].publish(message)

    def keep_publishing(
        self, topic: str, type_name: str, fields: Callable[[float], dict[str, Any]], hz: float = 20
    ) -> None:
        """Publish until the test ends; `fields` are given the seconds since the beginning."""
        begin = time.monotonic()

        def run() -> None:
            while not self._stop.wait(1 / hz):
                self.publish(topic, type_name, **fields(time.monotonic() - begin))

        self._threads.append(threading.Thread(target=run, daemon=True))
        self._threads[-1].start()

    def listen(self, topic: str, type_name: str) -> list[Any]:
        """Return a list that a topic's messages are added to."""
        got: list[Any] = []
        self.node.create_subscription(topic, message_type(type_name), got.append)
        return got

    def eventually(self, condition: Callable[[], Any]) -> Any:
        """Return what a condition gives as soon as that is true."""
        return eventually(condition)

    def close(self) -> None:
        """End the threads and the node."""
        self._stop.set()
        for thread in self._threads:
            thread.join()
        self.node.shutdown()


@pytest.fixture
def bench(free_port: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Bench]:
    """A graph of the test's own with a Studio on it, all in this process."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    if not _PAGE.is_file():
        pytest.skip("the page is not built (npm run build in studio/)")
    with (
        Graph.open(port=free_port, role="hub", environ={}) as graph,
        Server(Studio(graph, tmp_path), port=0) as server,
    ):
        made = Bench(graph, graph.create_node("robot"), server.url)
        yield made
        made.close()


@pytest.fixture
def studio_of(gazelle: Any) -> Callable[[Any], str]:
    """Starts ``gazelle studio`` on the graph of something launched; returns the page's URL."""

    def start(launched: Any) -> str:
        words = ("studio", "--port", "0", "--no-browser")
        line = gazelle(*words, port=launched.port).wait_for_line("Studio: ")
        return str(line.split("Studio: ")[1].strip())

    return start
