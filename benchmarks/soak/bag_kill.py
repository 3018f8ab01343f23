"""Kill a recorder with SIGKILL during 50 MB/s, again and again; count what is missing.

    python benchmarks/soak/bag_kill.py [RUNS] [FORMAT…]

Every file must open at once, and nothing but the last second may be missing.
"""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

from gazelle.bag import open_bag
from gazelle.graph import Graph

SIZE = 1 << 20
RATE_HZ = 50
ALLOWED_S = 1.0


class Talker:
    """Publishes numbered megabytes and keeps the time of each."""

    def __init__(self, graph: Graph) -> None:
        self.node = graph.create_node("talker")
        kind = "std_msgs/msg/UInt8MultiArray"
        self.publisher = self.node.create_publisher("/load", kind)
        self.sent: list[int] = []
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def start(self) -> None:
        """Begin to publish."""
        self._thread.start()

    def stop(self) -> None:
        """Publish no more."""
        self._stop.set()
        self._thread.join()
        self.node.shutdown()

    def _run(self) -> None:
        import numpy as np

        start = time.monotonic()
        while not self._stop.is_set():
            data = np.zeros(SIZE, np.uint8)
            data[:8] = np.frombuffer(len(self.sent).to_bytes(8, "little"), np.uint8)
            self.sent.append(time.time_ns())
            self.publisher.publish(self.publisher.message_class(data=data))
            self._stop.wait(max(start + len(self.sent) / RATE_HZ - time.monotonic(), 0))


def run_once(graph: Graph, words: list[str], folder: Path, seconds: float) -> tuple[float, float]:
    """Record for so long, kill, and return the missing seconds and the time to open."""
    # The one killed before is off the graph when its connection is.
    while graph.subscription_count("/load"):
        time.sleep(0.01)
    talker = Talker(graph)
    command = [sys.executable, "-m", "gazelle.cli", *words]
    recorder: Any = subprocess.Popen(
        command, cwd=folder, stdout=subprocess.DEVNULL, start_new_session=True
    )
    while not (graph.subscription_count("/load") and talker.publisher.matched):
        time.sleep(0.01)
    talker.start()
    time.sleep(seconds)
    recorder.send_signal(signal.SIGKILL)
    killed_ns = time.time_ns()
    recorder.wait()
    talker.stop()
    (path,) = folder.iterdir()
    start = time.monotonic()
    bag = open_bag(path)
    summary = bag.summary
    opened_s = time.monotonic() - start
    messages = list(bag.messages())
    bag.close()
    assert summary.messages == len(messages) > 0, f"{path}: {summary}"
    stamps = [one.stamp_ns for one in messages]
    assert stamps == sorted(stamps)
    due = [stamp for stamp in talker.sent if stamp < killed_ns - int(ALLOWED_S * 1e9)]
    assert len(messages) >= len(due), f"{len(messages)} of {len(due)} messages due are there"
    return (killed_ns - stamps[-1]) / 1e9, opened_s


def main(runs: int, formats: list[str]) -> None:
    os.environ.setdefault("GAZELLE_PORT", "17771")
    commands = {
        "bag": ["rosbag", "record", "-q", "-O", "a", "/load"],
        "mcap": ["ros2", "bag", "record", "-o", "a", "-s", "mcap", "/load"],
        "db3": ["ros2", "bag", "record", "-o", "a", "-s", "sqlite3", "/load"],
    }
    with Graph.open() as graph:
        for name in formats:
            missing, opened = [], []
            for number in range(runs):
                seconds = 1.5 + random.Random(number).random()
                with tempfile.TemporaryDirectory(dir="/dev/shm") as folder:
                    lost_s, opened_s = run_once(graph, commands[name], Path(folder), seconds)
                missing.append(lost_s)
                opened.append(opened_s)
            print(
                f"{name}: {runs} runs, every file opens; missing at most {max(missing):.2f} s, "
                f"opened in at most {max(opened) * 1e3:.0f} ms",
                flush=True,
            )


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    main(count, sys.argv[2:] or ["bag", "mcap", "db3"])
