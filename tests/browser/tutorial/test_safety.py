"""Who gets in, what is asked for, what the keyboard reaches, what a slow or lonely page does."""

from __future__ import annotations

import http.client
import itertools
import re
import signal
import threading
from collections.abc import Callable, Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from tests.browser.tutorial.terminal import Session, open_panel
from tests.patience import stretched

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

_FOREIGN_PAGE = "<!doctype html><title>elsewhere</title><p>A page of somebody else."
_SLOWER = 20


@pytest.fixture
def elsewhere(tmp_path: Path) -> Iterator[str]:
    """The address of a page of another origin."""
    (tmp_path / "web").mkdir()
    (tmp_path / "web" / "index.html").write_text(_FOREIGN_PAGE)
    handler = partial(_Quiet, directory=str(tmp_path / "web"))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()


class _Quiet(SimpleHTTPRequestHandler):
    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing."""


def test_page_of_another_site_gets_neither_socket_nor_files(
    bench: Any, browser: Any, elsewhere: str
) -> None:
    page = browser.new_page()
    page.goto(elsewhere)
    socket = bench.url.replace("http", "ws").replace("/?", "/ws?")
    opened = page.evaluate(
        """url => new Promise(done => {
          const socket = new WebSocket(url);
          socket.onopen = () => done('open');
          socket.onerror = () => done('refused');
        })""",
        socket,
    )
    assert opened == "refused"
    read = "url => fetch(url).then(answer => answer.text(), () => 'refused')"
    assert page.evaluate(read, bench.url) == "refused"
    page.set_content(f"<iframe src='{bench.url}'></iframe>")
    page.frames[1].wait_for_load_state()
    assert page.frames[1].locator("#dock").count() == 0
    page.close()


@pytest.mark.parametrize(
    ("path", "headers", "status"),
    [
        ("/", {"Host": "robot.example"}, 403),
        ("/", {"Origin": "http://robot.example"}, 403),
        ("/ws", {"Host": "robot.example:80"}, 403),
        ("/assets/../../server.py", {}, 404),
        ("/assets/%2e%2e/%2e%2e/server.py", {}, 404),
        ("/mesh/../../../etc/passwd", {}, 404),
        ("//etc/passwd", {}, 404),
    ],
)
def test_strangers_and_paths_outside_are_refused(
    bench: Any, path: str, headers: dict[str, str], status: int
) -> None:
    address = urlsplit(bench.url)
    asking = http.client.HTTPConnection(
        address.hostname or "", address.port or 0, timeout=stretched()
    )
    token = parse_qs(address.query)["token"][0]
    known = {"Cookie": f"gazelle_studio_{address.port}={token}"}
    asking.request("GET", path, headers={**known, **headers})
    assert asking.getresponse().status == status
    asking.close()


def test_page_works_without_a_network_and_asks_nobody_else(bench: Any, browser: Any) -> None:
    # No name is resolved, and what is not this machine goes to a proxy that is not there.
    alone = browser.browser_type.launch(
        executable_path=_program(),
        args=[
            "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
            "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
            "--proxy-server=http://127.0.0.1:9", "--proxy-bypass-list=127.0.0.1",
        ],
    )  # fmt: skip
    page = alone.new_page()
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    bench.keep_publishing("/count", "std_msgs/msg/Float64", lambda t: {"data": t})
    page.goto(f"{bench.url}&panels=rviz,rqt_plot,rqt_graph")
    page.locator("[data-panel=rviz] canvas").first.wait_for(timeout=stretched() * 1000)
    page.get_by_label("Topic field").fill("/count/data")
    page.keyboard.press("Enter")
    value = page.locator("[data-panel=rqt_plot]").get_by_role("listitem").locator("output")
    bench.eventually(lambda: re.fullmatch(r"[\d.]+", value.inner_text()))
    foreign = [
        url for url in asked if not url.startswith((bench.url.partition("?")[0], "blob:", "data:"))
    ]
    assert foreign == []
    assert len(asked) > 5
    alone.close()


def test_every_control_is_reached_with_tab_or_arrows(bench: Any, look: Any) -> None:
    bench.keep_publishing("/count", "std_msgs/msg/Float64", lambda t: {"data": t})
    seen = look(bench.url, "rqt_topic", "rqt_publisher", "rqt_plot", "rqt_console")
    seen.panel("rqt_topic").get_by_label("Subscribe /count", exact=True).wait_for()
    controls = seen.page.evaluate(_NUMBER_CONTROLS)
    assert controls > 15
    seen.page.evaluate("document.activeElement?.blur()")
    reached: set[str] = set()
    for _ in range(controls + 10):
        seen.page.keyboard.press("Tab")
        reached.add(seen.page.evaluate("document.activeElement.dataset.number ?? ''"))
    missed = seen.page.evaluate(_MISSED, sorted(reached))
    assert missed == []


def test_enter_and_space_press_what_has_the_focus(bench: Any, look: Any) -> None:
    seen = look(bench.url, "rqt_plot")
    theme = "document.documentElement.dataset.theme"
    before = seen.page.evaluate(theme)
    seen.page.get_by_role("button", name="Light or dark").focus()
    seen.page.keyboard.press("Enter")
    assert seen.page.evaluate(theme) != before
    pause = seen.panel("rqt_plot").get_by_role("button", name="Pause")
    pause.focus()
    seen.page.keyboard.press("Space")
    assert pause.get_attribute("aria-pressed") == "true"
    seen.page.get_by_role("button", name="Panels", exact=True).focus()
    seen.page.keyboard.press("Enter")
    seen.page.get_by_role("menu", name="Panels").wait_for()
    seen.page.keyboard.press("Escape")


def test_another_command_takes_the_page_over_when_its_server_is_killed(
    session: Callable[..., Session], look: Any
) -> None:
    begun = session("roscore")
    begun.first.wait_for_line("setting /run_id to")
    server = begun.opens("rqt_topic", "rqt_topic")
    begun.opens("rqt_graph", "rqt_graph")
    counts = begun.first.node.create_publisher("/count", "std_msgs/msg/Float64")
    seen = look(begun.url)
    seen.expect_problem("WebSocket connection to|ERR_CONNECTION_REFUSED|Failed to load resource")
    seen.page.evaluate("window.same = true")
    tick = seen.page.get_by_label("Subscribe /count", exact=True)
    tick.check()
    said = _talk(begun, counts)
    value = seen.panel("rqt_topic").locator("[data-path='/count/data']")
    begun.eventually(lambda: said() and value.count() and value.inner_text())
    seen.page.evaluate(_WATCH_LIGHT)
    assert server.stop(signal.SIGKILL) == -signal.SIGKILL
    seen.page.wait_for_function("window.lights.length > 0")
    seen.page.locator(".light[data-state=open]").wait_for()
    last = value.inner_text()
    begun.eventually(lambda: said() and value.inner_text() != last)
    assert seen.page.evaluate("window.same")


def _talk(begun: Session, publisher: Any) -> Callable[[], bool]:
    """Returns what publishes the next number, and is true."""
    from gazelle.interfaces import message_type

    numbers = itertools.count()
    kind: Any = message_type("std_msgs/msg/Float64")

    def say() -> bool:
        publisher.publish(kind(data=float(next(numbers))))
        return True

    return say


def test_slow_browser_slows_no_simulation(session: Callable[..., Session], look: Any) -> None:
    begun = session("roslaunch gazebo_ros empty_world.launch")
    begun.shows(begun.first, "gazebo")
    clock: list[float] = []
    begun.first.messages({"/clock": 1})
    begun.first.node.create_subscription(
        "/clock", "rosgraph_msgs/msg/Clock", lambda one: clock.append(_seconds(one.clock))
    )
    seen = look(begun.url)
    open_panel(seen, "Topic Monitor")
    seen.page.get_by_label("Subscribe /clock", exact=True).check()
    quick = _advance(seen, clock)
    slow = seen.page.context.new_cdp_session(seen.page)
    slow.send("Emulation.setCPUThrottlingRate", {"rate": _SLOWER})
    assert _advance(seen, clock) > 0.8 * quick
    slow.send("Emulation.setCPUThrottlingRate", {"rate": 1})


def _advance(seen: Any, clock: list[float]) -> float:
    """How far simulated time goes in two seconds."""
    seen.page.wait_for_timeout(500)
    begin = clock[-1]
    seen.page.wait_for_timeout(2000)
    return clock[-1] - begin


def _seconds(stamp: Any) -> float:
    return float(stamp.sec) + float(stamp.nanosec) * 1e-9


def _program() -> str:
    import shutil

    names = ("chromium", "chromium-browser", "google-chrome")
    return next(filter(None, map(shutil.which, names)))


_CONTROLS = 'button, input, select, textarea, a[href], [tabindex="0"], [role=tab]'
# Keeps what the connection's light shows, however briefly.
_WATCH_LIGHT = """() => {
  window.lights = [];
  const light = document.querySelector('.light');
  const note = () => window.lights.push(light.dataset.state);
  new MutationObserver(note).observe(light, {attributes: true});
}"""
# Numbers everything that can be seen, used and clicked; tells how much that is.
_NUMBER_CONTROLS = f"""() => {{
  const usable = e => e.checkVisibility({{visibilityProperty: true}}) && !e.disabled;
  const found = [...document.querySelectorAll('{_CONTROLS}')].filter(usable);
  found.forEach((e, i) => e.dataset.number = String(i + 1));
  return found.length;
}}"""
# Of one composite widget only one part is a stop of Tab; arrows go to the others.
_MISSED = """reached => {
  const kinds = ['tree', 'listbox', 'tablist', 'grid', 'table', 'menu', 'toolbar', 'radiogroup'];
  const composite = kinds.map(kind => `[role=${kind}]`).join();
  return [...document.querySelectorAll('[data-number]')]
    .filter(e => !reached.includes(e.dataset.number))
    .filter(e => !(e.tabIndex < 0 && e.closest(composite)))
    .map(e => e.outerHTML.slice(0, 160));
}"""
