"""How fast the whole launched stack runs: SLAMBOT with ``--fast``, scan and odometry listened to.

    python benchmarks/bench_launched.py [--workspaces FOLDER] [--seconds S] [--repeats N]

Gazebo Classic 11 with gazebo_ros on the same kind of machine and the same files: 5.2 times real
time (state publishers running, scan and odometry subscribed to).
"""

from __future__ import annotations

import argparse
import os
import signal
import statistics
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

GAZEBO_RTF = 5.2
PORT = 7633


def main() -> None:
    """Print the real-time factor of each run and their median."""
    parser = argparse.ArgumentParser(description=__doc__)
    shared = Path(__file__).parents[2] / "shared" / "workspaces"
    parser.add_argument("--workspaces", type=Path, default=shared)
    parser.add_argument("--seconds", type=float, default=8.0)
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    os.environ["GAZELLE_PORT"] = str(PORT)
    os.environ["ROS_PACKAGE_PATH"] = str(options.workspaces / "catkin_ws" / "src")
    os.environ["GAZEBO_MODEL_PATH"] = str(options.workspaces / "gazebo_models")
    factors = [one_run(options.seconds) for _ in range(options.repeats)]
    print("runs               " + " ".join(f"{factor:.1f}" for factor in factors))
    print(f"launched stack      {statistics.median(factors):5.1f} x real time")
    print(f"Gazebo Classic      {GAZEBO_RTF:5.1f} x real time (recorded)")


def one_run(seconds: float) -> float:
    """Return simulated seconds per wall second while scan and odometry are received."""
    words = ["slam_robot", "slam_robot_gazebo.launch"]
    process = subprocess.Popen(
        [sys.executable, "-m", "gazelle.cli", "roslaunch", "--fast", *words],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        return measure(seconds)
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(30)


def measure(seconds: float) -> float:
    """Listen from this process, as another node would."""
    from gazelle.graph import Graph

    first_scan = threading.Event()
    latest: dict[str, Any] = {}
    with Graph.open() as graph:
        node = graph.create_node("bench", namespace="/")

        def take(topic: str, message: Any) -> None:
            latest[topic] = message.header.stamp
            if topic == "/scan":
                first_scan.set()

        node.create_subscription("/scan", "sensor_msgs/msg/LaserScan", lambda m: take("/scan", m))
        node.create_subscription("/odom", "nav_msgs/msg/Odometry", lambda m: take("/odom", m))
        if not first_scan.wait(60):
            raise SystemExit("no scan within a minute")
        time.sleep(1.0)
        start_s, start_wall = stamp_s(latest["/odom"]), time.perf_counter()
        time.sleep(seconds)
        return (stamp_s(latest["/odom"]) - start_s) / (time.perf_counter() - start_wall)


def stamp_s(stamp: Any) -> float:
    """Return a time stamp in seconds."""
    return float(stamp.sec + stamp.nanosec * 1e-9)


if __name__ == "__main__":
    main()
