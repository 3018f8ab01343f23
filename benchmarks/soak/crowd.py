"""60 nodes in 60 processes around a robot: do sleepers hold it up, and does memory stay flat?

    python benchmarks/soak/crowd.py [--minutes N] [--window-s S]

The example robot runs in its workshop, in real time. Around it 6 nodes publish at 1 kHz, 5 look at
the camera's pictures, 44 publish 176 topics and listen to each other's, and 5 more take a first
picture and sleep in its callback for ever. The simulator's rate is measured before the sleepers
come, while they sleep and after they have gone. What each process holds by itself is sampled every
second while they sleep, and after five minutes of it a line is laid through each minute's least:
pictures that are on their way come and go.
Prints one JSON object per figure. Exit code 1 when the rate with sleepers is below 0.95 of that
without, or a process grows by more than 1 MB an hour beyond twice the slope's standard error.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import psutil
from launched_scout import launched_scout
from marked_processes import pids_of

from gazelle.graph import Graph
from gazelle.graph.key_expressions import Entity

_MARK = "GAZELLE_CROWD"
_FAST, _WATCHERS, _SLEEPERS, _NEIGHBOURS, _TOPICS_EACH = 6, 5, 5, 44, 4
_ROLES = ("fast", "watcher", "neighbour", "sleeper")
_PICTURES = "/camera/rgb/image_raw"
_STARTING_S, _SETTLING_S, _SAMPLE_EVERY_S, _WARM_UP_S = 180.0, 20.0, 1.0, 300.0
_MIN_SHARE, _MAX_MB_PER_HOUR = 0.95, 1.0
_MEMBER = """
import sys, threading, time
import rospy
from sensor_msgs.msg import Image
from std_msgs.msg import Float64
role, number = sys.argv[1], int(sys.argv[2])
rospy.init_node(f"{role}_{number}")
if role == "fast":
    out = rospy.Publisher(f"fast_{number}", Float64, queue_size=10)
    due = time.monotonic()
    while not rospy.is_shutdown():
        out.publish(due)
        due += 0.001
        time.sleep(max(0.0, due - time.monotonic()))
elif role == "neighbour":
    outs = [rospy.Publisher(f"topic_{number}_{i}", Float64, queue_size=10) for i in range(EACH)]
    for i in range(EACH):
        rospy.Subscriber(f"topic_{(number + i + 1) % COUNT}_{i}", Float64, lambda _: None)
    while not rospy.is_shutdown():
        for out in outs:
            out.publish(1.0)
        time.sleep(0.2)
else:
    stays = threading.Event()
    rospy.Subscriber(PICTURES, Image, lambda _: stays.wait() if role == "sleeper" else None)
    rospy.spin()
"""


class _Trend(NamedTuple):
    """How what a process holds changes.

    Attributes:
        name: of the node, or the process' command.
        mb: mean of the minutes' least.
        mb_per_hour: slope of the line through the samples.
        error_mb_per_hour: its standard error, of how the samples lie about the line.
    """

    name: str
    mb: float
    mb_per_hour: float
    error_mb_per_hour: float

    @property
    def surely_mb_per_hour(self) -> float:
        """By how much it grows at least."""
        return self.mb_per_hour - 2.0 * self.error_mb_per_hour


def main() -> int:
    """Run, print, judge."""
    options = _options()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    with contextlib.ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        scout = stack.enter_context(launched_scout(folder, _MARK))
        graph, clock = scout.graph, _Clock(scout.graph)
        member = folder / "member.py"
        member.write_text(_member_text(), encoding="utf-8")

        def start(role: str, number: int) -> subprocess.Popen[bytes]:
            return scout.start("gazelle.compat.script_runner", str(member), role, str(number))

        for number in range(_FAST):
            start("fast", number)
        for number in range(_WATCHERS):
            start("watcher", number)
        for number in range(_NEIGHBOURS):
            start("neighbour", number)
        _wait_for_nodes(graph, _FAST + _WATCHERS + _NEIGHBOURS)
        time.sleep(_SETTLING_S)
        topics = len(graph.topics())
        _tell("there", nodes=len(graph.node_names()), topics=topics)
        before = clock.rate(options.window_s)
        sleepers = [start("sleeper", number) for number in range(_SLEEPERS)]
        _wait_for_nodes(graph, _FAST + _WATCHERS + _NEIGHBOURS + _SLEEPERS)
        time.sleep(_SETTLING_S)
        during = clock.rate(options.window_s)
        trends = _trends(folder, options.minutes * 60.0)
        for one in sleepers:
            one.kill()
            one.wait()
        time.sleep(_SETTLING_S)
        after = clock.rate(options.window_s)
    share = during / ((before + after) / 2.0)
    _tell("rate", topics=topics, before=before, with_sleepers=during, after=after, share=share)
    for one in trends:
        _tell("memory", **one._asdict())
    steepest = max((one.surely_mb_per_hour for one in trends), default=0.0)
    _tell("judged", share=share, processes=len(trends), surely_mb_per_hour=steepest)
    return int(share < _MIN_SHARE or steepest > _MAX_MB_PER_HOUR)


def _member_text() -> str:
    text = _MEMBER.replace("EACH", str(_TOPICS_EACH)).replace("COUNT", str(_NEIGHBOURS))
    return text.replace("PICTURES", repr(_PICTURES))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=30.0, help="of looking at memory")
    parser.add_argument("--window-s", type=float, default=60.0, help="of measuring a rate")
    return parser.parse_args()


class _Clock:
    """Simulated time as it comes."""

    def __init__(self, graph: Graph) -> None:
        self._clock = graph.create_node("crowd_clock", rosout=False).clock

    def rate(self, window_s: float) -> float:
        """Return simulated seconds per second."""
        first_ns, begin_s = self._clock.now_ns(), time.monotonic()
        time.sleep(window_s)
        return (self._clock.now_ns() - first_ns) * 1e-9 / (time.monotonic() - begin_s)


def _wait_for_nodes(graph: Graph, count: int) -> None:
    def are_there(known: Iterable[Entity]) -> bool:
        roles = {one.node for one in known if one.node[1:].split("_")[0] in _ROLES}
        return len(roles) >= count

    if not graph.discovery.wait_for(are_there, _STARTING_S):
        raise SystemExit(f"{count} nodes were to come, there are {graph.node_names()}")


def _trends(folder: Path, seconds: float) -> list[_Trend]:
    """Sample what each process holds by itself, and lay lines through it."""
    begin_s = time.monotonic()
    samples: dict[int, list[tuple[float, float]]] = {}
    names: dict[int, str] = {}
    while (now_s := time.monotonic() - begin_s) < seconds:
        for pid in pids_of(_MARK, folder.name):
            with contextlib.suppress(psutil.Error):
                process = psutil.Process(pid)
                names.setdefault(pid, " ".join(process.cmdline()[1:6])[-60:])
                memory = process.memory_info()
                held_mb = (memory.rss - memory.shared) / 1e6
                samples.setdefault(pid, []).append((now_s, held_mb))
        time.sleep(_SAMPLE_EVERY_S)
    warm_up_s = min(_WARM_UP_S, seconds / 3.0)
    trends = []
    for pid, taken in samples.items():
        least: dict[int, tuple[float, float]] = {}
        for one in taken:
            minute = int(one[0] // 60.0)
            if one[0] >= warm_up_s and one[1] < least.get(minute, (0.0, np.inf))[1]:
                least[minute] = one
        times, sizes = np.array(list(least.values())).reshape(-1, 2).T
        # Those that ended meanwhile have no trend.
        if len(times) > 4 and taken[-1][0] > seconds - 60.0:
            line, covariance = np.polyfit(times / 3600.0, sizes, 1, cov=True)
            error = float(np.sqrt(covariance[0, 0]))
            trends.append(_Trend(names[pid], float(sizes.mean()), float(line[0]), error))
    return sorted(trends, key=lambda one: -one.mb_per_hour)


def _tell(what: str, **figures: Any) -> None:
    rounded = {k: round(v, 3) if isinstance(v, float) else v for k, v in figures.items()}
    print(json.dumps({"what": what, **rounded}), flush=True)


if __name__ == "__main__":
    sys.exit(main())
