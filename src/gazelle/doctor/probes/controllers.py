"""Do all configured controllers load, start and hold the joints?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from gazelle.control.checks.configured_controllers import configured_controllers
from gazelle.control.controller_manager import ControllerManager
from gazelle.control.errors import ControllerError
from gazelle.description.model import JointType, Model
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.report import Section
from gazelle.simulator.simulation import Simulation
from gazelle.simulator.simulation_handles import SimControllers

__all__ = ["probe_controllers"]

_START_S = 0.5
_SLICE_S = 0.005
# Of a second half that is looked at step by step: chatter has a period of two steps.
_WATCH_S = 0.5
_SAG_RAD = 0.05
_SAG_M = 0.005
_SWINGS = 12
_SHAKES_RAD_S = 0.02
_COLUMNS = ("controller", "type", "state", "largest motion in 1 s", "verdict")
_CONFLICT = "conflict"


class _Started(NamedTuple):
    """A controller after the attempt to start it.

    Attributes:
        state: running, in use by another, or failed.
        joints: full names of those it commands.
        holds: it is meant to hold them: its commands are no plain efforts.
    """

    name: str
    type: str
    state: str
    joints: tuple[str, ...] = ()
    holds: bool = False
    span: SourceSpan | None = None


class _Course(NamedTuple):
    """How a joint moved: how far from its start, and how often it turned around."""

    motion: float
    turns: int
    speed: float


def probe_controllers(
    simulation: Simulation, robots: Sequence[Model], diagnostics: Diagnostics
) -> Section:
    """Load and start everything that the parameters configure; watch the joints for 1 s."""
    started: list[_Started] = []
    for namespace, manager in simulation.server.controls.managers.items():
        started += _start_all(simulation, namespace, manager, robots, diagnostics)
    joints = sorted({name for item in started for name in item.joints})
    courses = _watched(simulation, joints) if started else {}
    rows = []
    for item in started:
        worst = max(item.joints, key=lambda name: courses[name].motion, default="")
        verdict = "good" if item.state == "running" else ""
        shown = ""
        if worst:
            unit = _unit(worst, robots)
            shown = f"{worst.partition('::')[2]}: {courses[worst].motion:.3g} {unit}"
            verdict = _judge(item, courses, robots, diagnostics)
        rows.append((item.name, item.type, item.state, shown, verdict))
    return Section("probe_controllers", "controllers at their start", _COLUMNS, tuple(rows))


def _start_all(
    simulation: Simulation,
    namespace: str,
    manager: ControllerManager,
    robots: Sequence[Model],
    diagnostics: Diagnostics,
) -> list[_Started]:
    controllers = SimControllers(simulation.server, manager)
    found = []
    for item in configured_controllers(manager.source):
        name = f"{namespace.rstrip('/')}/{item.name}"
        state = _start(controllers, item.name)
        if state not in ("running", "in use by another"):
            text = f"controller '{name}' ({item.type}) cannot be started: {state}"
            diagnostics.report("probe.controller-start", text, item.span)
            found.append(_Started(name, item.type, "failed", span=item.span))
            continue
        record = manager.controllers[item.name]
        commands = record.commands if record.is_active else ()
        joints = _full_names([one.rpartition("/")[0] for one in commands], robots)
        efforts = bool(commands) and all(one.endswith("/effort") for one in commands)
        holds = bool(joints) and not (efforts and not item.gains)
        found.append(_Started(name, item.type, state, joints, holds, item.span))
    return found


def _start(controllers: SimControllers, name: str) -> str:
    """Start a controller; return what became of it, in words."""
    known = controllers.controllers.get(name)
    if known is not None and known.is_active:
        return "running"
    try:
        if known is None:
            controllers.load(name)
        controllers.start(name)
    except ControllerError as error:
        return "in use by another" if _CONFLICT in str(error) else str(error)
    return "running"


def _watched(simulation: Simulation, joints: Sequence[str]) -> dict[str, _Course]:
    handles = [simulation.server.engine.joint(name) for name in joints]
    positions = [[handle.position for handle in handles]]
    for _ in range(round(_START_S / _SLICE_S)):
        simulation.run(seconds=_SLICE_S)
        positions.append([handle.position for handle in handles])
    velocities = []
    for _ in range(round(_WATCH_S / simulation.step_s)):
        simulation.step()
        positions.append([handle.position for handle in handles])
        velocities.append([handle.velocity for handle in handles])
    if not joints:
        return {}
    q, v = np.asarray(positions), np.asarray(velocities)
    turns = (np.diff(np.sign(v), axis=0) != 0).sum(axis=0)
    return {
        name: _Course(
            float(np.abs(q[:, index] - q[0, index]).max()),
            int(turns[index]),
            float(np.sqrt((v[:, index] ** 2).mean())),
        )
        for index, name in enumerate(joints)
    }


def _judge(
    item: _Started,
    courses: Mapping[str, _Course],
    robots: Sequence[Model],
    diagnostics: Diagnostics,
) -> str:
    shaking = [name for name in item.joints if _shakes(courses[name])]
    if shaking:
        name = max(shaking, key=lambda one: courses[one].speed)
        text = (
            f"joint '{name.partition('::')[2]}' shakes under controller '{item.name}': it turns "
            f"around {courses[name].turns} times in {_WATCH_S:g} s, at {courses[name].speed:.3g} "
            f"{_unit(name, robots)}/s"
        )
        fix = "lower p or raise d, or give the joint a damping"
        diagnostics.report("probe.controller-shakes", text, item.span, fix=fix)
        return "shakes"
    sagging = [name for name in item.joints if courses[name].motion > _largest(name, robots)]
    if sagging and item.holds:
        name = max(sagging, key=lambda one: courses[one].motion)
        text = (
            f"joint '{name.partition('::')[2]}' moves by {courses[name].motion:.3g} "
            f"{_unit(name, robots)} in the first second under controller '{item.name}', which is "
            "to hold it"
        )
        fix = (
            "raise p (and i) of its gains, raise the joint's <limit effort>, or use a position "
            "interface"
        )
        diagnostics.report("probe.controller-sags", text, item.span, fix=fix)
        return "sags"
    return "good"


def _shakes(course: _Course) -> bool:
    return course.turns >= _SWINGS and course.speed > _SHAKES_RAD_S


def _full_names(joints: Sequence[str], robots: Sequence[Model]) -> tuple[str, ...]:
    """Return ``model::joint`` of every joint that a robot has; the first robot with it counts."""
    found: dict[str, str] = {}
    for name in joints:
        for robot in robots:
            joint = robot.joint(name)
            if joint is not None and joint.type is not JointType.FIXED:
                found.setdefault(name, f"{robot.name}::{name}")
    return tuple(found.values())


def _is_sliding(name: str, robots: Sequence[Model]) -> bool:
    model, _, joint_name = name.partition("::")
    joint = next((robot.joint(joint_name) for robot in robots if robot.name == model), None)
    return joint is not None and joint.type is JointType.PRISMATIC


def _unit(name: str, robots: Sequence[Model]) -> str:
    return "m" if _is_sliding(name, robots) else "rad"


def _largest(name: str, robots: Sequence[Model]) -> float:
    return _SAG_M if _is_sliding(name, robots) else _SAG_RAD
