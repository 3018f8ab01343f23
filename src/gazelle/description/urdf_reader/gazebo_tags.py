"""What ``<gazebo>`` tags say about a robot, its links and its joints, and its plug-ins."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any, cast

from gazelle.description.materials import GAZEBO_MATERIAL_NAMES, gazebo_material
from gazelle.description.model import (
    Collision,
    Joint,
    Link,
    Material,
    Model,
    PluginTag,
    Sensor,
    Surface,
    Visual,
)
from gazelle.description.model.plugin import read_plugin
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.known_elements import report_plugin_of
from gazelle.description.sdf_reader.lights import read_light
from gazelle.description.sdf_reader.materials import read_material
from gazelle.description.sdf_reader.sensors import read_sensor
from gazelle.description.sdf_reader.surface_friction import read_surface
from gazelle.description.urdf_reader.fixed_joint_lumping import with_watched_collisions
from gazelle.description.urdf_reader.gazebo_extension_insertion import INSERTED_ELEMENTS
from gazelle.description.xml import Tag, bool_from, floats_from
from gazelle.diagnostics import did_you_mean

__all__ = [
    "apply_gazebo",
    "blocks_by_reference",
]

_VISUAL_CHILDREN = ("cast_shadows", "laser_retro", "material", "transparency")
_SURFACE_ELEMENTS = {
    "kd": "kd",
    "kp": "kp",
    "maxVel": "max_vel_m_s",
    "minDepth": "min_depth_m",
    "mu1": "mu1",
    "mu2": "mu2",
}
_COLLISION_ELEMENTS = (*_SURFACE_ELEMENTS, "collision", "fdir1", "laserRetro", "maxContacts")
_VISUAL_ELEMENTS = ("material", "visual")
# Read elsewhere: plug-ins go to the model, canonicalBody does nothing in sdformat either.
_LINK_READ_WITH_MODEL = ("canonicalBody", "plugin")
_JOINT_READ_WITH_MODEL = ("plugin",)
_MODEL_ELEMENTS = ("allow_auto_disable", "plugin", "self_collide", "static")
_WITHOUT_EFFECT = ("canonicalBody", "enable_wind")
_OLD_PREFIX = "controller:"
_WORLD = "world"


def blocks_by_reference(robot: Tag) -> dict[str, list[Tag]]:
    """Return the ``<gazebo>`` elements by ``reference``, empty for the whole robot."""
    blocks: dict[str, list[Tag]] = {}
    for tag in robot.find_all("gazebo"):
        blocks.setdefault(tag.attributes.get("reference", "").strip(), []).append(tag)
    return blocks


def apply_gazebo(model: Model, robot: Tag, context: ReadContext) -> Model:
    """Return the model with every ``<gazebo>`` block applied.

    Args:
        model: the robot as URDF describes it.
        robot: the ``<robot>`` with the blocks.
        context: where to report, and look-up of files.
    """
    blocks = blocks_by_reference(robot)
    links = {link.name: link for link in model.links}
    joints = {joint.name: joint for joint in model.joints}
    for reference, tags in blocks.items():
        if reference in links:
            links[reference] = _apply_to_link(links[reference], tags, context)
        elif reference in joints:
            joints[reference] = _apply_to_joint(joints[reference], tags, context)
        elif reference:
            _report_reference(reference, tags, links, joints, context)
    model = replace(model, links=tuple(links.values()), joints=tuple(joints.values()))
    model = with_watched_collisions(model, robot)
    for block in blocks.get("", ()):
        for tag in block.children:
            model = _apply_model_element(model, tag, context)
    plugins = tuple(
        read_plugin(tag, reference=reference)
        for reference, tags in blocks.items()
        for block in tags
        for tag in block.find_all("plugin")
    )
    return replace(model, plugins=_in_document_order(plugins + model.plugins))


def _value_of(tag: Tag) -> str:
    """Return the text or, as sdformat allows too, the ``value`` attribute."""
    return tag.attributes.get("value", tag.text).strip()


def _float_value(tag: Tag, context: ReadContext) -> float | None:
    """Return the number in an element; None (reported) when it holds none."""
    found = floats_from(
        _value_of(tag), 1, (), what=f"<{tag.name}>", span=tag.span, diagnostics=context.diagnostics
    )
    return found[0] if found else None


def _bool_value(tag: Tag, default: bool, context: ReadContext) -> bool:
    """Return the truth value in an element; `default` (reported) when it holds none."""
    return bool_from(replace(tag, text=_value_of(tag)), default, context.diagnostics)


def _report_unknown(tag: Tag, where: str, known: Iterable[str], context: ReadContext) -> None:
    """Report an element that has no meaning in this ``<gazebo>`` block, or none here."""
    if tag.name == "projector":
        message = f"<projector> in <gazebo> for {where} is not simulated: no picture is projected"
        context.diagnostics.report("sdf.not-simulated", message, tag.span)
        return
    message = f"<{tag.name}> is not known in <gazebo> for {where}; it has no effect"
    context.diagnostics.report(
        "xml.unknown-tag", message, tag.span, fix=did_you_mean(tag.name, known)
    )


def _report_passed_over(
    link: str, shapes: Iterable[Visual | Collision], tag: Tag, context: ReadContext
) -> None:
    """Report shapes that sdformat would not apply a link's ``<gazebo>`` values to."""
    names = [shape.name for shape in shapes if link not in shape.name]
    if names:
        shown = ", ".join(f"'{name}'" for name in names)
        message = (
            f"<{tag.name}> acts on all shapes of link '{link}'; Gazebo would pass over {shown}"
        )
        context.diagnostics.report("urdf.gazebo-named-shape", message, tag.span)


def _apply_visual_elements(link: Link, tags: list[Tag], context: ReadContext) -> Link:
    """Return the link with ``<material>`` and ``<visual>`` elements applied to all its visuals.

    ``<material>`` names a Gazebo script and wins over URDF's own colours, as in Gazebo.

    Args:
        link: the link.
        tags: its ``<material>`` and ``<visual>`` elements, in document order.
        context: where to report, and look-up of scripts.
    """
    visuals = link.visuals
    if tags:
        _report_passed_over(link.name, visuals, tags[0], context)
    for tag in tags:
        if tag.name == "visual":
            for plugin in tag.find_all("plugin"):
                report_plugin_of(plugin, "visual", context)
            visuals = tuple(_apply_block(visual, tag, context) for visual in visuals)
            continue
        material = _script_material(tag, context)
        if material is not None:
            visuals = tuple(replace(visual, material=material) for visual in visuals)
    return replace(link, visuals=visuals)


def _apply_to_link(link: Link, blocks: list[Tag], context: ReadContext) -> Link:
    """Return the link with all its ``<gazebo reference>`` blocks applied, the later ones last.

    Args:
        link: the link as URDF describes it.
        blocks: the ``<gazebo>`` elements that refer to it.
        context: where to report, and look-up of files.
    """
    tags = [tag for block in blocks for tag in block.children]
    link = _apply_visual_elements(
        link, [tag for tag in tags if tag.name in _VISUAL_ELEMENTS], context
    )
    link = _apply_collision_elements(link, tags, context)
    for tag in tags:
        handler = _LINK_HANDLERS.get(tag.name)
        if handler is not None:
            link = handler(link, tag, context)
        elif tag.name not in _COLLISION_ELEMENTS + _VISUAL_ELEMENTS + _LINK_READ_WITH_MODEL:
            known = (
                *_LINK_HANDLERS,
                *_COLLISION_ELEMENTS,
                *_VISUAL_ELEMENTS,
                *_LINK_READ_WITH_MODEL,
            )
            _report_unknown(tag, f"link '{link.name}'", known, context)
    return link


def _apply_to_joint(joint: Joint, blocks: list[Tag], context: ReadContext) -> Joint:
    """Return the joint with all its ``<gazebo reference>`` blocks applied, the later ones last.

    Args:
        joint: the joint as URDF describes it.
        blocks: the ``<gazebo>`` elements that refer to it.
        context: where to report.
    """
    for tag in (tag for block in blocks for tag in block.children):
        handler = _JOINT_HANDLERS.get(tag.name)
        if handler is not None:
            joint = handler(joint, tag, context)
        elif tag.name not in _JOINT_READ_WITH_MODEL:
            _report_unknown(tag, f"joint '{joint.name}'", _JOINT_HANDLERS, context)
    return joint


def _script_material(tag: Tag, context: ReadContext) -> Material | None:
    name = _value_of(tag)
    if not name and tag.children:
        message = "a <material> with elements inside has no effect here, where the text is the"
        message += " name of a material; the shapes keep their own look"
        inside = next((item.text_of("name") for item in tag.find_all("script")), "")
        fix = f"write <material>{inside or 'Gazebo/Orange'}</material>"
        context.diagnostics.report("urdf.gazebo-material", message, tag.span, fix=fix)
        return None
    found = gazebo_material(name)
    if found is None:
        hint = did_you_mean(name, GAZEBO_MATERIAL_NAMES)
        message = f"material '{name}' is none of Gazebo's; the shapes keep their own look"
        context.diagnostics.report("urdf.gazebo-material", message, tag.span, fix=hint)
    return found


def _apply_block(visual: Visual, block: Tag, context: ReadContext) -> Visual:
    for tag in block.children:
        if tag.name == "transparency":
            value = _float_value(tag, context)
            visual = visual if value is None else replace(visual, transparency=value)
        elif tag.name == "cast_shadows":
            visual = replace(visual, cast_shadows=_bool_value(tag, True, context))
        elif tag.name == "laser_retro":
            value = _float_value(tag, context)
            visual = visual if value is None else replace(visual, laser_retro=value)
        elif tag.name == "material":
            visual = replace(visual, material=read_material(tag, context) or visual.material)
        elif tag.name not in (*_VISUAL_CHILDREN, "plugin"):
            _report_unknown(tag, "a visual", _VISUAL_CHILDREN, context)
    return visual


def _apply_collision_elements(link: Link, tags: list[Tag], context: ReadContext) -> Link:
    changes = _surface_changes(tags, context)
    base = next(
        (
            read_surface(tag.find("surface"), context)
            for tag in reversed(tags)
            if tag.name == "collision" and tag.find("surface") is not None
        ),
        None,
    )
    retro = _laser_retro(tags, context)
    if base is None and not changes and retro is None:
        return link
    first = next(tag for tag in tags if tag.name in _COLLISION_ELEMENTS)
    if not link.collisions:
        message = f"<{first.name}> for link '{link.name}' has no effect: it has no <collision>"
        context.diagnostics.report("urdf.gazebo-no-collision", message, first.span)
    _report_passed_over(link.name, link.collisions, first, context)
    return replace(
        link,
        collisions=tuple(
            _changed(collision, base, changes, retro) for collision in link.collisions
        ),
    )


def _changed(
    collision: Collision, base: Surface | None, changes: dict[str, Any], retro: float | None
) -> Collision:
    surface = replace(base if base is not None else collision.surface, **changes)
    laser_retro = collision.laser_retro if retro is None else retro
    return replace(collision, surface=surface, laser_retro=laser_retro)


def _surface_changes(tags: list[Tag], context: ReadContext) -> dict[str, Any]:
    changes: dict[str, Any] = {}
    for tag in tags:
        if tag.name in _SURFACE_ELEMENTS:
            value = _float_value(tag, context)
            if value is not None:
                changes[_SURFACE_ELEMENTS[tag.name]] = value
        elif tag.name == "fdir1":
            changes["fdir1"] = _direction(tag, context)
        elif tag.name == "maxContacts":
            changes["max_contacts"] = _whole_number(tag, context)
        elif tag.name == "collision":
            changes.update(_collision_block(tag, context))
    return changes


def _collision_block(tag: Tag, context: ReadContext) -> dict[str, Any]:
    changes: dict[str, Any] = {}
    for child in tag.children:
        if child.name == "max_contacts":
            changes["max_contacts"] = _whole_number(child, context)
        elif child.name not in ("laser_retro", "surface"):
            known = ("laser_retro", "max_contacts", "surface")
            _report_unknown(child, "a collision", known, context)
    return changes


def _laser_retro(tags: list[Tag], context: ReadContext) -> float | None:
    found = [tag for tag in tags if tag.name == "laserRetro"]
    found += [
        child for tag in tags if tag.name == "collision" for child in tag.find_all("laser_retro")
    ]
    values = [_float_value(tag, context) for tag in found]
    return values[-1] if values else None


def _whole_number(tag: Tag, context: ReadContext) -> int | None:
    value = _float_value(tag, context)
    return None if value is None else int(value)


def _direction(tag: Tag, context: ReadContext) -> tuple[float, float, float] | None:
    found = floats_from(
        _value_of(tag), 3, (), what="<fdir1>", span=tag.span, diagnostics=context.diagnostics
    )
    length = sum(value * value for value in found) ** 0.5
    if not found or length == 0.0:
        return None
    return cast(tuple[float, float, float], tuple(value / length for value in found))


def _turn_gravity_off(link: Link, tag: Tag, context: ReadContext) -> Link:
    return replace(link, gravity=not _bool_value(tag, True, context))


def _gravity(link: Link, tag: Tag, context: ReadContext) -> Link:
    return replace(link, gravity=_bool_value(tag, True, context))


def _self_collide(link: Link, tag: Tag, context: ReadContext) -> Link:
    return replace(link, self_collide=_bool_value(tag, False, context))


def _kinematic(link: Link, tag: Tag, context: ReadContext) -> Link:
    return replace(link, kinematic=_bool_value(tag, False, context))


def _damping_factor(link: Link, tag: Tag, context: ReadContext) -> Link:
    value = _float_value(tag, context)
    return link if value is None else replace(link, linear_damping=value, angular_damping=value)


def _velocity_decay(link: Link, tag: Tag, context: ReadContext) -> Link:
    linear, angular = tag.find("linear"), tag.find("angular")
    if linear is None and angular is None:
        return _damping_factor(link, tag, context)
    for child, name in ((linear, "linear_damping"), (angular, "angular_damping")):
        value = _float_value(child, context) if child is not None else None
        changes: dict[str, Any] = {} if value is None else {name: value}
        link = replace(link, **changes)
    return link


def _link_sensor(link: Link, tag: Tag, context: ReadContext) -> Link:
    sensor: Sensor | None = read_sensor(tag, context)
    return link if sensor is None else replace(link, sensors=(*link.sensors, sensor))


def _light(link: Link, tag: Tag, context: ReadContext) -> Link:
    light = read_light(tag, context)
    return link if light is None else replace(link, lights=(*link.lights, light))


def _slip(link: Link, tag: Tag, context: ReadContext) -> Link:
    message = (
        f"<{tag.name}> directly in <gazebo> is not read by Gazebo and has no effect on "
        f"link '{link.name}'"
    )
    fix = (
        "write <collision><surface><friction><ode><slip1>…</slip1><slip2>…</slip2></ode>"
        "</friction></surface></collision>"
    )
    context.diagnostics.report("urdf.gazebo-no-effect", message, tag.span, fix=fix)
    return link


def _number(name: str) -> Callable[[Joint, Tag, ReadContext], Joint]:
    def apply(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
        value = _float_value(tag, context)
        changes: dict[str, Any] = {} if value is None else {name: value}
        return replace(joint, **changes)

    return apply


def _flag(name: str) -> Callable[[Joint, Tag, ReadContext], Joint]:
    def apply(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
        changes: dict[str, Any] = {name: _bool_value(tag, False, context)}
        return replace(joint, **changes)

    return apply


def _spring(name: str) -> Callable[[Joint, Tag, ReadContext], Joint]:
    def apply(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
        value = _float_value(tag, context)
        if value is None:
            return joint
        if joint.axis is None:
            message = f"<{tag.name}> has no effect: joint '{joint.name}' is {joint.type.value}"
            context.diagnostics.report("urdf.gazebo-no-axis", message, tag.span)
            return joint
        changes: dict[str, Any] = {name: value}
        return replace(joint, axis=replace(joint.axis, **changes))

    return apply


def _keep_fixed(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
    kept = joint.disable_fixed_joint_lumping or _bool_value(tag, False, context)
    return replace(joint, disable_fixed_joint_lumping=kept)


def _fudge_factor(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
    message = f"<fudgeFactor> of joint '{joint.name}' is a word of ODE's solver; it has no effect"
    context.diagnostics.report("urdf.gazebo-no-effect", message, tag.span)
    return joint


def _joint_sensor(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
    sensor = read_sensor(tag, context)
    return joint if sensor is None else replace(joint, sensors=(*joint.sensors, sensor))


def _physics(joint: Joint, tag: Tag, context: ReadContext) -> Joint:
    """SDF's own ``<physics>``, which sdformat copies into the joint."""
    ode = tag.find("ode")
    for block in (block for block in (tag, ode) if block is not None):
        for child in block.children:
            if child.name in _PHYSICS_HANDLERS:
                joint = _PHYSICS_HANDLERS[child.name](joint, child, context)
            elif child.name == "limit":
                for value in child.children:
                    if value.name in _LIMIT_HANDLERS:
                        joint = _LIMIT_HANDLERS[value.name](joint, value, context)
            elif child.name != "ode":
                _report_unknown(child, f"joint '{joint.name}'", _PHYSICS_HANDLERS, context)
    return joint


def _apply_model_element(model: Model, tag: Tag, context: ReadContext) -> Model:
    if tag.name == "static":
        return replace(model, static=_bool_value(tag, False, context))
    if tag.name == "self_collide":
        return replace(model, self_collide=_bool_value(tag, False, context))
    if tag.name == "allow_auto_disable":
        return replace(model, allow_auto_disable=_bool_value(tag, True, context))
    if tag.name.startswith(_OLD_PREFIX):
        return replace(model, plugins=(*model.plugins, _old_controller(tag, context)))
    if tag.name in _WITHOUT_EFFECT:
        message = f"<{tag.name}> for the whole robot has no effect"
        context.diagnostics.report("urdf.gazebo-no-effect", message, tag.span)
    elif tag.name not in (*_MODEL_ELEMENTS, *INSERTED_ELEMENTS):
        known = (*_MODEL_ELEMENTS, *INSERTED_ELEMENTS, *_WITHOUT_EFFECT)
        _report_unknown(tag, "the whole robot", known, context)
    return model


def _old_controller(tag: Tag, context: ReadContext) -> PluginTag:
    """Return a 2011 ``<controller:…>`` as the plug-in it became in Gazebo 1.0."""
    name = tag.attributes.get("name", "").strip()
    library = tag.attributes.get("plugin", "").strip()
    message = (
        f"<{tag.name}> is how plug-ins were written before Gazebo 1.0 (2012); "
        f"it is read as plug-in '{library}'"
    )
    fix = f'write <plugin name="{name}" filename="{library}">…</plugin>'
    context.diagnostics.report("urdf.old-controller", message, tag.span, fix=fix)
    return PluginTag(name, library, tag)


def _says_more(tag: Tag) -> bool:
    """Tell whether a block about the world says more than that the world stands still."""
    return any(child.name not in {"plugin", "static"} for child in tag.children)


def _report_reference(
    reference: str,
    tags: list[Tag],
    links: Mapping[str, Link],
    joints: Mapping[str, Joint],
    context: ReadContext,
) -> None:
    hint = did_you_mean(reference, [*links, *joints])
    message = f"<gazebo reference='{reference}'> is neither a link nor a joint; it has no effect"
    if reference == _WORLD and any(joint.parent == _WORLD for joint in joints.values()):
        tags = [tag for tag in tags if _says_more(tag)]
        message = "<gazebo reference='world'> means the world itself, where it has no effect"
    for tag in tags:
        context.diagnostics.report("urdf.gazebo-reference", message, tag.span, fix=hint)


def _in_document_order(plugins: tuple[PluginTag, ...]) -> tuple[PluginTag, ...]:
    return tuple(sorted(plugins, key=lambda plugin: (plugin.span.line, plugin.span.column)))


_LINK_HANDLERS: dict[str, Callable[[Link, Tag, ReadContext], Link]] = {
    "dampingFactor": _damping_factor,
    "gravity": _gravity,
    "kinematic": _kinematic,
    "light": _light,
    "selfCollide": _self_collide,
    "self_collide": _self_collide,
    "sensor": _link_sensor,
    "slip": _slip,
    "slip1": _slip,
    "slip2": _slip,
    "turnGravityOff": _turn_gravity_off,
    "velocity_decay": _velocity_decay,
}
_PHYSICS_HANDLERS: dict[str, Callable[[Joint, Tag, ReadContext], Joint]] = {
    "cfm": _number("cfm"),
    "cfm_damping": _flag("implicit_spring_damper"),
    "erp": _number("erp"),
    "implicit_spring_damper": _flag("implicit_spring_damper"),
    "provide_feedback": _flag("provide_feedback"),
}
_LIMIT_HANDLERS = {"cfm": _number("limit_cfm"), "erp": _number("limit_erp")}
_JOINT_HANDLERS: dict[str, Callable[[Joint, Tag, ReadContext], Joint]] = {
    "cfmDamping": _flag("implicit_spring_damper"),
    "disableFixedJointLumping": _keep_fixed,
    "fudgeFactor": _fudge_factor,
    "implicitSpringDamper": _flag("implicit_spring_damper"),
    "physics": _physics,
    "preserveFixedJoint": _keep_fixed,
    "provideFeedback": _flag("provide_feedback"),
    "sensor": _joint_sensor,
    "springReference": _spring("spring_reference"),
    "springStiffness": _spring("spring_stiffness"),
    "stopCfm": _number("limit_cfm"),
    "stopErp": _number("limit_erp"),
}
