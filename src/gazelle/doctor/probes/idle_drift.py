"""Does a robot that nobody commands stay where it is?"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.doctor.report import Section
from gazelle.geometry import Pose
from gazelle.simulator.simulation import Simulation

__all__ = ["probe_idle_drift"]

_SETTLE_S = 2.0
_WATCH_S = 10.0
_STILL_M = 1e-3
_STILL_DEG = 0.1
_COLUMNS = ("robot", "moved", "turned", "worst link", "verdict")


def probe_idle_drift(
    simulation: Simulation, robots: Sequence[Model], diagnostics: Diagnostics
) -> Section:
    """Wait 10 s after 2 s of settling; more than 1 mm or 0.1° is a finding."""
    simulation.run(seconds=_SETTLE_S)
    before = {robot.name: _poses(simulation, robot) for robot in robots}
    simulation.run(seconds=_WATCH_S)
    rows = []
    for robot in robots:
        after = _poses(simulation, robot)
        moves = {name: _motion(first, after[name]) for name, first in before[robot.name].items()}
        base = moves[robot.canonical_link or robot.links[0].name]
        worst = max(moves, key=lambda name: moves[name][0])
        still = base[0] < _STILL_M and base[1] < _STILL_DEG
        if not still:
            _report(simulation, robot, base, worst, diagnostics)
        shown = (f"{base[0] * 1e3:.3g} mm", f"{base[1]:.3g}°")
        rows.append((robot.name, *shown, worst, "still" if still else "drifts"))
    title = f"idle robots, {_WATCH_S:g} s without a command"
    return Section("idle_drift", title, _COLUMNS, tuple(rows))


def _report(
    simulation: Simulation,
    robot: Model,
    base: tuple[float, float],
    worst: str,
    diagnostics: Diagnostics,
) -> None:
    text = (
        f"robot '{robot.name}' moved {base[0] * 1e3:.3g} mm and turned {base[1]:.3g}° in "
        f"{_WATCH_S:g} s without a command; link '{worst}' moved most"
    )
    touching = _contacts(simulation, robot.name)
    text += f"; it touches: {touching}" if touching else "; nothing touches it"
    link = robot.link(worst)
    diagnostics.report("probe.idle-drift", text, link.span if link else robot.span)


def _poses(simulation: Simulation, robot: Model) -> dict[str, Pose]:
    engine = simulation.server.engine
    return {
        link.name: engine.link(f"{robot.name}::{link.name}").T_world_link() for link in robot.links
    }


def _motion(before: Pose, after: Pose) -> tuple[float, float]:
    """Return metres and degrees."""
    step = before.inverse() @ after
    moved = float(np.linalg.norm(np.subtract(after.position_m, before.position_m)))
    turned = 2.0 * math.acos(min(1.0, abs(step.quat_xyzw[3])))
    return moved, math.degrees(turned)


def _contacts(simulation: Simulation, name: str) -> str:
    pairs = []
    for contact in simulation.server.engine.contacts():
        both = (contact.collision1, contact.collision2)
        own = [item.partition("::")[2] for item in both if item.startswith(f"{name}::")]
        other = [item for item in both if not item.startswith(f"{name}::")]
        if own and other:
            pairs.append(f"{own[0]} on {other[0]}")
    return ", ".join(sorted(pairs)[:4])
