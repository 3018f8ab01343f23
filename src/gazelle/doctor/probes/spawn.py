"""What happens in the first moments: overlaps at the spawn pose, robots that are thrown."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.probes.robot_motion import base_name, contacts_of
from gazelle.doctor.report import Section
from gazelle.simulator.simulation import Simulation

__all__ = ["probe_spawn"]

_WATCH_S = 0.2
_SLICE_S = 0.01
_DEEP_M = 0.005
# Falling arms and landing wheels move a base slower than this.
_THROWN_M_S = 1.0
_COLUMNS = ("robot", "deepest overlap", "with", "fastest", "verdict")


def probe_spawn(
    simulation: Simulation, robots: Sequence[Model], diagnostics: Diagnostics
) -> Section:
    """Look at the contacts of the first step and at the speeds of the first 0.2 s."""
    simulation.step()
    outside = {robot.name: contacts_of(simulation, robot, with_itself=False) for robot in robots}
    inside = {robot.name: contacts_of(simulation, robot, with_itself=True) for robot in robots}
    fastest = dict.fromkeys(outside, 0.0)
    for _ in range(round(_WATCH_S / _SLICE_S)):
        simulation.run(seconds=_SLICE_S)
        for robot in robots:
            link = simulation.server.engine.link(f"{robot.name}::{base_name(robot)}")
            x, y, z = (float(value) for value in link.velocity_world()[0])
            # Falling is no throw.
            speed = float(np.linalg.norm((x, y, max(0.0, z))))
            fastest[robot.name] = max(fastest[robot.name], speed)
    rows = []
    for robot in robots:
        pairs = {**outside[robot.name], **inside[robot.name]}
        worst = max(pairs, key=lambda name: pairs[name], default="")
        depth = pairs.get(worst, 0.0)
        speed = fastest[robot.name]
        _report_overlap(robot, outside[robot.name], speed, diagnostics, is_inside=False)
        _report_overlap(robot, inside[robot.name], speed, diagnostics, is_inside=True)
        thrown = speed > _THROWN_M_S
        if thrown and depth <= _DEEP_M:
            _report_throw(robot, speed, worst, depth, diagnostics)
        verdict = "thrown" if thrown else "overlaps" if depth > _DEEP_M else "good"
        shown = (f"{depth * 1e3:.3g} mm", worst, f"{speed:.2g} m/s")
        rows.append((robot.name, *shown, verdict))
    title = f"spawn: overlaps, and the first {_WATCH_S:g} s"
    return Section("probe_spawn", title, _COLUMNS, tuple(rows))


def _report_overlap(
    robot: Model,
    pairs: dict[str, float],
    speed_m_s: float,
    diagnostics: Diagnostics,
    *,
    is_inside: bool,
) -> None:
    worst = max(pairs, key=lambda name: pairs[name], default="")
    depth = pairs.get(worst, 0.0)
    if depth <= _DEEP_M:
        return
    more = sum(value > _DEEP_M for value in pairs.values()) - 1
    others = f" (and {more} more pairs)" if more else ""
    does = f"they are pushed apart, here with up to {speed_m_s:.2g} m/s, in Gazebo with a throw"
    if is_inside:
        text = (
            f"the collisions {worst} of robot '{robot.name}' start {depth * 1e3:.3g} mm inside "
            f"each other{others}: {does}"
        )
        fix = "make them smaller, or leave out <self_collide>"
    else:
        text = (
            f"robot '{robot.name}' is spawned {depth * 1e3:.3g} mm inside something: {worst}"
            f"{others}; {does}"
        )
        fix = f"spawn it {_upwards(depth)} m higher (spawn_model … -z), or somewhere free"
    diagnostics.report("probe.spawn-overlap", text, _span_of(robot, worst), fix=fix)


def _upwards(depth_m: float) -> str:
    return f"{np.ceil(depth_m * 1e3 + 1.0) / 1e3:g}"


def _report_throw(
    robot: Model, speed_m_s: float, worst: str, depth_m: float, diagnostics: Diagnostics
) -> None:
    text = (
        f"robot '{robot.name}' reaches {speed_m_s:.3g} m/s upwards or sideways within "
        f"{_WATCH_S:g} s after it is spawned"
    )
    if worst:
        text += f"; its deepest contact is {worst}, {depth_m * 1e3:.3g} mm"
    diagnostics.report("probe.thrown", text, _span_of(robot, worst))


def _span_of(robot: Model, pair: str) -> SourceSpan | None:
    """Return the place of the collision that a pair names first."""
    name = pair.strip("'").partition("'")[0]
    for link in robot.links:
        for item in link.collisions:
            if f"{link.name}::{item.name}" == name:
                return item.span or link.span
    return robot.span
