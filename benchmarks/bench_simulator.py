"""How fast worlds run: our loop against bare MuJoCo, and SLAMBOT with its sensors.

    python benchmarks/bench_simulator.py [--workspaces FOLDER] [--seconds S]

Figures are medians; run on an otherwise idle machine. Gazebo Classic 11 on the same kind of
machine and data: 9.3 times real time with nobody subscribed, 8.2 with scan and odometry, 0.55
with every camera frame delivered.
"""

from __future__ import annotations

import argparse
import os
import resource
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import mujoco

from gazelle.interfaces.poses import twist_message
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros

LIGHT = ("/scan", "/odom", "/tf", "/joint_states")
FULL = (
    *LIGHT,
    "/depth_camera/rgb/image_raw",
    "/depth_camera/depth/image_raw",
    "/depth_camera/depth/points",
    "/depth_camera/rgb/camera_info",
)


def load(workspaces: Path) -> Simulation:
    os.environ["ROS_PACKAGE_PATH"] = str(workspaces / "catkin_ws" / "src")
    os.environ["GAZEBO_MODEL_PATH"] = str(workspaces / "gazebo_models")
    robot = workspaces / "catkin_ws" / "src" / "slam_robot"
    sim = Simulation.load(
        robot / "urdf" / "slam_robot_gazebo.urdf",
        world=robot / "worlds" / "slam_robot_world.world",
        name="slam_robot",
    )
    offer_gazebo_ros(sim.server)
    return sim


def wall_s(work: Callable[[], None]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def drive(sim: Simulation, forward: float, turn: float) -> None:
    command = twist_message((forward, 0.0, 0.0), (0.0, 0.0, turn))
    sim.publish("/cmd_vel", command)


def against_bare(workspaces: Path, *, driving: bool, steps: int, repeats: int) -> float:
    """Return our wall time over bare MuJoCo's for the same model, state and commands."""
    sim = load(workspaces)
    sim.run(seconds=2.0)
    if driving:
        drive(sim, 0.2, 0.3)
        sim.run(seconds=1.0)
    engine = sim.server.engine
    ratios = []
    for _ in range(repeats):
        twin = mujoco.MjData(engine.model)
        mujoco.mj_copyData(twin, engine.model, engine.data)
        bare = wall_s(lambda twin=twin: mujoco.mj_step(engine.model, twin, steps))
        ours = wall_s(lambda: sim.step(steps))
        ratios.append(ours / bare)
    sim.close()
    return statistics.median(ratios)


def real_time_factor(
    workspaces: Path, topics: tuple[str, ...], *, driving: bool, seconds: float, repeats: int
) -> float:
    sim = load(workspaces)
    received: dict[str, int] = dict.fromkeys(topics, 0)

    def count(topic: str) -> Callable[[object], None]:
        def take(message: object) -> None:
            received[topic] += 1

        return take

    for topic in topics:
        sim.subscribe(topic, count(topic))
    sim.run(seconds=2.0)
    if driving:
        drive(sim, 0.2, 0.3)
        sim.run(seconds=0.5)
    factors = [seconds / wall_s(lambda: sim.run(seconds=seconds)) for _ in range(repeats)]
    sim.close()
    return statistics.median(factors)


def main() -> None:
    parser = argparse.ArgumentParser()
    default = Path(__file__).parents[2] / "shared" / "workspaces"
    parser.add_argument("--workspaces", type=Path, default=default)
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    ws, repeats, seconds = options.workspaces, options.repeats, options.seconds
    steps = round(seconds * 1000)
    rest = against_bare(ws, driving=False, steps=steps, repeats=repeats)
    driving = against_bare(ws, driving=True, steps=steps, repeats=repeats)
    print(f"loop / bare MuJoCo, at rest   {rest:6.2f}   (at most 1.25)")
    print(f"loop / bare MuJoCo, driving   {driving:6.2f}   (at most 1.50)")
    alone = real_time_factor(ws, (), driving=False, seconds=10 * seconds, repeats=repeats)
    print(f"real-time factor, at rest     {alone:6.1f}   (at least 40)")
    light = real_time_factor(ws, LIGHT, driving=True, seconds=seconds, repeats=repeats)
    print(f"real-time factor, scan + odom {light:6.1f}   (at least 15)")
    full = real_time_factor(ws, FULL, driving=True, seconds=seconds, repeats=repeats)
    print(f"real-time factor, every frame {full:6.2f}   (at least 1.5, target 3)")
    peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak memory                   {peak_mb:6.0f} MB (at most 400)")


if __name__ == "__main__":
    main()
