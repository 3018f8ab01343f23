"""What comes over wires: of the graph, of ROS 1, of pages and of viewers."""

from __future__ import annotations

import asyncio
import io
import json
import os
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import closing
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast
from unittest.mock import patch

from tests.fuzzing.kind import Kind

from gazelle.bridge.foxglove.bridge import read_asset
from gazelle.bridge.foxglove.client_publishers import ClientPublishers
from gazelle.bridge.foxglove.parameters import Parameters, plain_value
from gazelle.bridge.ros1.master import Master
from gazelle.bridge.ros1.tcpros import read_frame, read_header, write_header
from gazelle.bridge.ros1.xmlrpc_call import read_answer
from gazelle.bridge.ros1.xmlrpc_server import serve_calls
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError, GraphError
from gazelle.graph.key_expressions import (
    Attachment,
    Entity,
    Qos,
    token,
    topic_key,
    type_in_key,
)
from gazelle.graph.key_expressions import (
    Kind as EntityKind,
)
from gazelle.graph.parameter_server import ParameterShare, ParameterStore
from gazelle.graph.parameter_tree import from_json, to_json
from gazelle.graph.process_queries import answer_in, read_query
from gazelle.interfaces import from_ros1, ros1_message_type, to_cdr, to_ros1
from gazelle.studio.connection import Connection
from gazelle.studio.studio import Studio
from gazelle.workspace import Workspace

__all__ = ["WIRES"]

_STORE = {"op": str, "name": str, "start": str, "revision": int}


class _Session:
    """A session of the transport that is alone."""

    def __getattr__(self, name: str) -> Callable[..., Any]:
        return lambda *_arguments, **_words: SimpleNamespace(undeclare=lambda: None)


def _payload(data: bytes) -> Any:
    return SimpleNamespace(payload=SimpleNamespace(to_bytes=lambda: data), ok=None)


def _store() -> ParameterStore:
    share = ParameterShare(cast(Any, _Session()))
    share.own()
    return ParameterStore(share, lambda name: name, "/")


def _request(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    """Ask the parameters' owner; each line is a request."""
    share = ParameterShare(cast(Any, _Session()))
    share.own()
    for line in path.read_bytes().splitlines():
        request = read_query(_payload(line), _STORE)
        answer_in(cast(Any, SimpleNamespace(ok=_payload(line))))
        try:
            from_json(to_json(share.ask(request)))
        except KeyError as error:
            raise GazelleError(f"{error} is not set") from None
    share.close()


def _tokens(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    for line in path.read_bytes().decode("utf-8", "replace").splitlines():
        entity = Entity.from_token(line)
        if entity is None:
            raise GazelleError(f"'{line}' is no token")
        token(0, entity)
        key = topic_key(0, entity.name, entity.type_name, entity.type_hash)
        type_in_key(key)


def _attachment(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    if not Attachment.from_bytes(path.read_bytes()).stamp_ns:
        raise GazelleError("no attachment")


class _Stream:
    """A connection over which everything has come, and has ended."""

    def __init__(self, data: bytes) -> None:
        self._data = io.BytesIO(data)
        self.answer = io.BytesIO()
        self.answer.close = lambda: None  # type: ignore[method-assign]

    def settimeout(self, _seconds: float) -> None:
        pass

    def setsockopt(self, *_arguments: Any) -> None:
        pass

    def makefile(self, mode: str, _size: int = -1) -> io.BytesIO:
        return self._data if mode == "rb" else self.answer

    def recv_into(self, view: memoryview) -> int:
        return self._data.readinto(view)


def _tcpros(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    data = path.read_bytes()
    stream = cast(Any, _Stream(data))
    try:
        write_header(read_header(stream))
        while True:
            from_ros1(ros1_message_type("std_msgs/String"), read_frame(stream))
    except ConnectionError as error:
        if data != _GOOD_TCPROS:
            raise GazelleError(str(error)) from None


class _DeafMaster(Master):
    """A master that calls nobody back."""

    def _later(self, uri: str, method: str, *arguments: Any) -> None:
        pass


def _http(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    _serve(path.read_bytes())


def _call(path: Path, diagnostics: Diagnostics, workspace: Workspace) -> None:
    body = path.read_bytes()
    _serve(_HEAD % len(body) + body)


def _serve(request: bytes) -> None:
    """Let a master answer; what its methods raise is told, as in the bridge."""
    told: list[str] = []
    master = _DeafMaster(_store(), lambda: None)
    stream = _Stream(request)
    serve_calls(cast(Any, stream), master.methods, frozenset({"localhost"}), told.append)
    answer = stream.answer.getvalue()
    master.close()
    faults = [text for text in told if not _is_reported(text)]
    if faults:
        raise RuntimeError(faults[0])
    if told or not answer.startswith(b"HTTP/1.1 200") or b"fault" in answer:
        raise GazelleError(told[0].partition("\n")[0] if told else "refused")


def _is_reported(text: str) -> bool:
    """Tell whether the last line of a traceback is of an error that is raised on purpose."""
    return "Error:" in text and text.rstrip().splitlines()[-1].startswith("gazelle.")


def _answer(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    read_answer(path.read_bytes(), "http://localhost:1/", "getPid")


class _Nobody:
    """A part of the graph where nobody is, besides what is named."""

    def __init__(self, **there: Any) -> None:
        self.__dict__.update(there)

    def __getattr__(self, name: str) -> Any:
        raise GraphError("nobody is there")


def _studio(folder: Path) -> Studio:
    """Return what a page talks to, without a graph."""
    clock = _Nobody(leave=lambda _node: None, follow=lambda _node: None)
    node = _Nobody(clock=clock, graph=_Nobody(), shutdown=lambda _reason: None)
    graph = _Nobody(create_node=lambda _name, **_options: node, port=0)
    studio = Studio(cast(Any, graph), folder)
    studio.pages = cast(
        Any, SimpleNamespace(hello=list, enter=lambda _page: None, leave=lambda _page: None)
    )
    studio.workers.close()
    studio.workers = cast(Any, SimpleNamespace(submit=lambda job: job()))
    return studio


class _Page:
    """A page's socket: says line after line, each when the one before is done with."""

    def __init__(self, lines: list[str]) -> None:
        self._lines = lines
        self.heard: list[dict[str, Any]] = []
        self.closed = ""

    async def __aiter__(self) -> AsyncIterator[str]:
        for line in self._lines:
            yield line
            # Besides the page itself and what writes to it.
            while len(asyncio.all_tasks()) > 2:
                await asyncio.sleep(0)
            for _ in range(3):
                await asyncio.sleep(0)
            if self.closed:
                return

    async def send(self, data: str | bytes) -> None:
        if isinstance(data, str):
            self.heard.append(json.loads(data))

    async def close(self, _code: int, text: str) -> None:
        self.closed = text


def _page(path: Path, _diagnostics: Diagnostics, _workspace: Workspace) -> None:
    page = _Page(path.read_bytes().decode("utf-8", "replace").splitlines())

    async def talk() -> None:
        with closing(_studio(path.parent)) as studio:
            await Connection(studio, cast(Any, page)).run()

    with patch.dict(os.environ, {"XDG_CONFIG_HOME": str(path.parent / "config")}):
        asyncio.run(talk())
    errors = [one["error"] for one in page.heard if "error" in one]
    for error in errors:
        if "fault of Studio" in error.get("hint", ""):
            raise RuntimeError(error["message"])
    wrong = [error["message"] for error in errors if "nobody is there" not in error["message"]]
    if page.closed or wrong:
        raise GazelleError(page.closed or wrong[0])


class _Voices:
    """A node that may create publishers, which say their messages to nobody."""

    def create_publisher(self, topic: str, message_class: Any) -> Any:
        return SimpleNamespace(
            topic=topic, message_class=message_class, subscription_count=0, matched=False,
            publish=to_cdr, unregister=lambda: None,
        )  # fmt: skip


def _viewer(path: Path, _diagnostics: Diagnostics, workspace: Workspace) -> None:
    """Do what a viewer of Foxglove asks for, as its server hands it over."""
    told: list[str] = []
    publishers = ClientPublishers(cast(Any, _Voices()), told.append)
    of_nodes = SimpleNamespace(knows=lambda _name: False, get=lambda _names: {})
    parameters = Parameters(_store(), cast(Any, of_nodes), told.append)
    for one in _asked(path.read_bytes()):
        match one.get("op"):
            case "advertise":
                words = [str(one.get(key)) for key in ("topic", "schemaName", "encoding")]
                publishers.advertise((1, _number(one)), *words)
            case "publish":
                data = one.get("data")
                text = data if isinstance(data, str) else json.dumps(data)
                publishers.publish((1, _number(one)), text.encode("utf-8", "replace"))
            case "unadvertise":
                publishers.unadvertise((1, _number(one)))
            case "getParameters":
                names = one.get("names")
                parameters.get(str(name) for name in (names if isinstance(names, list) else ()))
            case "setParameters":
                values = one.get("values")
                found = parameters.set(values if isinstance(values, dict) else {})
                {name: plain_value(value) for name, value in found.items()}
            case "fetchAsset":
                read_asset(workspace, str(one.get("uri")))
    publishers.close()
    if told:
        raise GazelleError(told[0])


def _asked(data: bytes) -> Iterator[dict[str, Any]]:
    for line in data.splitlines():
        try:
            one = json.loads(line)
        except (ValueError, RecursionError) as error:
            raise GazelleError(f"no JSON: {error}") from None
        if isinstance(one, dict):
            yield one


def _number(one: dict[str, Any]) -> int:
    number = one.get("id")
    return number if isinstance(number, int) else 0


def _lines(*items: Any) -> bytes:
    return b"".join(json.dumps(item).encode() + b"\n" for item in items)


def _good_requests() -> bytes:
    return b"\n".join(
        to_json(one)
        for one in (
            {"op": "set", "name": "/a/b", "value": {"c": [1, 2.5, "x", True], "d": b"\x00\x01"}},
            {"op": "get", "name": "/a"},
            {"op": "search", "name": "b", "start": "/a/node"},
            {"op": "has", "name": "/a/b/c"},
            {"op": "names"},
            {"op": "root", "revision": 3},
            {"op": "delete", "name": "/a/b/d"},
        )
    )


def _good_tokens() -> bytes:
    node = Entity("a1b2", 1, 1, EntityKind.NODE, "/robot/talker")
    qos = Qos(reliable=False, latched=True, depth=5, deadline_ns=1_500_000_000, lease_ns=10)
    publisher = Entity(
        "a1b2", 1, 2, EntityKind.PUBLISHER, "/robot/talker", "/robot/chatter",
        "std_msgs/msg/String", "RIHS01_00ff", qos,
    )  # fmt: skip
    return "\n".join(token(0, one) for one in (node, publisher)).encode()


def _good_attachment() -> bytes:
    return Attachment(7, 1_700_000_000_000_000_000, bytes(range(16))).to_bytes()


def _good_frames() -> bytes:
    header = write_header(
        {
            "callerid": "/talker", "topic": "/chatter", "type": "std_msgs/String",
            "md5sum": "992ce8a1687cec8c8bd883ec73ca41d1", "latching": "0",
        }
    )  # fmt: skip
    frames = [
        to_ros1(ros1_message_type("std_msgs/String")(data=text)) for text in ("hello", "", "é")
    ]
    return header + b"".join(len(one).to_bytes(4, "little") + one for one in frames)


_GOOD_TCPROS = _good_frames()
_HEAD = b"POST /RPC2 HTTP/1.1\r\nHost: localhost:11311\r\nContent-Type: text/xml\r\n\
Content-Length: %d\r\nConnection: close\r\n\r\n"
_VALUES = """<value><struct>
<member><name>a</name><value><int>1</int></value></member>
<member><name>b</name><value><double>2.5</double></value></member>
<member><name>c</name><value><array><data><value><boolean>1</boolean></value>
<value><base64>AAEC</base64></value><value>plain</value></data></array></value></member>
<member><name>d</name><value><dateTime.iso8601>20200102T03:04:05</dateTime.iso8601></value></member>
</struct></value>"""
_TEXTS = [
    ("setParam", ["/talker", "/robot", None]),
    ("getParam", ["/talker", "/robot/c"]),
    ("searchParam", ["/talker", "robot"]),
    ("subscribeParam", ["/talker", "http://localhost:1/", "/robot"]),
    ("registerPublisher", ["/talker", "/chatter", "std_msgs/String", "http://localhost:1/"]),
    ("registerSubscriber", ["/listener", "/chatter", "*", "http://localhost:2/"]),
    ("registerService", ["/talker", "/s", "rosrpc://localhost:3", "http://localhost:1/"]),
    ("lookupNode", ["/me", "/talker"]),
    ("getSystemState", ["/me"]),
    ("unregisterPublisher", ["/talker", "/chatter", "http://localhost:1/"]),
]


def _good_multicall() -> bytes:
    def value(one: Any) -> str:
        return _VALUES if one is None else f"<value><string>{one}</string></value>"

    calls = "".join(
        f"<value><struct><member><name>methodName</name><value>{name}</value></member>"
        "<member><name>params</name><value><array><data>"
        f"{''.join(map(value, params))}</data></array></value></member></struct></value>\n"
        for name, params in _TEXTS
    )
    return (
        "<?xml version='1.0'?>\n<methodCall><methodName>system.multicall</methodName><params>"
        f"<param><value><array><data>{calls}</data></array></value></param></params></methodCall>"
    ).encode()


def _good_call(place: int) -> bytes:
    name, params = _TEXTS[place]
    words = "".join(
        f"<param>{_VALUES if one is None else f'<value><string>{one}</string></value>'}</param>\n"
        for one in params
    )
    return (
        f"<?xml version='1.0'?>\n<methodCall><methodName>{name}</methodName>\n"
        f"<params>{words}</params></methodCall>"
    ).encode()


def _good_http() -> bytes:
    body = _good_call(1)
    return _HEAD % len(body) + body


def _good_answer() -> bytes:
    return (
        "<?xml version='1.0'?><methodResponse><params><param><value><array><data>"
        "<value><int>1</int></value><value><string>fine</string></value>"
        f"{_VALUES}</data></array></value></param></params></methodResponse>"
    ).encode()


_PAGE = _lines(
    {"op": "call", "id": 1, "method": "type.get", "params": {"type": "std_msgs/String"}},
    {"op": "call", "id": 2, "method": "rviz.open",
     "params": {"text": "Visualization Manager: {Displays: []}", "name": "a"}},
    {"op": "call", "id": 3, "method": "topic.publish", "params": {
        "topic": "/goal", "type": "geometry_msgs/Pose", "message": {"position": {"x": "1.5"}}}},
    {"op": "call", "id": 4, "method": "layout.save", "params": {"name": "a", "value": {"b": [1]}}},
    {"op": "call", "id": 5, "method": "layout.load", "params": {"name": "a"}},
    {"op": "call", "id": 6, "method": "file.save", "params": {"name": "a.txt", "base64": "aGk="}},
    {"op": "call", "id": 7, "method": "publisher.set", "params": {"id": "1", "topic": "/a",
     "type": "std_msgs/Float64", "rate_hz": 10, "expressions": {"data": "sin(t) * 2 ** i"}}},
    {"op": "call", "id": 8, "method": "world.set_pose", "params": {
        "model": "scout", "position": [1, 2, 0.5], "orientation": [0, 0, 0, 1]}},
    {"op": "call", "id": 9, "method": "world.wrench", "params": {
        "body": "scout::base", "force": [1.5, 0, 0], "seconds": 0.5}},
    {"op": "open", "ch": 1, "stream": "topic.echo", "params": {"topic": "/scan", "rate_hz": 5}},
    {"op": "open", "ch": 2, "stream": "display", "params": {"display": "rviz/LaserScan",
     "topic": "/scan", "fixed_frame": "map", "Point Budget": 100, "Color Transformer": "Axis"}},
    {"op": "open", "ch": 3, "stream": "image", "params": {"topic": "/camera", "quality": 50}},
    {"op": "open", "ch": 4, "stream": "topic.plot", "params": {"curves": ["/odom/pose/x[0]"]}},
    {"op": "change", "ch": 1, "params": {"rate_hz": 1}},
    {"op": "ack", "ch": 1},
    {"op": "close", "ch": 1},
)  # fmt: skip
_VIEWER = _lines(
    {"op": "advertise", "id": 1, "topic": "/goal", "schemaName": "geometry_msgs/msg/PoseStamped",
     "encoding": "json"},
    {"op": "publish", "id": 1, "data": {"header": {"frame_id": "map", "stamp": {"sec": 1}},
     "pose": {"position": {"x": 1.5, "y": -2}, "orientation": {"w": 1}}}},
    {"op": "advertise", "id": 2, "topic": "/text", "schemaName": "std_msgs/String",
     "encoding": "cdr"},
    {"op": "publish", "id": 2, "data": "\u0000\u0001\u0000\u0000\u0002\u0000\u0000\u0000a\u0000"},
    {"op": "setParameters", "values": {"/a/b": [1, 2.5], "/d": 1, "/c": "x", "/e": {"f": True}}},
    {"op": "setParameters", "values": {"/d": None}},
    {"op": "getParameters", "names": ["/a/b", "/c"]},
    {"op": "unadvertise", "id": 1},
    {"op": "fetchAsset", "uri": "package://scout_robot/meshes/none.stl"},
)  # fmt: skip

WIRES: dict[str, Kind] = {
    "foxglove": Kind(lambda: _VIEWER, "a.jsonl", _viewer),
    "graph_attachment": Kind(_good_attachment, "a.bin", _attachment),
    "graph_request": Kind(_good_requests, "a.jsonl", _request),
    "graph_token": Kind(_good_tokens, "a.txt", _tokens),
    "studio_page": Kind(lambda: _PAGE, "a.jsonl", _page),
    "tcpros": Kind(lambda: _GOOD_TCPROS, "a.bin", _tcpros),
    "xmlrpc_answer": Kind(_good_answer, "a.xml", _answer),
    "xmlrpc_call": Kind(partial(_good_call, 0), "a.xml", _call),
    "xmlrpc_http": Kind(_good_http, "a.http", _http),
    "xmlrpc_multicall": Kind(_good_multicall, "a.xml", _call),
}
