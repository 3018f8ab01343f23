"""``gz stats``: how fast the world runs."""

from __future__ import annotations

import sys
import time
from collections.abc import Mapping
from typing import Any

from gazelle.cli.gz.options import GzCommand, GzOption, seconds
from gazelle.cli.gz.world_link import WorldLink, world_link

__all__ = ["COMMAND", "run", "stats_line"]

COMMAND = GzCommand(
    "stats",
    "Print gzserver statics to standard out. If a name for the world,\n\toption -w, is not "
    "specified, the first world found on\n\tthe Gazebo master will be used.",
    (
        GzOption("world-name", "w", "World name; Gazelle has one world.", takes=True),
        GzOption("duration", "d", "Duration (seconds) to run.", takes=True),
        GzOption("plot", "p", "Output comma-separated values, useful for processing."),
    ),
)
_PERIOD_S = 0.2
_HEAD = "# real-time factor (percent), simtime (sec), realtime (sec), paused (T or F)"
_NOTE = "gazelle: realtime is counted from here on; Gazebo counts from the start of its world"


def run(options: Mapping[str, str]) -> int:
    """Print five times a second until the duration is over or Ctrl-C.

    Raises:
        GzError: the duration is no number, or there is no world.
    """
    duration_s = seconds(options)
    is_plot = "plot" in options
    with world_link() as link:
        print(_NOTE, file=sys.stderr)
        if is_plot:
            print(_HEAD, flush=True)
        _watch(link, duration_s, is_plot=is_plot)
    return 0


def stats_line(factor: float, sim_s: float, real_s: float, *, paused: bool, plot: bool) -> str:
    """Return one line, for reading or (`plot`) for processing."""
    flag = "T" if paused else "F"
    if plot:
        return f"{factor:4.2f}, {sim_s:16.6f}, {real_s:16.6f}, {flag}"
    return f"Factor[{factor:4.2f}] SimTime[{sim_s:4.2f}] RealTime[{real_s:4.2f}] Paused[{flag}]"


def _watch(link: WorldLink, duration_s: float | None, *, is_plot: bool) -> None:
    start_s = before_s = time.monotonic()
    before_sim_s = _read(link)[0]
    while not link.ended.wait(_PERIOD_S):
        sim_s, paused = _read(link)
        now_s = time.monotonic()
        factor = max(0.0, sim_s - before_sim_s) / (now_s - before_s)
        line = stats_line(factor, sim_s, now_s - start_s, paused=paused, plot=is_plot)
        print(line, flush=True)
        before_s, before_sim_s = now_s, sim_s
        if duration_s is not None and now_s - start_s + _PERIOD_S > duration_s:
            return


def _read(link: WorldLink) -> tuple[float, bool]:
    world: Any = link.call("get_world_properties", "gazebo_msgs/GetWorldProperties")
    physics: Any = link.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties")
    return float(world.sim_time), bool(physics.pause)
