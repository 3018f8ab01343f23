"""``gz topic``: the graph's topics with Gazebo's options and layout.

Those of Gazebo Classic's own transport have its names, types and texts.
"""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from gazelle.cli.gz.options import GzCommand, GzError, GzOption, seconds
from gazelle.cli.gz.protobuf_text import protobuf_text
from gazelle.cli.gz.world_link import WorldLink, world_link
from gazelle.cli.node_processes import Processes
from gazelle.cli.ros_types import topic_class
from gazelle.cli.rostopic.bw import BandwidthMeter
from gazelle.cli.rostopic.hz import RateMeter
from gazelle.diagnostics import did_you_mean
from gazelle.graph import RawMessage, TopicInfo
from gazelle.graph.gazebo_names import shown_transport_name

__all__ = [
    "COMMAND",
    "find_topic",
    "run",
]

_CONTACTS = "gazebo.msgs.Contacts"
COMMAND = GzCommand(
    "topic",
    "List all topics, or show what goes over one. Gazelle has the topics of ROS\n\tand of Gazebo's "
    "own those of contacts; ~/world_stats and its kin are not there.",
    (
        GzOption("world-name", "w", "World name; Gazelle has one world.", takes=True),
        GzOption("list", "l", "List all topics."),
        GzOption("info", "i", "Get information about a topic.", takes=True),
        GzOption("echo", "e", "Output topic data to screen.", takes=True),
        GzOption("hz", "z", "Get publish frequency.", takes=True),
        GzOption("bw", "b", "Get topic bandwidth.", takes=True),
        GzOption("duration", "d", "Duration (seconds) to run.", takes=True),
        GzOption("view", "v", "Not here; use gazelle view.", takes=True),
        GzOption("publish", "p", "Not here; use rostopic pub.", takes=True),
        GzOption("request", "r", "Not here; use rosservice call.", takes=True),
        GzOption("msg", "m", "Not here; use rostopic pub.", takes=True),
    ),
)
_ELSEWHERE = {
    "view": "the browser page of the simulator",
    "publish": "rostopic pub TOPIC TYPE VALUES, or ros2 topic pub",
    "msg": "rostopic pub TOPIC TYPE VALUES, or ros2 topic pub",
    "request": "rosservice call",
}
_PERIOD_S = 1.0
_FEW_BYTES = 1000.0


def _transport_topics(topics: Iterable[TopicInfo]) -> dict[str, TopicInfo]:
    """Return the topics of the transport by the names that Gazebo has for them."""
    named = ((shown_transport_name(one.name), one) for one in topics)
    return {name: one for name, one in named if name}


def _gazebo_name(topic: TopicInfo) -> str:
    """Return a topic's name as ``gz topic`` shows it."""
    return shown_transport_name(topic.name) or topic.name


def _gazebo_type(topic: TopicInfo) -> str:
    """Return a topic's type as ``gz topic -i`` shows it."""
    return _CONTACTS if shown_transport_name(topic.name) else topic.type_name


def _contacts_fields(message: Any, topic: str) -> dict[str, Any]:
    """Return contacts as the fields of ``gazebo.msgs.Contacts``; there are no ids here."""
    time = _time(message.header.stamp)
    world = topic.split("/")[2] if topic.startswith("/gazebo/") else ""
    found = [_contact(one, time, world) for one in message.contacts]
    return {"contact": found, "time": time}


def run(options: Mapping[str, str]) -> int:
    """List topics or show one.

    Raises:
        GzError: an option is not here, or the topic is unknown.
    """
    for name, instead in _ELSEWHERE.items():
        if name in options:
            raise GzError(f"gz topic --{name} is not here; use {instead}")
    ways: dict[str, Callable[[WorldLink, TopicInfo, float | None], None]] = {
        "info": _info,
        "echo": _echo,
        "hz": _hz,
        "bw": _bw,
    }
    way = next((name for name in ways if name in options), None)
    duration_s = seconds(options)
    if way is None and "list" not in options:
        raise GzError("nothing to do; see gz help topic")
    with world_link() as link:
        if way is None:
            print("\n".join(sorted(_listed(link))))
        else:
            ways[way](link, find_topic(link, options[way]), duration_s)
    return 0


def _message_fields(message: Any) -> Any:
    """Return a message as mappings and lists for `protobuf_text`."""
    if hasattr(message, "__slots__") and hasattr(message, "_type"):
        return {name: _message_fields(getattr(message, name)) for name in message.__slots__}
    if isinstance(message, (bytes, bytearray)):
        return list(message)
    if isinstance(message, (str, bool, int, float)):
        return message
    if hasattr(message, "secs"):
        return {"sec": int(message.secs), "nsec": int(message.nsecs)}
    items = message.tolist() if hasattr(message, "tolist") else message
    return [_message_fields(one) for one in items] if isinstance(items, (list, tuple)) else items


def find_topic(link: WorldLink, word: str) -> TopicInfo:
    """Return the topic of this name; Gazebo takes the end of a name too.

    Raises:
        GzError: no topic or several are meant.
    """
    known = link.graph.topics(include_hidden=True)
    topics = {_gazebo_name(one): one for one in known}
    word = word.removeprefix("~")
    ends = [name for name in topics if name.endswith("/" + word.strip("/"))]
    found = [word] if word in topics else ends
    if len(found) == 1:
        return topics[found[0]]
    if found:
        raise GzError(f"'{word}' means several topics: {', '.join(sorted(found))}")
    hint = did_you_mean(word, topics) or "gz topic -l names those there are"
    raise GzError(f"Unable to find topic[{word}]; {hint}")


def _contact(contact: Any, time: dict[str, int], world: str) -> dict[str, Any]:
    return {
        "collision1": contact.collision1.name,
        "collision2": contact.collision2.name,
        "position": [_vector(one) for one in contact.positions],
        "normal": [_vector(one) for one in contact.normals],
        "depth": [float(one) for one in contact.depths],
        "wrench": [
            {
                "body_1_name": one.body_1_name.data,
                "body_2_name": one.body_2_name.data,
                "body_1_wrench": _wrench(one.body_1_wrench),
                "body_2_wrench": _wrench(one.body_2_wrench),
            }
            for one in contact.wrenches
        ],
        "time": time,
        "world": world,
    }


def _wrench(wrench: Any) -> dict[str, Any]:
    return {"force": _vector(wrench.force), "torque": _vector(wrench.torque)}


def _vector(vector: Any) -> dict[str, float]:
    return {"x": float(vector.x), "y": float(vector.y), "z": float(vector.z)}


def _time(stamp: Any) -> dict[str, int]:
    seconds = getattr(stamp, "secs", None)
    if seconds is None:
        return {"sec": int(stamp.sec), "nsec": int(stamp.nanosec)}
    return {"sec": int(seconds), "nsec": int(stamp.nsecs)}


def _listed(link: WorldLink) -> list[str]:
    known = link.graph.topics(include_hidden=True)
    shown = [one.name for one in link.graph.topics()]
    return [*shown, *_transport_topics(known)]


def _info(link: WorldLink, topic: TopicInfo, _duration_s: float | None) -> None:
    processes = Processes(link.graph)
    print(f"Type: {_gazebo_type(topic)}\n")
    for title, names in (("Publishers", topic.publishers), ("Subscribers", topic.subscriptions)):
        print(f"{title}:")
        for node in names:
            print(f"\t{processes.uri(node)} {node}")
        print()


def _echo(link: WorldLink, topic: TopicInfo, duration_s: float | None) -> None:
    name = _gazebo_name(topic)
    is_own = name != topic.name

    def show(message: Any) -> None:
        fields = _contacts_fields(message, name) if is_own else _message_fields(message)
        print(protobuf_text(fields), flush=True)

    link.show_each(topic.name, topic_class(topic.type_name), show, duration_s)


def _hz(link: WorldLink, topic: TopicInfo, duration_s: float | None) -> None:
    meter = RateMeter()

    def report() -> None:
        rate = meter.read()
        if rate is not None:
            print(f"Hz: {rate.rate_hz:6.2f}", flush=True)

    _measure(link, topic, duration_s, lambda _size: meter.add(time.monotonic()), report)


def _bw(link: WorldLink, topic: TopicInfo, duration_s: float | None) -> None:
    meter = BandwidthMeter()

    def report() -> None:
        found = meter.read(time.monotonic())
        if found is None:
            return
        sizes = {
            "Total": f"{_bytes(found.bytes_per_s)}/s",
            "Mean": _bytes(found.mean),
            "Min": _bytes(found.least),
            "Max": _bytes(found.most),
            "Messages": str(found.window),
        }
        print(" ".join(f"{name}[{text}]" for name, text in sizes.items()), flush=True)

    _measure(link, topic, duration_s, lambda size: meter.add(time.monotonic(), size), report)


def _measure(
    link: WorldLink,
    topic: TopicInfo,
    duration_s: float | None,
    add: Callable[[int], None],
    report: Callable[[], None],
) -> None:
    def take(message: RawMessage) -> None:
        add(len(message.data))

    link.node.create_subscription(topic.name, None, take, raw=True, inline=True)
    end_s = float("inf") if duration_s is None else time.monotonic() + duration_s
    over = threading.Event()
    while not over.is_set():
        left_s = end_s - time.monotonic()
        if link.ended.wait(max(0.0, min(_PERIOD_S, left_s))) or time.monotonic() >= end_s:
            over.set()
        report()
    sys.stdout.flush()


def _bytes(count: float) -> str:
    for unit in ("B", "KB"):
        if count < _FEW_BYTES:
            return f"{count:6.2f} {unit}"
        count /= _FEW_BYTES
    return f"{count:6.2f} MB"
