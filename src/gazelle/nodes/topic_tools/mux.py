"""``mux`` and ``demux`` of topic_tools: one of several topics is let through at a time."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Any

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.errors import GraphError, LaunchError
from gazelle.graph import Graph, Node, Publisher, Subscription
from gazelle.interfaces import message_type, service_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import node_reader, private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable, refused

__all__ = ["PARAMETERS", "run_demux", "run_mux"]

PARAMETERS = ParameterTable(
    "mux and demux",
    "One of several topics is let through at a time.",
    ("topic_tools/mux", "topic_tools/demux"),
    (
        Parameter("initial_topic", "text", "", "the one at the start; the first one when empty"),
        *refused("topics are listened to all the time", "lazy", unless=False),
        Parameter("input_topics", "texts", (), "mux, without words: what is chosen of",
                  ros_versions=(2,)),
        Parameter("output_topic", "text", "", "mux, without words: where it comes out",
                  ros_versions=(2,)),
    ),
)  # fmt: skip

_NONE = "__none"
_STRING = "std_msgs/msg/String"


def run_mux(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish what comes on the selected of several topics: ``mux OUT IN1 [IN2 …]``."""
    argv = list(arguments.rest) or _by_parameters(arguments)
    target, *sources = _checked(argv, "mux OUT_TOPIC IN_TOPIC1 [IN_TOPIC2 [...]]")
    node = start_node(arguments, graph)
    with private_parameters(node, arguments, PARAMETERS) as own:
        first = own.text("initial_topic")
    choice = _Choice(node, "mux", sources, first)
    output = _Output(node)
    inputs: dict[str, Subscription] = {}

    def passer(topic: str) -> Callable[[Any], None]:
        def take(message: Any) -> None:
            if choice.selected == topic:
                output.publish(target, message)

        return take

    def follow(topics: Sequence[str]) -> None:
        for topic in set(topics) - set(inputs):
            inputs[topic] = node.create_subscription(topic, None, passer(topic))
        for topic in set(inputs) - set(topics):
            inputs.pop(topic).unregister()

    return _serve(choice, follow, "Mux", stop)


def run_demux(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish a topic as the selected of several: ``demux IN OUT1 [OUT2 …]``."""
    source, *targets = _checked(
        list(arguments.rest), "demux IN_TOPIC OUT_TOPIC1 [OUT_TOPIC2 [...]]"
    )
    node = start_node(arguments, graph)
    with private_parameters(node, arguments, PARAMETERS) as own:
        first = own.text("initial_topic")
    choice = _Choice(node, "demux", targets, first)
    output = _Output(node)

    def take(message: Any) -> None:
        if choice.selected != _NONE:
            output.publish(choice.selected, message)

    node.create_subscription(source, None, take)
    return _serve(choice, lambda topics: None, "Demux", stop)


class _Output:
    """Publishers of topics whose type is known with the first message."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._made: dict[tuple[str, type], Publisher] = {}

    def publish(self, topic: str, message: Any) -> None:
        key = topic, type(message)
        if key not in self._made:
            self._made[key] = self._node.create_publisher(topic, type(message))
        self._made[key].publish(message)


class _Choice:
    """Which of some topics is selected; told on ``NAME/selected``."""

    def __init__(self, node: Node, name: str, argv: Sequence[str], first: str) -> None:
        self.node = node
        self.name = name
        self.topics = list(dict.fromkeys(node.resolve_name(word) for word in argv))
        self._publisher = node.create_publisher(f"{name}/selected", _STRING, latch=True)
        self.selected = _NONE
        self.select(first or self.topics[0])

    def select(self, word: str) -> str:
        """Select a topic or none of them; return which one was selected before.

        Raises:
            GraphError: it is not among them.
        """
        wanted = word if word == _NONE else self._known(word)
        before, self.selected = self.selected, wanted
        self._publisher.publish(message_type(_STRING)(data=wanted))
        return before

    def add(self, word: str) -> None:
        topic = self.node.resolve_name(word)
        if topic in self.topics:
            raise GraphError(f"{self.name}: topic [{topic}] is among its topics already")
        self.topics.append(topic)

    def delete(self, word: str) -> None:
        topic = self._known(word)
        if topic == self.selected:
            raise GraphError(f"{self.name}: topic [{topic}] is selected; select another one first")
        self.topics.remove(topic)

    def _known(self, word: str) -> str:
        topic = self.node.resolve_name(word)
        if topic not in self.topics:
            hint = did_you_mean(topic, self.topics) or f"topics: {', '.join(self.topics)}"
            raise GraphError(f"{self.name}: no topic [{topic}]; {hint}")
        return topic


def _serve(
    choice: _Choice, follow: Callable[[Sequence[str]], None], prefix: str, stop: threading.Event
) -> int:
    """Answer ``NAME/select``, ``add``, ``delete`` and ``list`` until told to stop."""
    lock = threading.RLock()

    def offer(name: str, action: Callable[[Any, Any], None]) -> None:
        kind = service_type(f"topic_tools/srv/{prefix}{name.capitalize()}")

        def answer(request: Any) -> Any:
            response = kind.Response()
            with lock:
                action(request, response)
                follow(choice.topics)
            return response

        choice.node.create_service(f"{choice.name}/{name}", kind, answer)

    def select(request: Any, response: Any) -> None:
        response.prev_topic = choice.select(request.topic)

    def show(_request: Any, response: Any) -> None:
        response.topics = list(choice.topics)

    follow(choice.topics)
    offer("select", select)
    offer("add", lambda request, _response: choice.add(request.topic))
    offer("delete", lambda request, _response: choice.delete(request.topic))
    offer("list", show)
    stop.wait()
    choice.node.shutdown()
    return 0


def _by_parameters(arguments: NodeArguments) -> list[str]:
    """Return what stands for the words of mux in a component."""
    unheard, version = Diagnostics(), arguments.ros_version
    own = node_reader(PARAMETERS, arguments.params, arguments.name, unheard, ros_version=version)
    output = [own.text("output_topic")] if own.has("output_topic") else []
    return [*output, *own.texts("input_topics")] if output and own.has("input_topics") else []


def _checked(argv: list[str], usage: str) -> list[str]:
    if len(argv) < 2:
        raise LaunchError(f"{len(argv)} arguments given\nusage: {usage}")
    return argv
