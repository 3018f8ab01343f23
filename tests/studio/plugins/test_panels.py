"""Panels of users through the server, as pages see them."""

from __future__ import annotations

import http.client
import os
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually, stretched
from tests.studio.page import Page, RefusedError, Stream

from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type, service_type
from gazelle.studio import Server, Studio
from gazelle.studio.plugins import running_panel, shown_panels

_HEAD = "from gazelle.studio.plugins import *\n\n\n"
Open = Callable[..., "Shown"]


class Shown:
    """A page that shows one panel."""

    def __init__(self, server: Server, name: str) -> None:
        self.page = Page(server.port)
        self.name = name
        self.stream: Stream = self.page.open("plugin", name=name)
        self._events: list[dict[str, Any]] = []

    def event(self, what: str, name: str = "") -> Any:
        """Return the value of the next event of a kind."""
        while True:
            for place, event in enumerate(self._events):
                if event["what"] == what and (not name or event["name"] == name):
                    del self._events[: place + 1]
                    return event["value"]
            self._events += self.stream.next()

    def problem(self) -> str:
        """Return the text of the next error."""
        while (error := self.event("error")) is None:
            pass
        return str(error["text"])

    def act(self, widget: str, value: Any = None) -> Any:
        return self.page.call("plugin.event", name=self.name, widget=widget, value=value)


@pytest.fixture
def server(graph: Graph) -> Iterator[Server]:
    """A server of the test's own: what it was told of panels goes with it."""
    with Server(Studio(graph), port=0) as made:
        yield made


@pytest.fixture
def show(server: Server, tmp_path: Path) -> Iterator[Open]:
    """Writes a panel's file, names it to the server and opens it on a page."""
    opened: list[Shown] = []

    def make(text: str = "", name: str = "mine.Mine") -> Shown:
        if text:
            (tmp_path / "mine.py").write_text(_HEAD + text)
            server.studio.shown_panels.name_file(str(tmp_path / "mine.py"))
        opened.append(Shown(server, name))
        return opened[-1]

    yield make
    for shown in opened:
        shown.page.close()


def test_a_slider_calls_its_method_which_publishes(show: Open, node: Node) -> None:
    got: list[Any] = []
    node.create_subscription("/limit", message_type("std_msgs/msg/Float64"), got.append)
    shown = show("""
class Mine(Panel):
    widgets = (Slider("speed", min=0.0, max=2.0),)

    def start(self, node):
        self.node = node

    def on_speed(self, value):
        self.node.publish("/limit", self.node.message("std_msgs/Float64", data=value))
""")
    state = shown.event("state")
    assert state["values"] == {"speed": 0.0}
    assert (state["layout"][0]["kind"], state["layout"][0]["max"]) == ("slider", 2.0)
    shown.act("speed", 1.25)
    assert shown.event("set", "speed") == 1.25
    eventually(lambda: [message.data for message in got] == [1.25])
    shown.act("speed", 7)
    eventually(lambda: got[-1].data == 2.0)
    assert shown.event("set", "speed") == 2.0


def test_topics_fill_labels_plots_and_tables_of_a_page_that_comes_later(
    show: Open, talk: Callable[..., Any]
) -> None:
    first = show("""
class Mine(Panel):
    widgets = (
        Column(Label("seen"), title="Odometry"),
        Plot("past", curves=("a", "b")),
        Table("rows", columns=("n", "v")),
    )

    def start(self, node):
        node.subscribe("/odo", "std_msgs/Float64", self.take)

    def take(self, message):
        self["seen"] = message.data
        self.add("past", message.data, 2, time_s=5)
        self["rows"] = {"x": message.data}
""")
    first.event("state")
    talk("/odo", "std_msgs/msg/Float64", data=0.5, latch=True)
    assert first.event("set", "seen") == 0.5
    assert first.event("add", "past") == [5.0, 0.5, 2.0]
    state = show().event("state")
    assert state["values"]["rows"] == [["x", 0.5]]
    assert state["points"] == {"past": [[5.0, 0.5, 2.0]]}
    assert state["layout"][0]["title"] == "Odometry"


def test_messages_are_imported_as_in_a_node(show: Open) -> None:
    shown = show("""
from geometry_msgs.msg import Twist


class Mine(Panel):
    widgets = (Label("x"),)

    def start(self, node):
        twist = Twist()
        twist.linear.x = 0.25
        self["x"] = twist.linear.x
""")
    assert shown.event("state")["values"] == {"x": 0.25}


def test_an_error_names_file_and_line_is_counted_and_the_panel_goes_on(
    show: Open, tmp_path: Path
) -> None:
    shown = show("""
class Mine(Panel):
    widgets = (Button("fail"), Button("go", on_press="work"), Label("done"))

    def on_fail(self):
        raise RuntimeError("no map")

    def work(self):
        self["done"] = "yes"
""")
    shown.act("fail")
    assert shown.problem() == f"{tmp_path / 'mine.py'}:9 in on_fail(): RuntimeError: no map"
    shown.act("fail")
    assert shown.event("error")["count"] == 2
    shown.act("go")
    assert shown.event("set", "done") == "yes"
    again = show()
    again.event("state")
    assert again.event("error")["count"] == 2


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ('widgets = (Slider("a", min=2, max=1),)', ":5 in Mine(): ValueError: widget 'a': min 2"),
        (
            'widgets = (Label("a"), Label("a"), "b")',
            ":4: TypeError: widgets of Mine: Label 'a': the name is empty or used twice; 'b' is no",
        ),
        (
            'widgets = (Button("go", on_press="wrok"),)\n\n    def work(self): ...',
            "'go' names the method 'wrok', which is not there; did you mean 'work'?",
        ),
        ('widgets = (Button("go"),)', "button 'go' does nothing; write a method on_go(self)"),
        (
            'widgets = (Label("seen"),)\n\n    def start(self, node):\n        self["sen"] = 1',
            ":8 in start(): LookupError: there is no widget 'sen'; did you mean 'seen'?",
        ),
        (
            'widgets = (Choice("gear", options=("low", "high")),)\n\n'
            '    def start(self, node):\n        self["gear"] = "lo"',
            "'gear' has no option 'lo'; its options: low, high",
        ),
        (
            'widgets = (Plot("p"),)\n\n    def start(self, node):\n        self["p"] = 1',
            ":8 in start(): TypeError: 'p' is a plot: use add('p', …)",
        ),
        (
            'widgets = (Image("i"),)\n\n    def start(self, node):\n        self["i"] = "map.png"',
            "str is no picture: an Image or CompressedImage message, an array of uint8",
        ),
        (
            'widgets = (Label("x"),)\n\n    def __init__(self):\n        self["x"] = 1',
            "RuntimeError: Mine: widgets have values from start() on, not in __init__()",
        ),
        (
            'widgets = (Label("x", text=object()),)',
            ":4: TypeError: widgets of Mine: Label 'x': only texts, numbers, booleans",
        ),
        (
            'widgets = (Number("n", value=7, max=5),)',
            "Number 'n': 'n' goes from -inf to 5; 7 is outside",
        ),
        (
            'widgets = (Label("x"),)\n\n    def start(self, node):\n        self.send(object())',
            ":8 in start(): TypeError: only texts, numbers, booleans",
        ),
        ('widgets = (Row([Label("x")]),)', "is no widget; write Row(a, b)"),
        ("import rospy", "; a panel is given its node in start(self, node) and imports none"),
        (
            'widgets = (Label("x"),)\n\n    def start(self, node):\n        raise SystemExit(3)',
            ":8 in start(): SystemExit: 3",
        ),
        ("import nothing_like_this", ":5 in Mine(): ModuleNotFoundError: No module named"),
    ],
)
def test_a_mistake_in_a_panel_is_shown_where_it_is(
    show: Open, body: str, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Other tests of this process may have had the drop-in modules on their path.
    monkeypatch.setattr(sys, "path", [one for one in sys.path if "compat" not in one])
    for name in [one for one in sys.modules if one.partition(".")[0] == "rospy"]:
        monkeypatch.delitem(sys.modules, name)
    shown = show(f"class Mine(Panel):\n    {body}\n")
    text = shown.problem()
    assert words in text
    assert "mine.py:" in text


def test_a_file_is_reloaded_and_says_that_it_changed(
    show: Open, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shown_panels, "_WATCH_S", 0.05)
    text = 'class Mine(Panel):\n    widgets = (Label("{}"),)\n\n    def stop(self): ...\n'
    shown = show(text.format("one"))
    assert list(shown.event("state")["values"]) == ["one"]
    file = tmp_path / "mine.py"
    file.write_text(_HEAD + text.format("two"))
    os.utime(file, ns=(1, file.stat().st_mtime_ns + 10**9))
    assert shown.event("changed") is True
    shown.page.call("plugin.reload", name="mine.Mine")
    assert list(shown.event("state")["values"]) == ["two"]
    file.write_text(_HEAD + "class Mine(Panel:\n")
    os.utime(file, ns=(1, file.stat().st_mtime_ns + 2 * 10**9))
    shown.page.call("plugin.reload", name="mine.Mine")
    assert f"{file}:4: SyntaxError: " in shown.problem()
    file.write_text(_HEAD + text.format("three"))
    shown.page.call("plugin.reload", name="mine.Mine")
    shown.event("state")


def test_a_panel_ends_some_time_after_its_last_page(
    show: Open, graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shown_panels, "_GRACE_S", 0.2)
    text = 'class Mine(Panel):\n    widgets = (Label("x"),)\n'
    text += "\n    def start(self, node):\n        self['x'] = node.name\n"
    one, other = show(text), show()
    name = one.event("state")["values"]["x"]
    assert name.startswith("/panel_mine_mine")
    one.page.close()
    assert other.event("state")["values"]["x"] == name
    assert name in {entity.node for entity in graph.entities()}
    other.page.close()
    eventually(lambda: name not in {entity.node for entity in graph.entities()})
    assert show().event("state")["values"]["x"] != name


def test_timers_services_and_parameters_work_and_end_with_the_panel(show: Open, node: Node) -> None:
    shown = show("""
class Mine(Panel):
    widgets = (Label("ticks", value=0), Label("asked"), Label("rate"))

    def start(self, node):
        self.node = node
        self.every(0.02, self.tick)
        node.service("/mine/ask", "std_srvs/SetBool", self.answer)
        node.set_param("/mine_rate", 20)
        self["rate"] = node.get_param("/mine_rate")

    def tick(self):
        self["ticks"] += 1

    def answer(self, request, response):
        self["asked"] = 1 / request.data
        response.success, response.message = True, "fine"
""")
    assert shown.event("state")["values"]["rate"] == 20
    assert shown.event("set", "ticks") > 0
    kind = service_type("std_srvs/SetBool")
    client = node.create_client("/mine/ask", kind)
    assert client.call(kind.Request(data=True), 5.0).message == "fine"
    with pytest.raises(Exception, match="the panel's handler of /mine/ask raised"):
        client.call(kind.Request(data=False), 5.0)
    assert "in answer(): ZeroDivisionError" in shown.problem()


def test_what_a_page_sends_is_checked(show: Open, server: Server) -> None:
    shown = show('class Mine(Panel):\n    widgets = (Slider("a", min=0, max=1), Label("seen"))\n')
    with pytest.raises(RefusedError, match="there is no widget 'b'"):
        shown.act("b", 1)
    with pytest.raises(RefusedError, match="'a' takes a number, not 'x'"):
        shown.act("a", "x")
    with pytest.raises(RefusedError, match="'seen' is a Label: nobody acts on it"):
        shown.act("seen", 1)
    with pytest.raises(RefusedError, match=r"there is no panel 'mine\.Mina'") as caught:
        show(name="mine.Mina")
    assert caught.value.error["known"] == ["mine.Mine"]
    with pytest.raises(RefusedError, match=r"the panel 'other\.Other' is not open"):
        shown.page.call("plugin.event", name="other.Other", widget="a", value=1)


def test_a_busy_panel_says_so(show: Open, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(running_panel, "_BUSY_S", 0.1)
    shown = show("""
import threading
free = threading.Event()


class Mine(Panel):
    widgets = (Button("think"), Button("go"))

    def on_think(self):
        free.wait()

    def on_go(self): ...
""")
    shown.event("state")
    thinking = threading.Thread(target=shown.act, args=("think",))
    thinking.start()

    def refused() -> str:
        try:
            shown.act("go")
        except RefusedError as error:
            return str(error)
        return ""

    text = eventually(refused)
    assert text == "the panel is busy: on_think has been running for 0 s"
    import sys

    module = next(sys.modules[name] for name in sys.modules if "gazelle_user_panels.mine" in name
                  and hasattr(sys.modules[name], "free"))  # fmt: skip
    module.free.set()
    thinking.join()
    shown.act("go")


def test_a_widget_is_changed_and_its_value_made_to_fit(show: Open) -> None:
    shown = show("""
class Mine(Panel):
    widgets = (
        Choice("gear", options=("low", "high"), value="high"),
        Slider("speed", min=0, max=10, value=8),
        Button("limit"),
        Button("wrong"),
    )

    def on_limit(self):
        self.change("speed", max=5, unit="m/s")
        self.change("gear", options=("park",))
        self.change("limit", enabled=False)

    def on_wrong(self):
        self.change("speed", maximum=2)
""")
    shown.act("limit")
    changed = shown.event("widget", "speed")
    assert (changed["max"], changed["unit"]) == (5, "m/s")
    assert shown.event("set", "speed") == 5.0
    assert shown.event("set", "gear") == "park"
    assert shown.event("widget", "limit")["enabled"] is False
    with pytest.raises(RefusedError, match="'limit' is not enabled now"):
        shown.act("limit")
    shown.act("wrong")
    assert "a Slider has no property 'maximum'" in shown.problem()


def test_a_picture_and_the_es_module_are_served_and_nothing_beside_them(
    show: Open, server: Server, tmp_path: Path
) -> None:
    (tmp_path / "draw.js").write_text("export function mount() {}\n")
    (tmp_path / "secret.txt").write_text("x")
    shown = show("""
import numpy as np


class Mine(Panel):
    module = "draw.js"
    widgets = (Image("map"),)

    def start(self, node):
        self["map"] = np.zeros((4, 6, 3), np.uint8)

    def on_message(self, value):
        self.send([value, "back"])
""")
    assert shown.stream.info["module"] == "/plugin/mine.Mine.js"
    assert shown.event("state")["values"] == {"map": 1}
    status, kind, body = _get(server, "/plugin/mine.Mine/map?v=1")
    assert (status, kind, body[:4]) == (200, "image/png", b"\x89PNG")
    status, kind, body = _get(server, "/plugin/mine.Mine.js")
    assert (status, body) == (200, b"export function mount() {}\n")
    assert kind.startswith("text/javascript")
    paths = ("mine.Mine/other", "other.js", "mine.Mine/../secret.txt", "secret.txt", "..%2fmine.py")
    assert {path: _get(server, f"/plugin/{path}")[0] for path in paths} == dict.fromkeys(paths, 404)
    shown.act("", {"a": 1})
    assert shown.event("message") == [{"a": 1}, "back"]


def test_a_module_outside_the_panels_folder_is_not_served(
    show: Open, server: Server, tmp_path: Path
) -> None:
    (tmp_path.parent / "outside.js").write_text("x")
    shown = show('class Mine(Panel):\n    module = "../outside.js"\n    widgets = (Label("a"),)\n')
    assert shown.stream.info["module"] is None
    assert _get(server, "/plugin/mine.Mine.js")[0] == 404


def _get(server: Server, path: str) -> tuple[int, str, bytes]:
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=stretched())
    try:
        cookie = f"gazelle_studio_{server.port}={server.token}"
        connection.request("GET", path, headers={"Cookie": cookie})
        answer = connection.getresponse()
        return answer.status, answer.headers["Content-Type"], answer.read()
    finally:
        connection.close()
