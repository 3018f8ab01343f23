"""SDF ``<joint>``."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.description.model import Joint, JointAxis, JointType, Mimic
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import (
    child_bool,
    child_float,
    optional_float,
    vector3_from,
)
from gazelle.description.sdf_reader.frame_graph import MODEL_FRAME, WORLD_FRAME, FramePoint
from gazelle.description.sdf_reader.poses import PoseResolver
from gazelle.description.sdf_reader.sensors import read_sensor
from gazelle.description.xml import Tag, bool_from, float_from
from gazelle.diagnostics import did_you_mean
from gazelle.geometry import IDENTITY_POSE, Pose, Vector3

__all__ = ["JOINT_TYPES", "JointEnds", "joint_type_of", "read_joint"]

_UNLIMITED = 1e16
_TYPES = (
    JointType.REVOLUTE,
    JointType.CONTINUOUS,
    JointType.PRISMATIC,
    JointType.FIXED,
    JointType.BALL,
    JointType.UNIVERSAL,
    JointType.SCREW,
    JointType.REVOLUTE2,
    JointType.GEARBOX,
)
JOINT_TYPES = {item.value: item for item in _TYPES}
_WITHOUT_AXIS = (JointType.FIXED, JointType.BALL)
_WITH_SECOND_AXIS = (JointType.UNIVERSAL, JointType.REVOLUTE2, JointType.GEARBOX)
_X, _Y, _Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
# ODE gives its joints of two axes these where a file has none: the first is one of the parent's,
# the second one of the child's. The others turn about z, as SDF says of an <axis> without <xyz>.
_DEFAULT_AXES = {JointType.UNIVERSAL: (_Y, _X), JointType.REVOLUTE2: (_X, _Y)}


class JointEnds:
    """Finds the links that joints of one scope connect."""

    def __init__(self, resolver: PoseResolver, scope: str) -> None:
        self._resolver = resolver
        self._scope = scope

    def joint(self, tag: Tag, point: FramePoint) -> Joint | None:
        """Return a joint; None (reported) when its type or one of its ends is not usable."""
        kind = joint_type_of(tag, self._resolver.context)
        parent, child = self._end(tag, "parent"), self._end(tag, "child")
        if kind is None or not parent or not child or self._is_loop(tag, parent, child):
            return None
        return read_joint(tag, kind, parent, child, point, self._resolver)

    def _is_loop(self, tag: Tag, parent: str, child: str) -> bool:
        if parent != child:
            return False
        name = tag.attributes.get("name", "")
        message = f"joint '{name}' joins '{parent}' to itself; it is left out"
        self._resolver.context.diagnostics.report("sdf.bad-joint", message, tag.span)
        return True

    def _end(self, tag: Tag, end: str) -> str:
        """Return the link at one end, ``world`` for the world, empty when there is none."""
        diagnostics, frames = self._resolver.context.diagnostics, self._resolver.frames
        found, name = tag.find(end), tag.attributes.get("name", "")
        wanted = found.text if found is not None else ""
        if not wanted:
            message = f"joint '{name}' names no <{end}>; it is left out"
            diagnostics.report("xml.missing-tag", message, tag.span)
            return ""
        if wanted == WORLD_FRAME and end == "parent":
            return WORLD_FRAME
        link = frames.attached_link(wanted) if wanted in frames else ""
        if not link or link == WORLD_FRAME:
            message = (
                f"{end} frame with name '{wanted}' specified by joint with name '{name}' not "
                f"found in {self._scope}; the joint is left out"
            )
            place = found if found is not None else tag
            fix = did_you_mean(wanted, frames.names)
            diagnostics.report("sdf.bad-joint", message, place.span, fix=fix)
            return ""
        return link


def joint_type_of(tag: Tag, context: ReadContext) -> JointType | None:
    """Return a joint's type; None (reported) when it is missing or unknown."""
    word = tag.attributes.get("type", "").strip().lower()
    found = JOINT_TYPES.get(word)
    if found is None:
        name = tag.attributes.get("name", "")
        message = f"joint '{name}' has the unknown type '{word}'; it is left out"
        context.diagnostics.report(
            "sdf.unknown-joint-type", message, tag.span, fix=did_you_mean(word, JOINT_TYPES)
        )
    return found


def read_joint(
    tag: Tag, kind: JointType, parent: str, child: str, point: FramePoint, resolver: PoseResolver
) -> Joint:
    """Return the joint of a ``<joint>`` element.

    Args:
        tag: the element.
        kind: its type.
        parent: resolved link name, ``world`` for the world.
        child: resolved link name.
        point: the joint's frame in the graph.
        resolver: the model's frames.
    """
    context = resolver.context
    T_model_joint = resolver.frames.pose(point.name)
    axes = _AxisReader(resolver, T_model_joint, point)
    axis, axis2 = tag.find("axis"), tag.find("axis2")
    default_axes = axes.default_axes(kind, parent, child)
    ode = tag.find("physics", "ode")
    return Joint(
        name=tag.attributes["name"].strip(),
        type=kind,
        parent=parent,
        child=child,
        T_model_joint=T_model_joint,
        axis=None if kind in _WITHOUT_AXIS else axes.read(axis, kind, default_axes[0]),
        axis2=axes.read(axis2, kind, default_axes[1]) if kind in _WITH_SECOND_AXIS else None,
        mimic=_mimic(axis, context),
        sensors=tuple(
            sensor
            for item in resolver.named(tag, "sensor")
            if (sensor := read_sensor(item, context)) is not None
        ),
        thread_pitch_rad_m=_thread_pitch(tag, context),
        gearbox_ratio=child_float(tag, "gearbox_ratio", 1.0, context),
        gearbox_reference_body=tag.text_of("gearbox_reference_body"),
        cfm=optional_float(ode, "cfm", context),
        erp=optional_float(ode, "erp", context),
        limit_cfm=optional_float(tag.find("physics", "ode", "limit"), "cfm", context),
        limit_erp=optional_float(tag.find("physics", "ode", "limit"), "erp", context),
        implicit_spring_damper=_is_implicit(ode, context),
        provide_feedback=_has_feedback(tag, context),
        span=tag.span,
    )


def _is_implicit(ode: Tag | None, context: ReadContext) -> bool:
    """SDF 1.4 calls it ``cfm_damping``, later versions ``implicit_spring_damper``."""
    if ode is None:
        return False
    return any(
        child_bool(ode, word, False, context) for word in ("implicit_spring_damper", "cfm_damping")
    )


def _has_feedback(tag: Tag, context: ReadContext) -> bool:
    """It stands in ``<physics>``, up to SDF 1.4 in ``<physics><ode>``."""
    places = (tag.find("physics", "provide_feedback"), tag.find("physics", "ode"))
    inner = places[1].find("provide_feedback") if places[1] is not None else None
    return any(bool_from(place, False, context.diagnostics) for place in (places[0], inner))


def _thread_pitch(tag: Tag, context: ReadContext) -> float:
    """Return radians per metre, positive for a right-handed thread.

    SDF 1.10's ``screw_thread_pitch`` is metres per revolution; ``thread_pitch`` is radians per
    metre with the sign turned round (joint.sdf: thread_pitch = -2π / screw_thread_pitch).
    """
    screw = optional_float(tag, "screw_thread_pitch", context)
    old = optional_float(tag, "thread_pitch", context)
    if screw:
        return 2 * math.pi / screw
    return -old if old else 2 * math.pi


def _mimic(axis: Tag | None, context: ReadContext) -> Mimic | None:
    """Return SDF 1.11's mimic: multiplier · (leader - reference) + offset."""
    tag = axis.find("mimic") if axis is not None else None
    if tag is None:
        return None
    leader = tag.attributes.get("joint", "").strip()
    if not leader:
        context.diagnostics.report(
            "xml.missing-attribute", "<mimic> does not name its joint; it is left out", tag.span
        )
        return None
    multiplier = child_float(tag, "multiplier", 1.0, context)
    reference = child_float(tag, "reference", 0.0, context)
    offset = child_float(tag, "offset", 0.0, context)
    return Mimic(leader, multiplier, offset - multiplier * reference)


@dataclass(frozen=True, slots=True)
class _AxisReader:
    """Reads the axes of one joint."""

    resolver: PoseResolver
    T_model_joint: Pose
    point: FramePoint

    def default_axes(self, kind: JointType, parent: str, child: str) -> tuple[Vector3, Vector3]:
        """Return the directions of axes that the file leaves out, in the joint's frame."""
        if kind not in _DEFAULT_AXES:
            return _Z, _Z
        frames, T_joint_model = self.resolver.frames, self.T_model_joint.inverse()
        T_model_parent = IDENTITY_POSE if parent == WORLD_FRAME else frames.pose(parent)
        first, second = _DEFAULT_AXES[kind]
        return (
            T_joint_model.rotate(T_model_parent.rotate(first)),
            T_joint_model.rotate(frames.pose(child).rotate(second)),
        )

    def read(self, tag: Tag | None, kind: JointType, default_axes: Vector3) -> JointAxis:
        if tag is None:
            return JointAxis(default_axes)
        context = self.resolver.context
        limit, dynamics = tag.find("limit") or tag, tag.find("dynamics") or tag
        turns_freely = kind is JointType.CONTINUOUS
        return JointAxis(
            xyz=self._direction(tag),
            lower=-math.inf if turns_freely else self._limit(limit, "lower", -math.inf),
            upper=math.inf if turns_freely else self._limit(limit, "upper", math.inf),
            effort=self._positive_limit(limit, "effort"),
            velocity=self._positive_limit(limit, "velocity"),
            damping=child_float(dynamics, "damping", 0.0, context),
            friction=child_float(dynamics, "friction", 0.0, context),
            spring_stiffness=child_float(dynamics, "spring_stiffness", 0.0, context),
            spring_reference=child_float(dynamics, "spring_reference", 0.0, context),
            position=child_float(tag, "initial_position", 0.0, context),
        )

    def _direction(self, tag: Tag) -> tuple[float, float, float]:
        """Return the unit vector in the joint's frame."""
        context, xyz_tag = self.resolver.context, tag.find("xyz")
        xyz = vector3_from(xyz_tag, (0.0, 0.0, 1.0), context)
        length = math.hypot(*xyz)
        if length == 0.0:
            message = f"the axis of joint '{self.point.name}' has length 0; 0 0 1 is used"
            context.diagnostics.report("sdf.bad-value", message, (xyz_tag or tag).span)
            xyz, length = (0.0, 0.0, 1.0), 1.0
        frame = self._frame(tag, xyz_tag)
        if frame != self.point.name:
            T_model_frame = self.resolver.frames.pose(frame)
            xyz = self.T_model_joint.inverse().rotate(T_model_frame.rotate(xyz))
        return (xyz[0] / length, xyz[1] / length, xyz[2] / length)

    def _frame(self, tag: Tag, xyz_tag: Tag | None) -> str:
        """Return the frame an axis is given in.

        SDF 1.7: ``expressed_in``, by default the joint's frame. SDF 1.5 and 1.6:
        ``use_parent_model_frame``. Up to SDF 1.4 every axis is given in the model's frame.
        """
        context = self.resolver.context
        wanted = xyz_tag.attributes.get("expressed_in", "").strip() if xyz_tag is not None else ""
        if wanted:
            return self.resolver.frames.known_frame(
                wanted, self.point.name, user=self.point, word="expressed_in"
            )
        in_model = child_bool(tag, "use_parent_model_frame", context.version < (1, 5), context)
        return MODEL_FRAME if in_model else self.point.name

    def _limit(self, tag: Tag, name: str, unlimited: float) -> float:
        found = tag.find(name)
        if found is None or found.text.strip().lstrip("+-").lower() in ("", "inf", "infinity"):
            return unlimited
        value = float_from(found, unlimited, self.resolver.context.diagnostics)
        return value if abs(value) < _UNLIMITED else math.copysign(math.inf, value)

    def _positive_limit(self, tag: Tag, name: str) -> float:
        """Return a limit; SDF means none by a negative one."""
        value = self._limit(tag, name, math.inf)
        return value if value >= 0.0 else math.inf
