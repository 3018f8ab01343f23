"""``libgazebo_ros_wheel_slip``, ``WheelSlipPlugin`` and gz-sim's ``WheelSlip``."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.description.model import Joint
from gazelle.description.xml import Tag
from gazelle.description.xml.numbers import floats_from
from gazelle.diagnostics import did_you_mean
from gazelle.graph.ros2_node_parameters import NodeParameters, ParameterPolicy
from gazelle.interfaces import message_type
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.diff_drive_geometry import wheel_radius_m
from gazelle.simulator.plugins.dynamic_reconfigure import DynamicParameter, DynamicParameters
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["GAZEBO_TABLE", "GZ_TABLE", "TABLE", "load", "load_gazebo", "load_gz"]


_LAW = (
    "A wheel slides at slip · F under the friction force F, with slip = compliance · r |ω| /"
    " `wheel_normal_force`: the slip ratio is the compliance times the force ratio, up to the"
    " friction coefficient (docs/contact.md).",
    "The rate is looked at 100 times a second; a wheel that does not turn does not slip.",
    "`fdir1` is not needed: the directions are those of the wheel's joint.",
)

_WHEEL = Parameter(
    "wheel",
    "group",
    "",
    "a wheel by its `link_name`, with slip_compliance_lateral, slip_compliance_longitudinal,"
    " wheel_normal_force in N and wheel_radius in m (else that of its collision); repeatable",
)

TABLE = PluginTable(
    ParameterTable(
        "wheel_slip",
        "Lets wheels slip in proportion to force, with parameters that can be changed live.",
        ("gazebo_ros_wheel_slip",),
        (
            _WHEEL,
            Parameter(
                "robotNamespace",
                "text",
                "wheel_slip",
                "below the model's name (ROS 1)",
                ros_versions=(1,),
            ),
            Parameter(
                "wheel_spin_tolerance", "number", 1e-3, "rim speed below which slip is 0", "m/s"
            ),
            Parameter("publisher_update_rate", "number", 100.0, "rate of `wheel_slip`", "Hz"),
        ),
    ),
    topics=(
        Topic("wheel_slip", "gazebo_msgs/msg/WheelSlip", rate="`publisher_update_rate` (ROS 2)"),
        Topic(
            "/M/wheel_slip/parameter_updates",
            "dynamic_reconfigure/msg/Config",
            rate="changes (ROS 1)",
        ),
    ),
    services=(
        Topic(
            "/M/wheel_slip/set_parameters (ROS 1)",
            "dynamic_reconfigure/srv/Reconfigure",
            kind="service",
        ),
        Topic("set_parameters … (ROS 2)", "rcl_interfaces/srv/SetParameters …", kind="service"),
    ),
    behaviour=(
        *_LAW,
        "ROS 1 takes `slip_compliance_unitless_lateral` and `_longitudinal` by"
        " dynamic_reconfigure, for all wheels.",
        "ROS 2 has them as parameters of its node, for all wheels or `/link` for one. The"
        " parameters `friction_coefficient_…` are not offered: friction is that of the surface.",
    ),
    in_both_ros=True,
)

GAZEBO_TABLE = PluginTable(
    ParameterTable(
        "WheelSlipPlugin",
        "Gazebo Classic's wheel slip without ROS.",
        ("WheelSlipPlugin",),
        (_WHEEL,),
    ),
    behaviour=_LAW,
)

GZ_TABLE = PluginTable(
    ParameterTable(
        "gz-sim wheel slip",
        "The gz-sim system of the same purpose.",
        (
            "gz-sim-wheel-slip-system",
            "ignition-gazebo-wheel-slip-system",
            "gz::sim::systems::WheelSlip",
            "ignition::gazebo::systems::WheelSlip",
        ),
        (_WHEEL,),
    ),
    behaviour=_LAW,
)

_WAYS = ("lateral", "longitudinal")

_PREFIX = "slip_compliance_unitless_"

# Gazebo sets the slip at every step; a hundredth of a second is fine enough for a wheel's rate.
_UPDATE_HZ = 100.0


def load(context: PluginContext) -> None:
    """Start the ROS plug-in of either generation."""
    parameters = context.reader(TABLE)
    slip = _Slip(context, _wheels(context, parameters))
    if slip.wheels:
        if parameters.is_ros2():
            _offer_ros2(context, parameters, slip)
        else:
            _offer_ros1(context, parameters, slip)
    parameters.report_unread()


def load_gazebo(context: PluginContext) -> None:
    """Start Gazebo Classic's own plug-in."""
    _load_plain(context, context.reader(GAZEBO_TABLE))


def load_gz(context: PluginContext) -> None:
    """Start the gz-sim system."""
    _load_plain(context, context.reader(GZ_TABLE))


def _load_plain(context: PluginContext, parameters: PluginReader) -> None:
    _Slip(context, _wheels(context, parameters))
    parameters.report_unread()


@dataclass(slots=True)
class _Wheel:
    """One wheel; the compliances are slip ratio per force ratio."""

    link: str
    joint: str
    lateral: float
    longitudinal: float
    normal_force_n: float
    radius_m: float


class _Slip:
    """Sets the slip of wheels from their speeds."""

    def __init__(self, context: PluginContext, wheels: list[_Wheel]) -> None:
        self.wheels = wheels
        self._context = context
        self._engine = context.host.engine
        self._joints = [self._engine.joint(wheel.joint) for wheel in wheels]
        self._set()
        period = period_in_steps(_UPDATE_HZ, self._engine.step_ns)
        if wheels:
            context.resources.task(f"{context.plugin.name} slip", period, self._set)

    def change(self, way: str, value: float, link: str = "") -> None:
        """Set the compliance of one wheel, or of all."""
        for wheel in self.wheels:
            if link in ("", wheel.link):
                setattr(wheel, way, value)
        self._set()

    def _set(self) -> None:
        for wheel, joint in zip(self.wheels, self._joints, strict=True):
            speed = abs(joint.velocity) * wheel.radius_m
            scale = speed / wheel.normal_force_n
            self._engine.set_wheel_slip(
                wheel.joint, scale * wheel.lateral, scale * wheel.longitudinal, wheel.radius_m
            )

    def measure(self, wheel: _Wheel) -> tuple[float, float, float]:
        """Return forward and sideways speed of a wheel and the speed of its rim."""
        model = self._context.model
        joint = self._engine.joint(wheel.joint)
        link = self._engine.link(f"{model.name}::{wheel.link}")
        T_joint_link = joint.joint.T_model_joint.inverse() @ link.link.T_model_link
        T_world_joint = link.T_world_link() @ T_joint_link.inverse()
        axis = np.asarray(T_world_joint.rotate(joint.axis.xyz))
        ahead = np.cross(axis, -np.asarray(self._engine.gravity_m_s2))
        length = float(np.linalg.norm(ahead))
        velocity = link.velocity_world().linear_m_s
        forward = float(velocity @ ahead) / length if length > 0 else 0.0
        return forward, float(velocity @ axis), joint.velocity * wheel.radius_m


def _wheels(context: PluginContext, parameters: PluginReader) -> list[_Wheel]:
    parameters.texts("wheel")
    tags = [tag for tag in context.plugin.parameters.children if tag.name == "wheel"]
    if not tags:
        text = f"plug-in '{context.plugin.name}' has no <wheel>; nothing slips"
        context.report("parameter.bad-value", text)
    found = [_wheel(context, tag) for tag in tags]
    return [wheel for wheel in found if wheel is not None]


def _wheel(context: PluginContext, tag: Tag) -> _Wheel | None:
    name = tag.attributes.get("link_name", "")
    if context.link_name(name) is None:
        return None
    joint = _axle(context, name)
    if joint is None:
        text = f"link '{name}' has no parent joint that turns; it cannot slip like a wheel"
        context.report("parameter.bad-value", text)
        return None
    radius = _number(context, tag, "wheel_radius") or wheel_radius_m(context.model, joint) or 0.0
    force = _number(context, tag, "wheel_normal_force")
    if radius <= 0 or force <= 0:
        what = "wheel_normal_force" if force <= 0 else "wheel_radius"
        text = f"wheel '{name}' needs a positive <{what}>; it does not slip"
        context.report("parameter.bad-value", text)
        return None
    lateral, longitudinal = (
        max(0.0, _number(context, tag, f"slip_compliance_{way}")) for way in _WAYS
    )
    full = f"{context.model.name}::{joint.name}"
    return _Wheel(name, full, lateral, longitudinal, force, radius)


def _axle(context: PluginContext, link: str) -> Joint | None:
    joints = (joint for joint in context.model.joints if joint.child == link)
    return next((joint for joint in joints if joint.type.is_hinge), None)


def _number(context: PluginContext, tag: Tag, name: str) -> float:
    child = tag.find(name)
    if child is None:
        return 0.0
    diagnostics = context.host.diagnostics
    what = f"<{name}>"
    return floats_from(child.text, 1, (0.0,), what=what, span=child.span, diagnostics=diagnostics)[
        0
    ]


def _offer_ros1(context: PluginContext, parameters: PluginReader, slip: _Slip) -> None:
    """Offer dynamic_reconfigure below ``/<model>/wheel_slip``; negative values change nothing."""
    own = parameters.text("robotNamespace").strip("/") or "wheel_slip"
    rows = [
        DynamicParameter(
            f"{_PREFIX}{way}", "double", -1.0,
            f"Unitless slip compliance (slip / friction) in the {way} direction.", -1.0, 20.0,
            level=0,
        )
        for way in _WAYS
    ]  # fmt: skip

    def changed(values: Any) -> None:
        for way in _WAYS:
            value = float(values[f"{_PREFIX}{way}"])
            if value >= 0:
                slip.change(way, value)

    offered = DynamicParameters(
        context.resources,
        context.host,
        join_names("/", context.model.name, own),
        rows,
        changed=changed,
    )
    changed(offered.values)


def _offer_ros2(context: PluginContext, parameters: PluginReader, slip: _Slip) -> None:
    """Offer the parameters of the plug-in's node and publish ``wheel_slip``."""
    node_name = join_names(context.namespace(parameters), context.plugin.name)
    values = {
        f"{_PREFIX}{way}/{wheel.link}": getattr(wheel, way)
        for way in _WAYS
        for wheel in slip.wheels
    }
    every = {f"{_PREFIX}{way}" for way in _WAYS}

    def take(changes: dict[str, Any]) -> str:
        known = {*values, *every}
        for name, value in changes.items():
            if name not in known:
                return f"there is no parameter {name}; {did_you_mean(name, tuple(known))}"
            if not isinstance(value, int | float) or not 0 <= value < math.inf:
                return "Slip compliance values cannot be negative"
        for name, value in changes.items():
            way, _, link = name.removeprefix(_PREFIX).partition("/")
            slip.change(way, float(value), link)
            if not link:
                offered.update({key: float(value) for key in values if key.startswith(name)})
        return ""

    host = context.host
    offered = NodeParameters(
        host.node,
        node_name,
        values,
        take,
        policy=ParameterPolicy(allow_undeclared=True),
        run=host.commands.call,
        now_ns=lambda: host.engine.time_ns,
    )
    context.resources.on_close(offered.close)
    _publish_slips(context, parameters, slip)


def _publish_slips(context: PluginContext, parameters: PluginReader, slip: _Slip) -> None:
    topic = context.topic(parameters, "wheel_slip")
    publisher = context.resources.publisher(topic, "gazebo_msgs/WheelSlip")
    tolerance = parameters.number("wheel_spin_tolerance")

    def publish() -> None:
        message = message_type("gazebo_msgs/WheelSlip")()
        sideways, along = [], []
        for wheel in slip.wheels:
            forward, lateral, rim = slip.measure(wheel)
            spins = abs(rim) >= tolerance
            sideways.append(math.atan2(lateral, forward) if spins else 0.0)
            along.append((rim - forward) / rim if spins else 0.0)
        message.name = [wheel.link for wheel in slip.wheels]
        message.lateral_slip = np.array(sideways)
        message.longitudinal_slip = np.array(along)
        publisher.publish(message)

    period = period_in_steps(
        parameters.number("publisher_update_rate"), context.host.engine.step_ns
    )
    name = f"{context.plugin.name} wheel_slip"
    context.resources.task(name, period, publish, wanted=lambda: publisher.matched)
