"""How punctual playing is, and how much recording writes to memory.

python benchmarks/bench_bag.py
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import numpy as np

from gazelle.bag import Storage, cdr_connection, create_bag, open_bag
from gazelle.bag.playing import Controls, Player, PlayOptions
from gazelle.graph import Graph
from gazelle.interfaces import message_type, to_cdr

RATE_HZ = 500
PLAYED_S = 5
MEGABYTES_S = 200
RECORDED_S = 4.0


def lateness(graph: Graph, folder: Path) -> None:
    """Play 500 messages a second and compare with their schedule."""
    kind = message_type("std_msgs/msg/Int64")
    writer = create_bag(folder / "play.mcap", Storage.MCAP)
    one = writer.add(cdr_connection("/tick", "std_msgs/msg/Int64"))
    for place in range(RATE_HZ * PLAYED_S):
        stamp_ns = 10**18 + place * 10**9 // RATE_HZ
        writer.write(one, stamp_ns, to_cdr(kind(data=stamp_ns)))
    writer.close()
    node, late_ms = graph.create_node("player"), []
    player: Player

    def take(message: object) -> None:
        late_ms.append(-player.timeline.wait_ns(message.data) / 1e6)  # type: ignore[attr-defined]

    node.create_subscription("/tick", kind, take, inline=True)
    bags = [open_bag(folder / "play.mcap")]
    quiet = (lambda *_args: None, lambda *_args: None)
    player = Player(node, bags, PlayOptions(), Controls(), *quiet)
    player.play()
    p50, p99 = np.percentile(late_ms, [50, 99])
    print(f"play, {RATE_HZ} Hz: late by {p50:.2f} ms (median), {p99:.2f} ms (p99)", flush=True)
    node.shutdown()


def throughput(graph: Graph, folder: Path, words: list[str], name: str) -> None:
    """Publish 200 MB/s, record them, and count what is in the bag."""
    node = graph.create_node("talker")
    kind = message_type("std_msgs/msg/UInt8MultiArray")
    publisher = node.create_publisher("/load", kind)
    command = [sys.executable, "-m", "gazelle.cli", *words]
    recorder = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL)
    while not (graph.subscription_count("/load") and publisher.matched):
        time.sleep(0.01)
    message, sent, start = kind(data=np.zeros(1 << 20, np.uint8)), 0, time.monotonic()
    pause = threading.Event()
    while time.monotonic() - start < RECORDED_S:
        publisher.publish(message)
        sent += 1
        pause.wait(max(start + sent * 1.048576 / MEGABYTES_S - time.monotonic(), 0))
    took_s = time.monotonic() - start
    time.sleep(1.0)
    recorder.send_signal(signal.SIGINT)
    recorder.wait()
    (path,) = folder.iterdir()
    kept = open_bag(path).summary.messages
    rate = kept * 1.048576 / took_s
    print(f"record {name}: {kept} of {sent} MB kept, {rate:.0f} MB/s", flush=True)
    node.shutdown()


def main() -> None:
    """Print both."""
    os.environ.setdefault("GAZELLE_PORT", "17773")
    commands = {
        "bag": ["rosbag", "record", "-q", "-b", "1024", "-O", "a", "/load"],
        "mcap": ["ros2", "bag", "record", "-o", "a", "/load"],
        "db3": ["ros2", "bag", "record", "-o", "a", "-s", "sqlite3", "/load"],
    }
    with Graph.open() as graph:
        with tempfile.TemporaryDirectory(dir="/dev/shm") as folder:
            lateness(graph, Path(folder))
        for name, words in commands.items():
            with tempfile.TemporaryDirectory(dir="/dev/shm") as folder:
                throughput(graph, Path(folder), words, name)


if __name__ == "__main__":
    main()
