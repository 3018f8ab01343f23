"""Does a robot that nobody commands stay where it is?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.probes.robot_motion import (
    Motion,
    base_name,
    contacts_of,
    link_poses,
    motion_between,
)
from gazelle.doctor.report import Section
from gazelle.geometry import Pose
from gazelle.simulator.simulation import Simulation

__all__ = ["FALLS", "probe_idle_drift"]

FALLS = "falls"
"""Verdict on a robot of which nothing more can be learned."""

_SETTLE_S = 2.0
_WATCH_S = 10.0
_STILL_M = 1e-3
_STILL_DEG = 0.1
_FALLING_M = 1.0
_COLUMNS = ("robot", "moved", "turned", "moved most", "verdict")


def probe_idle_drift(
    simulation: Simulation, robots: Sequence[Model], diagnostics: Diagnostics
) -> Section:
    """Wait 10 s after 2 s of settling; more than 1 mm or 0.1° of the base is a finding.

    What feels no gravity, a balloon or a drone that its plug-in moves, may float about.
    """
    simulation.run(seconds=_SETTLE_S)
    before = {robot.name: link_poses(simulation, robot) for robot in robots}
    simulation.run(seconds=_WATCH_S)
    rows = []
    for robot in robots:
        after = link_poses(simulation, robot)
        moves = {
            name: motion_between(pose, after[name]) for name, pose in before[robot.name].items()
        }
        base = moves[base_name(robot)]
        worst = max(moves, key=lambda name: moves[name].moved_m)
        if base.moved_m < _STILL_M and base.turned_deg < _STILL_DEG:
            verdict = "still"
        elif not any(link.gravity for link in robot.links):
            verdict = "floats"
        else:
            start = before[robot.name][base_name(robot)]
            drop_m = _drop_m(simulation, start, after[base_name(robot)])
            verdict = _report(simulation, robot, base, drop_m, worst, diagnostics)
        shown = (_length(base.moved_m), f"{base.turned_deg:.3g}°")
        most = f"{worst} ({_length(moves[worst].moved_m)})"
        rows.append((robot.name, *shown, most, verdict))
    title = f"idle robots: {_WATCH_S:g} s without a command, after {_SETTLE_S:g} s of settling"
    return Section("probe_idle_drift", title, _COLUMNS, tuple(rows))


def _report(
    simulation: Simulation,
    robot: Model,
    base: Motion,
    drop_m: float,
    worst: str,
    diagnostics: Diagnostics,
) -> str:
    touching = contacts_of(simulation, robot, with_itself=False)
    link = robot.link(worst)
    span = link.span if link is not None else robot.span
    if not touching and drop_m > _FALLING_M:
        text = (
            f"robot '{robot.name}' falls: {base.moved_m:.3g} m in {_WATCH_S:g} s, and nothing "
            "touches it"
        )
        fix = (
            "put a ground plane into the world below the robot, and give the links that stand on "
            "it a <collision> whose mesh can be found"
        )
        diagnostics.report("probe.falls", text, span, fix=fix)
        return FALLS
    text = (
        f"robot '{robot.name}' moved {_length(base.moved_m)} and turned {base.turned_deg:.3g}° "
        f"in {_WATCH_S:g} s without a command; link '{worst}' moved most"
    )
    text += (
        f"; it touches {', '.join(sorted(touching)[:4])}" if touching else "; it touches nothing"
    )
    diagnostics.report("probe.idle-drift", text, span)
    return "moves"


def _drop_m(simulation: Simulation, before: Pose, after: Pose) -> float:
    """Return how far something has come along gravity; 0 where there is none."""
    gravity = np.array(simulation.server.engine.world.gravity_m_s2)
    size = float(np.linalg.norm(gravity))
    way = np.subtract(after.position_m, before.position_m)
    return float(way @ gravity) / size if size else 0.0


def _length(value_m: float) -> str:
    return f"{value_m:.3g} m" if value_m >= 1.0 else f"{value_m * 1e3:.3g} mm"
