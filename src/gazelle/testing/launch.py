"""A launch file that runs for a test, and the test's side of its graph."""

from __future__ import annotations

import contextlib
import re
import signal
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from gazelle.graph import Entity, Graph, Kind, Node, Publisher, ServiceClient
from gazelle.graph.isolated_graph import open_graph
from gazelle.graph.key_expressions import ANY_TYPE
from gazelle.interfaces import fill, service_type
from gazelle.interfaces.stamps import seconds_of
from gazelle.testing.messages import Messages, Waiting, existing
from gazelle.testing.process_tree import ProcessTree, launch_environment

__all__ = ["Launch", "launched", "running"]

_TIMEOUT_S = 60.0
_CLOCK = "/clock"
_running: list[Launch] = []


class Launch:
    """A launch that runs: what it writes, and the topics, services and parameters of its graph.

    Every wait fails with an `AssertionError` that says what was missing and what is there
    instead, when the time is up and at once when the launch has ended. Messages have the form of
    ROS 2 (``header.stamp.sec``), whichever ROS the nodes are written for.

    Attributes:
        graph: the graph; the test may add nodes of its own.
        node: the test's node.
    """

    def __init__(self, tree: ProcessTree, graph: Graph, waiting: Waiting) -> None:
        """Watch a launch; use `launched` or the fixture ``gazelle_launch``."""
        self.graph = graph
        self.node: Node = graph.create_node("gazelle_test", anonymous=True, rosout=False)
        self._tree = tree
        self._waiting = waiting
        self._publishers: dict[tuple[str, str], Publisher] = {}
        self._clock: Any = None
        graph.discovery.listen(waiting.wake)
        graph.parameters.on_change(waiting.wake)

    @property
    def title(self) -> str:
        """The command, for people."""
        return self._tree.title

    @property
    def output(self) -> str:
        """Everything written so far."""
        return "\n".join(self._tree.lines)

    @property
    def exit_code(self) -> int | None:
        """The exit code, None while it runs."""
        return self._tree.exit_code

    @property
    def sim_time_s(self) -> float:
        """The time on ``/clock`` in seconds, 0 before there is one."""
        if self._clock is None:
            self._clock = _ClockReading(self.node, self._waiting)
        return float(self._clock.time_s)

    def wait_for_line(self, pattern: str, timeout_s: float | None = None) -> str:
        """Return the first line of the output that a regular expression finds something in."""

        def found() -> str:
            lines = tuple(self._tree.lines)
            return next((line for line in lines if re.search(pattern, line)), "")

        return self._waiting.until(found, f"line matches {pattern!r}", timeout_s)

    def wait_until(self, sim_time_s: float, timeout_s: float | None = None) -> None:
        """Wait until so many seconds are simulated.

        Args:
            sim_time_s: time on ``/clock``, in seconds.
            timeout_s: patience in seconds of real time.
        """
        self._waiting.until(
            lambda: self.sim_time_s >= sim_time_s,
            f"simulated time of {sim_time_s:g} s",
            timeout_s,
            hint=self._clock_hint,
        )

    def topic(
        self, name: str, type_name: str | None = None, timeout_s: float | None = None
    ) -> Messages:
        """Listen to a topic from now on.

        Args:
            name: the topic's name.
            type_name: such as ``nav_msgs/Odometry``; that of the graph when None, once it is
                known there.
            timeout_s: patience until the topic is there.
        """
        full = self.node.resolve_name(name)
        kind = type_name or self._type_of(full, timeout_s, Kind.PUBLISHER, Kind.SUBSCRIPTION)
        return Messages(self.node, full, kind, self._waiting, lambda: self._silence(full))

    def publish(self, topic: str, type_name: str | None = None, /, **fields: Any) -> None:
        """Publish a message as soon as a node listens.

        Args:
            topic: its name.
            type_name: such as ``geometry_msgs/Twist``; that of those who listen when None.
            fields: of the message; mappings for what is nested, what is left out is 0.
        """
        full = self.node.resolve_name(topic)
        kind = type_name or self._type_of(full, None, Kind.SUBSCRIPTION)
        publisher = self._publishers.get((full, kind))
        if publisher is None:
            publisher = self.node.create_publisher(full, kind)
            self._publishers[full, kind] = publisher
        message = publisher.message_class()
        fill(message, fields)
        self._waiting.until(
            lambda: self._listens(full, publisher.entity.type_name),
            f"node listens to '{full}' [{kind}]",
            None,
            hint=lambda: self._other_types(full, Kind.SUBSCRIPTION),
        )
        publisher.publish(message)

    def call(self, service: str, type_name: str | None = None, /, **fields: Any) -> Any:
        """Call a service, as soon as it is there, and return its response.

        Args:
            service: its name.
            type_name: such as ``std_srvs/Empty``; that of the graph when None.
            fields: of the request; mappings for what is nested, what is left out is 0.

        Raises:
            GraphError: it does not answer, or with an error.
        """
        full = self.node.resolve_name(service)
        kind = service_type(type_name or self._type_of(full, None, Kind.SERVICE))
        client: ServiceClient = self.node.create_client(full, kind)
        request = kind.Request()
        fill(request, fields)
        try:
            return client.call(request, timeout_s=self._waiting.timeout_s)
        finally:
            client.unregister()

    def param(self, name: str, timeout_s: float | None = None) -> Any:
        """Return the value of a parameter, as soon as it is set."""
        full, store = self.node.resolve_name(name), self.graph.parameters
        self._waiting.until(
            lambda: store.has(full),
            f"parameter '{full}'",
            timeout_s,
            hint=lambda: existing("parameters", full, store.names()),
        )
        return store.get(full)

    def nodes(self) -> tuple[str, ...]:
        """Return the names of all nodes but the test's, sorted."""
        return tuple(name for name in self.graph.node_names() if name != self.node.name)

    def wait_for_node(self, name: str, timeout_s: float | None = None) -> None:
        """Wait until a node is there."""
        full = self.node.resolve_name(name)
        self._waiting.until(
            lambda: full in self.nodes(),
            f"node '{full}'",
            timeout_s,
            hint=lambda: existing("nodes", full, self.nodes()),
        )

    def wait(self, timeout_s: float | None = None) -> int:
        """Wait for the launch's own end and return its exit code."""
        patience_s = self._waiting.timeout_s if timeout_s is None else timeout_s
        code = self._tree.wait(patience_s)
        if code is None:
            raise AssertionError(
                f"the launch has not ended within {patience_s:g} s; nodes still there: "
                f"{', '.join(self.nodes()) or 'none'}"
            )
        return code

    def stop(self, number: int = signal.SIGINT) -> int:
        """End it as Ctrl-C does, or with another signal; return the exit code."""
        return self._tree.stop(number)

    def close(self) -> None:
        """End all processes and leave the graph to its owner."""
        try:
            if self.exit_code is None:
                self.stop()
        finally:
            self.graph.discovery.ignore(self._waiting.wake)
            self.node.shutdown()

    def _known(self, *kinds: Kind) -> list[Entity]:
        known = self.graph.discovery.known()
        return [one for one in known if one.kind in kinds and one.node != self.node.name]

    def _ends(self, name: str, *kinds: Kind) -> list[Entity]:
        return [one for one in self._known(*kinds) if one.name == name]

    def _listens(self, topic: str, type_name: str) -> bool:
        types = {one.type_name for one in self._ends(topic, Kind.SUBSCRIPTION)}
        return bool(types & {type_name, ANY_TYPE})

    def _type_of(self, name: str, timeout_s: float | None, *kinds: Kind) -> str:
        def found() -> str:
            types = [one.type_name for one in self._ends(name, *kinds)]
            return next((kind for kind in types if kind != ANY_TYPE), "")

        noun = "service" if Kind.SERVICE in kinds else "topic"
        who = "node listens to" if kinds == (Kind.SUBSCRIPTION,) else noun
        return self._waiting.until(
            found,
            f"{who} '{name}'",
            timeout_s,
            hint=lambda: existing(f"{noun}s", name, (one.name for one in self._known(*kinds))),
        )

    def _silence(self, topic: str) -> str:
        """Say why no message comes."""
        if not self._ends(topic, Kind.PUBLISHER):
            names = (one.name for one in self._known(Kind.PUBLISHER))
            return f"nobody publishes it; {existing('topics', topic, names)}"
        nodes = {one.node for one in self._ends(topic, Kind.PUBLISHER)}
        return f"published by {', '.join(sorted(nodes))}, with nothing sent"

    def _other_types(self, topic: str, kind: Kind) -> str:
        ends = self._ends(topic, kind)
        if ends:
            return "; ".join(sorted(f"{one.node} takes {one.type_name}" for one in ends))
        return existing("topics", topic, (one.name for one in self._known(kind)))

    def _clock_hint(self) -> str:
        if not self._ends(_CLOCK, Kind.PUBLISHER):
            return "nobody publishes /clock: the launch has no simulator (yet)"
        return f"it is {self.sim_time_s:g} s"


class _ClockReading:
    """The last time on ``/clock``."""

    def __init__(self, node: Node, waiting: Waiting) -> None:
        self.time_s = 0.0
        self._waiting = waiting
        node.create_subscription(_CLOCK, "rosgraph_msgs/msg/Clock", self._take, queue_size=1)

    def _take(self, message: Any) -> None:
        self.time_s = seconds_of(message.clock)
        self._waiting.wake()


@contextlib.contextmanager
def launched(  # noqa: PLR0913 - users give all by keyword
    *words: str,
    args: Mapping[str, object] | None = None,
    lockstep: bool = False,
    fast: bool = False,
    seed: int = 0,
    env: Mapping[str, str] | None = None,
    cwd: Path | None = None,
    home: Path | None = None,
    graph: Graph | None = None,
    timeout_s: float = _TIMEOUT_S,
) -> Iterator[Launch]:
    """Run a launch for the time of a ``with`` block; all its processes end with it.

    Args:
        words: as ``roslaunch`` takes them: a package and a file, or the file's path, then options.
        args: the launch file's arguments; ``True`` and ``False`` become ``true`` and ``false``.
        lockstep: time waits for the nodes' subscriptions, so runs repeat.
        fast: simulate as fast as possible.
        seed: of all noise.
        env: more environment variables.
        cwd: where it runs, and whose workspace counts; the current folder when None.
        home: ``ROS_HOME``; a temporary folder when None.
        graph: the graph to run on; one of its own when None.
        timeout_s: patience of all waits, in seconds.
    """
    options = [word for word, given in (("--lockstep", lockstep), ("--fast", fast)) if given]
    options += ["--seed", str(seed)] if seed else []
    given = [f"{name}:={_argument(value)}" for name, value in (args or {}).items()]
    with contextlib.ExitStack() as stack:
        if graph is None:
            graph = stack.enter_context(open_graph())
        if home is None:
            folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
            home = Path(stack.enter_context(folder))
        waiting = Waiting(timeout_s)
        tree = ProcessTree(
            ["roslaunch", *options, *words, *given],
            cwd=cwd or Path.cwd(),
            environment=launch_environment(graph.port, home, env or {}),
            on_change=waiting.wake,
        )
        waiting.ended = tree.ended
        launch = Launch(tree, graph, waiting)
        stack.callback(launch.close)
        _running.append(launch)
        stack.callback(_running.remove, launch)
        yield launch


def running() -> tuple[Launch, ...]:
    """Return the launches of this process that have not been closed, for reports."""
    return tuple(_running)


def _argument(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
