"""``tf_monitor [SOURCE TARGET]``: delays and rates of frames and their broadcasters."""

from __future__ import annotations

import sys
import threading
from dataclasses import dataclass, field
from typing import Any

from gazelle.cli.ros_tool import Tool, join_graph, run_tool
from gazelle.graph import Graph
from gazelle.graph.names import parse_command_line
from gazelle.graph.tf import TransformBuffer, TransformError, TransformListener

__all__ = ["Delays", "FrameDelays", "NetDelay", "main", "report"]

_LOWPASS = 0.01
_MIN_DURATION_S = 1e-8
_USAGE = """TF_Monitor: usage
 tf_monitor                  prints all frames
 tf_monitor frame1 frame2    prints the chain between two frames"""
_LOOK_S = 0.01
_LOOKS = 20
_ALL_S = 10.0
_WAIT_S = 0.2


@dataclass(slots=True)
class Delays:
    """Delays of one frame or one broadcaster, seconds."""

    total_s: float = 0.0
    largest_s: float = 0.0
    count: int = 0
    first_s: float = 0.0
    last_s: float = 0.0

    def add(self, delay_s: float, now_s: float) -> None:
        """Count one."""
        if not self.count:
            self.first_s = now_s
        self.last_s = now_s
        self.count += 1
        self.total_s += delay_s
        self.largest_s = max(self.largest_s, delay_s)

    @property
    def average_s(self) -> float:
        """Mean delay."""
        return self.total_s / self.count

    @property
    def rate_hz(self) -> float:
        """Count over the time from the first to the last; 1e8 for a single one, as tf says."""
        return self.count / max(self.last_s - self.first_s, _MIN_DURATION_S)


@dataclass(slots=True)
class FrameDelays:
    """Delays by frame and by broadcaster; may be filled and read from different threads.

    Attributes:
        authority_of: frame → who publishes it, with ``(static)`` behind static ones.
    """

    frames: dict[str, Delays] = field(default_factory=dict)
    nodes: dict[str, Delays] = field(default_factory=dict)
    authority_of: dict[str, str] = field(default_factory=dict)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def add(self, message: Any, publisher: str, now_s: float, *, is_static: bool) -> None:
        """Count a ``tf2_msgs/TFMessage``; static transforms are never late."""
        if not message.transforms:
            return
        authority = publisher + ("(static)" if is_static else "")
        sum_s = 0.0
        with self.lock:
            for one in message.transforms:
                stamp = one.header.stamp
                delay_s = 0.0 if is_static else now_s - stamp.sec - stamp.nanosec * 1e-9
                sum_s += delay_s
                name = one.child_frame_id.removeprefix("/")
                self.authority_of[name] = authority
                self.frames.setdefault(name, Delays()).add(delay_s, now_s)
            mean_s = sum_s / len(message.transforms)
            self.nodes.setdefault(authority, Delays()).add(mean_s, now_s)


@dataclass(slots=True)
class NetDelay:
    """How old the newest transform of a chain is, smoothed."""

    average_s: float = 0.0
    largest_s: float = 0.0

    def add(self, delay_s: float) -> None:
        """Count one look."""
        self.average_s = _LOWPASS * delay_s + (1.0 - _LOWPASS) * self.average_s
        self.largest_s = max(self.largest_s, delay_s)


class _Monitor:
    def __init__(self, graph: Graph, frames: list[str]) -> None:
        self._frames = frames
        self._clock = graph.clock
        self._delays, self._net = FrameDelays(), NetDelay()
        self._ended = threading.Event()
        node = graph.create_node("tf_monitor", anonymous=True)
        node.on_shutdown(lambda _reason: self._ended.set())
        graph.clock.follow(node)
        self._buffer = TransformBuffer()
        TransformListener(self._buffer, node)
        for topic, is_static in (("/tf", False), ("/tf_static", True)):
            take = self._taker(is_static=is_static)
            node.create_subscription(topic, "tf2_msgs/TFMessage", take, with_info=True)

    def run(self) -> None:
        if self._frames:
            self._watch_chain(*self._frames)
            return
        print("Gathering data on all frames for 10 seconds...", flush=True)
        while not self._ended.wait(_ALL_S):
            self._print([])

    def _watch_chain(self, source: str, target: str) -> None:
        frames_text = f"between {source} and {target} "
        print(f"Waiting for transform chain to become available {frames_text}", flush=True)
        while not self._buffer.can_transform(source, target, timeout_s=_WAIT_S):
            if self._ended.is_set():
                return
        while True:
            for _ in range(_LOOKS):
                if self._ended.wait(_LOOK_S):
                    return
                self._look(source, target)
            self._print(self._buffer.chain(target, source))

    def _look(self, source: str, target: str) -> None:
        try:
            newest_ns = self._buffer.latest_common_time_ns(source, target)
        except TransformError:
            # The chain may be gone for a while; what was counted stays.
            return
        self._net.add((self._clock.now_ns() - newest_ns) * 1e-9 if newest_ns else 0.0)

    def _print(self, chain: list[str]) -> None:
        results, title, nodes = report(self._delays, chain, self._net)
        print(results, flush=True)
        print(title, file=sys.stderr, flush=True)
        print(nodes, flush=True)

    def _taker(self, *, is_static: bool) -> Any:
        def take(message: Any, info: Any) -> None:
            now_s = self._clock.now_ns() * 1e-9
            publisher = info.publisher or "unknown_publisher"
            self._delays.add(message, publisher, now_s, is_static=is_static)

        return take


def main(argv: list[str]) -> int:
    """Run until Ctrl-C; 255 for wrong arguments."""
    tokens = parse_command_line(argv).rest
    if len(tokens) not in {0, 2}:
        print(_USAGE, file=sys.stderr)
        return 255
    frames = [word.removeprefix("/") for word in tokens]
    return run_tool(Tool("tf_monitor", {"watch": _watch}, _USAGE), ["watch", *frames])


def report(delays: FrameDelays, chain: list[str], net: NetDelay) -> tuple[str, str, str]:
    """Return the three parts of a block: results and frames, a title, broadcasters.

    The title goes to standard error, as the original's does.

    Args:
        delays: what was counted.
        chain: frames from the first to the second, empty for all frames.
        net: of the chain.
    """
    lines = ["", "", ""]
    if chain:
        lines += [
            f"RESULTS: for {chain[0]} to {chain[-1]}",
            f"Chain is: {' -> '.join(chain)}",
            f"Net delay     avg = {net.average_s:g}: max = {net.largest_s:g}",
        ]
    else:
        lines.append("RESULTS: for all Frames")
    lines += ["", "Frames:"]
    with delays.lock:
        lines += [
            f"Frame: {name} published by {delays.authority_of[name]} {_delay_text(found)}"
            for name, found in sorted(delays.frames.items())
            if not chain or name in chain
        ]
        nodes = [
            f"Node: {name} {found.rate_hz:g} Hz, {_delay_text(found)}"
            for name, found in sorted(delays.nodes.items())
        ]
    return "\n".join(lines), "\nAll Broadcasters:", "\n".join(nodes)


def _watch(frames: list[str]) -> int:
    with join_graph() as graph:
        _Monitor(graph, frames).run()
    return 0


def _delay_text(found: Delays) -> str:
    return f"Average Delay: {found.average_s:g} Max Delay: {found.largest_s:g}"
