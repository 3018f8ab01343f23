"""Time to start: a launch to its first scan, a command, the import.

Run ``python benchmarks/bench_startup.py [PACKAGE FILE.launch] [--topic /scan]`` inside a catkin
workspace; prints one JSON object per measurement, medians of several runs. Kernels and byte code
are cached by a first run that does not count.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time

from gazelle.graph import Graph


def main() -> None:
    """Measure everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("target", nargs="*", help="what roslaunch is given; the empty world else")
    parser.add_argument("--topic", default="/clock", help="whose first message is waited for")
    parser.add_argument("--runs", type=int, default=5)
    options = parser.parse_args()
    target = options.target or ["gazebo_ros", "empty_world.launch"]
    launches = [_launch(target, options.topic) for _ in range(options.runs + 1)][1:]
    _print(f"roslaunch {' '.join(target)} to first {options.topic}", launches)
    _print("import gazelle", [_command("-c", "import gazelle") for _ in range(options.runs)])
    _print("python -c pass", [_command("-c", "pass") for _ in range(options.runs)])


def _launch(target: list[str], topic: str) -> dict[str, float]:
    """Return seconds from the command to the first message, and of ``rostopic list`` then."""
    port = _free_port()
    with (
        Graph.open(port=port, role="hub", environ={}) as graph,
        tempfile.TemporaryDirectory() as home,
    ):
        first = threading.Event()
        node = graph.create_node("probe", rosout=False)
        node.create_subscription(topic, None, lambda _message: first.set(), raw=True)
        environ = {**os.environ, "GAZELLE_PORT": str(port), "ROS_HOME": home}
        words = [sys.executable, "-m", "gazelle.cli", "roslaunch", *target]
        start = time.monotonic()
        launch = subprocess.Popen(
            words, env=environ, start_new_session=True,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        try:
            if not first.wait(60):
                sys.exit(f"no message on {topic} within 60 s")
            seconds = time.monotonic() - start
            words = ("-m", "gazelle.cli", "rostopic", "list")
            listing = min((_command(*words, env=environ) for _ in range(3)), key=_seconds)
        finally:
            launch.send_signal(signal.SIGINT)
            launch.wait(30)
    return {"seconds": seconds, "rostopic_list_s": listing["seconds"]}


def _command(*words: str, env: dict[str, str] | None = None) -> dict[str, float]:
    start = time.monotonic()
    subprocess.run([sys.executable, *words], env=env, check=True, stdout=subprocess.DEVNULL)
    return {"seconds": time.monotonic() - start}


def _seconds(measured: dict[str, float]) -> float:
    return measured["seconds"]


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _print(what: str, runs: list[dict[str, float]]) -> None:
    medians = {key: round(statistics.median(run[key] for run in runs), 3) for key in runs[0]}
    print(json.dumps({"what": what, "runs": len(runs), **medians}))


if __name__ == "__main__":
    main()
