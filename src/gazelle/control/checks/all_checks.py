"""All checks of a robot's controllers, reported."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from gazelle.control.checks.configured_controllers import (
    ConfiguredController,
    Gains,
    MoveItController,
    configured_controllers,
)
from gazelle.control.checks.gain_stability import largest_stable_factor
from gazelle.control.checks.joint_names import disagreements, table_text
from gazelle.control.parameter_sources.ros1_parameter_server import ParameterSource
from gazelle.control.resource_manager import JointResource
from gazelle.description.model import Joint
from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["LoopDynamics", "check_control"]

# Below this factor it is the proportion of p to d that is unstable, not their size.
_ALL_UNSTABLE = 1e-3


@dataclass(frozen=True, slots=True)
class LoopDynamics:
    """What decides which gains are stable.

    Attributes:
        inertias: by joint name, see `joint_inertias`; gains of other joints are not checked.
        step_s: of the physics.
        period_steps: physics steps between two updates of the controllers.
    """

    inertias: Mapping[str, float]
    step_s: float = 1e-3
    period_steps: int = 1


def check_control(
    joints: Mapping[str, Joint],
    hardware: Mapping[str, JointResource],
    source: ParameterSource,
    diagnostics: Diagnostics,
    *,
    moveit: Sequence[MoveItController] = (),
    absent: Collection[str] = (),
    loop: LoopDynamics | None = None,
    span: SourceSpan | None = None,
) -> None:
    """Report what can be known before the first step.

    Args:
        joints: of the robot description, by name.
        hardware: joints that controllers can have.
        source: parameters of the controllers.
        diagnostics: receives the findings.
        moveit: what MoveIt sends trajectories to.
        absent: joints of hardware that was not loaded, which is reported by itself.
        loop: what the gains act on; they are not checked without.
        span: the plug-in's place, for findings that have no better one.
    """
    controllers = configured_controllers(source)
    types = {name: joint.type.value for name, joint in joints.items()}
    rows = disagreements(types, hardware, controllers, moveit, absent)
    if rows:
        named = {name for row in rows for name in row.controllers}
        spans = [item.span for item in controllers if item.name in named and item.span]
        text = "robot, hardware, controllers and MoveIt do not mean the same joints:\n"
        first = spans[0] if spans else span
        diagnostics.report("control.names-disagree", text + table_text(rows), first)
    wanted = {name for item in controllers for name in item.joints}
    for name in hardware:
        if name in joints and name in wanted:
            _check_limits(joints[name], hardware[name], diagnostics)
    for item in controllers:
        for gains in item.gains:
            joint = joints.get(gains.joint)
            resource = hardware.get(gains.joint)
            if resource is not None and "effort" not in resource.command_interfaces:
                # Configured for another hardware interface, as files for several have it.
                continue
            if joint is not None and loop is not None and gains.joint in loop.inertias:
                nearest = source.span(item.name, gains.key) or item.span or span
                _check_gains(item, gains, joint, loop, nearest, diagnostics)


def _check_limits(joint: Joint, resource: JointResource, diagnostics: Diagnostics) -> None:
    axis = joint.axis
    interfaces = resource.command_interfaces
    if axis is None:
        return
    if axis.effort == 0 and "effort" in interfaces:
        text = f"joint '{joint.name}' has the effort limit 0 and an effort interface: every "
        text += "command is cut to 0, the joint will not be moved (as in Gazebo)"
        fix = 'write the motor\'s limit, as <limit effort="10" …/>'
        diagnostics.report("control.zero-limit", text, joint.span, fix=fix)
    elif axis.velocity == 0 and interfaces and "effort" not in interfaces:
        text = f"joint '{joint.name}' has the velocity limit 0: joint limits of ros_control hold "
        text += "it where it is"
        fix = 'write the motor\'s limit, as <limit velocity="2" …/>'
        diagnostics.report("control.zero-limit", text, joint.span, fix=fix)


def _check_gains(
    controller: ConfiguredController,
    gains: Gains,
    joint: Joint,
    loop: LoopDynamics,
    span: SourceSpan | None,
    diagnostics: Diagnostics,
) -> None:
    inertia, period_s = loop.inertias[gains.joint], loop.step_s * loop.period_steps
    factor = largest_stable_factor(
        gains.p,
        gains.d,
        inertia,
        loop.step_s,
        period_steps=loop.period_steps,
        of_velocity=gains.of_velocity,
        damping=joint.axis.damping if joint.axis is not None else 0.0,
    )
    if factor < 1.0:
        text = f"controller '{controller.name}': gains p {gains.p:g}, d {gains.d:g} of joint "
        text += f"'{gains.joint}' are unstable: it has an inertia of {inertia:.3g} and efforts "
        text += f"change every {period_s * 1e3:g} ms. Gazebo shakes such a joint or "
        text += "throws it; here its feedback acts within each step"
        fix = f"use at most p {gains.p * factor:.3g}, d {gains.d * factor:.3g}, or a smaller step"
        if factor < _ALL_UNSTABLE:
            fix = f"every p needs some d at this period: try d {gains.p * period_s:.3g}"
        diagnostics.report("control.unstable-gains", text, span, fix=fix)
