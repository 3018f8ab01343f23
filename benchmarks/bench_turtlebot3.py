"""How much faster than real time do simulation, SLAM and navigation of a TurtleBot3 run together?

    python benchmarks/bench_turtlebot3.py [--workspaces DIR] [--model waffle] [--factor F]

``turtlebot3_world.launch``, ``turtlebot3_slam.launch`` (gmapping) and ``move_base.launch`` as
published; the robot drives to goals between the pillars while it maps. Simulated time is asked to
run F times faster than real time and goes slower whenever move_base sends fewer than 8 of its 10
commands a simulated second. Wanted: 2 times real time on two cores.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT), str(Path(__file__).parent / "soak")]

from tests.tutorial.turtlebot3_session import Session  # noqa: E402

from navigation import commands  # noqa: E402

_GOALS = ((-0.55, 0.55, 0.0), (0.55, 0.55, -1.57), (0.55, -0.55, 3.14), (-0.55, -0.55, 1.57))


def main() -> int:
    """Drive and print the ratio."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workspaces", type=Path, default=ROOT.parent / "shared" / "workspaces")
    parser.add_argument("--model", default="waffle")
    parser.add_argument("--factor", type=float, default=4.0)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, commands(Path(folder)) as run:
        session = Session(run, options.workspaces / "turtlebot3_ws", options.model)
        session.launch("turtlebot3_slam", "turtlebot3_slam.launch", "slam_methods:=gmapping")
        session.launch("turtlebot3_navigation", "move_base.launch")
        session.hurry(options.factor)
        session.drive_to(_GOALS[0])
        wall_s, simulated_s, ratios, commanded = time.monotonic(), session.now_s, [], 0
        for goal in _GOALS[1:] + _GOALS:
            commanded -= session.commands
            began = time.monotonic(), session.now_s
            text = session.drive_to(goal).text
            commanded += session.commands
            ratios.append((session.now_s - began[1]) / (time.monotonic() - began[0]))
            print(f"{goal}: {text} {ratios[-1]:.2f} x real time", flush=True)
        wall_s, simulated_s = time.monotonic() - wall_s, session.now_s - simulated_s
    print(
        f"{options.model}: simulation, SLAM and navigation {simulated_s / wall_s:.2f} x real time, "
        f"{commanded / simulated_s:.1f} commands a simulated second"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
