"""``gz topic -t``: the graph's topics with the new Gazebo's options."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Mapping
from typing import Any

from gazelle.cli.gz import topic as classic
from gazelle.cli.gz.gz_sim.message_types import gz_type_of, message_of, ros_types_of, text_fields
from gazelle.cli.gz.options import GzCommand, GzError, GzOption, number, seconds
from gazelle.cli.gz.protobuf_text import protobuf_text, read_protobuf_text
from gazelle.cli.gz.world_link import WorldLink, world_link
from gazelle.cli.node_processes import Processes
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.graph import ANY_TYPE, TopicInfo
from gazelle.interfaces import message_type, to_plain

__all__ = ["COMMAND", "run"]

COMMAND = GzCommand(
    "topic",
    "Print information about topics, or send a message. Gazelle has the topics of\n\tROS, in the "
    "types that ros_gz_bridge pairs with Gazebo's.",
    (
        GzOption("topic", "t", "Name of a topic.", takes=True),
        GzOption("list", "l", "List all topics."),
        GzOption("info", "i", "Get info about a topic (-t)."),
        GzOption("echo", "e", "Output data of a topic (-t) to screen."),
        GzOption("json-output", "", "Output messages in JSON."),
        GzOption("frequency", "f", "Print the rate of a topic (-t)."),
        GzOption("pub", "p", "Publish a message, in protobuf's text format.", takes=True),
        GzOption("msgtype", "m", "Type of the message to publish.", takes=True),
        GzOption("duration", "d", "Duration (seconds) to run.", takes=True),
        GzOption("num", "n", "Number of messages to echo, then end.", takes=True),
    ),
)
_MATCH_S = 2.0
_PAUSE_S = 0.01
_LEAVE_S = 0.1


def run(options: Mapping[str, str]) -> int:
    """List topics, show one or publish.

    Raises:
        GzError: options do not go together, or the topic is unknown.
    """
    if "list" in options:
        return classic.run({"list": ""})
    ways = [name for name in ("info", "echo", "frequency", "pub") if name in options]
    name = options.get("topic", "")
    if not name:
        raise GzError("-t TOPIC names the topic; see gz help topic")
    if len(ways) != 1:
        raise GzError("one of -i, -e, -f and -p says what to do with the topic")
    if ways == ["frequency"]:
        return classic.run({"hz": name, **_only(options, "duration")})
    with world_link() as link:
        learn_workspace_types()
        if ways == ["pub"]:
            _publish(link, name, options)
        elif ways == ["info"]:
            _info(link, classic.find_topic(link, name))
        else:
            _echo(link, classic.find_topic(link, name), options)
    return 0


def _only(options: Mapping[str, str], *names: str) -> dict[str, str]:
    return {name: options[name] for name in names if name in options}


def _info(link: WorldLink, topic: TopicInfo) -> None:
    processes = Processes(link.graph)
    kind = gz_type_of(topic.type_name)
    for title, nodes in (("publishers", topic.publishers), ("subscribers", topic.subscriptions)):
        if not nodes:
            print(f"No {title} on topic [{topic.name}]")
            continue
        print(f"{title.capitalize()} [Address, Message Type]:")
        for node in nodes:
            print(f"  {processes.uri(node)} {node}, {kind}")


def _echo(link: WorldLink, topic: TopicInfo, options: Mapping[str, str]) -> None:
    left = int(number(options, "num"))
    counts = left > 0
    is_json = "json-output" in options

    def show(message: Any) -> None:
        nonlocal left
        plain = to_plain(message)
        print(json.dumps(plain) if is_json else protobuf_text(text_fields(plain)), flush=True)
        left -= 1
        if counts and left <= 0:
            link.ended.set()

    link.show_each(topic.name, message_type(topic.type_name), show, seconds(options))


def _publish(link: WorldLink, name: str, options: Mapping[str, str]) -> None:
    gz_type = options.get("msgtype", "")
    if not gz_type:
        raise GzError("-m TYPE names the type of the message, for example -m gz.msgs.Twist")
    wanted = ros_types_of(gz_type)
    fields = read_protobuf_text(options["pub"])
    topic = link.node.resolve_name(name)
    ros_type = _type_in_use(link, topic, gz_type, wanted)
    message = message_of(ros_type, fields)
    publisher = link.node.create_publisher(topic, message_type(ros_type))
    end_s = time.monotonic() + _MATCH_S
    while not publisher.matched and time.monotonic() < end_s:
        link.ended.wait(_PAUSE_S)
    if not publisher.matched:
        print(f"gazelle: nobody subscribes to {topic}", file=sys.stderr)
    publisher.publish(message)
    # Without it the message and our leaving race each other.
    link.ended.wait(_LEAVE_S)


def _type_in_use(link: WorldLink, topic: str, gz_type: str, wanted: tuple[str, ...]) -> str:
    known = {one.name: one.type_name for one in link.graph.topics(include_hidden=True)}
    used = known.get(topic, ANY_TYPE)
    if used in wanted or used == ANY_TYPE:
        return used if used in wanted else wanted[0]
    other = gz_type_of(used)
    kind = f"{other} ({used})" if other != used else f"{used}, for which there is ros2 topic pub"
    raise GzError(f"topic {topic} has type {kind}, not {gz_type}")
