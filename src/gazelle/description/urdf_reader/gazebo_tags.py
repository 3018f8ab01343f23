"""What ``<gazebo>`` without a reference says about the whole robot, and its plug-ins."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from gazelle.description.model import Joint, Link, Model, PluginTag
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.plugins import read_plugin
from gazelle.description.urdf_reader.contact_sensors import with_watched_collisions
from gazelle.description.urdf_reader.gazebo_insertions import INSERTED_WORDS
from gazelle.description.urdf_reader.gazebo_joints import apply_to_joint
from gazelle.description.urdf_reader.gazebo_links import apply_to_link
from gazelle.description.urdf_reader.gazebo_values import (
    blocks_by_reference,
    bool_value,
    report_unknown,
)
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean

__all__ = ["apply_gazebo"]

_MODEL_WORDS = ("allow_auto_disable", "plugin", "self_collide", "static")
_WITHOUT_EFFECT = ("canonicalBody", "enable_wind")
_OLD_PREFIX = "controller:"
_WORLD = "world"


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
            links[reference] = apply_to_link(links[reference], tags, context)
        elif reference in joints:
            joints[reference] = apply_to_joint(joints[reference], tags, context)
        elif reference:
            _report_reference(reference, tags, links, joints, context)
    model = replace(model, links=tuple(links.values()), joints=tuple(joints.values()))
    model = with_watched_collisions(model, robot)
    for block in blocks.get("", ()):
        for tag in block.children:
            model = _apply_model_word(model, tag, context)
    plugins = tuple(
        read_plugin(tag, reference=reference)
        for reference, tags in blocks.items()
        for block in tags
        for tag in block.find_all("plugin")
    )
    return replace(model, plugins=_in_document_order(plugins + model.plugins))


def _apply_model_word(model: Model, tag: Tag, context: ReadContext) -> Model:
    if tag.name == "static":
        return replace(model, static=bool_value(tag, False, context))
    if tag.name == "self_collide":
        return replace(model, self_collide=bool_value(tag, False, context))
    if tag.name == "allow_auto_disable":
        return replace(model, allow_auto_disable=bool_value(tag, True, context))
    if tag.name.startswith(_OLD_PREFIX):
        return replace(model, plugins=(*model.plugins, _old_controller(tag, context)))
    if tag.name in _WITHOUT_EFFECT:
        message = f"<{tag.name}> for the whole robot has no effect"
        context.diagnostics.report("urdf.gazebo-no-effect", message, tag.span)
    elif tag.name not in (*_MODEL_WORDS, *INSERTED_WORDS):
        known = (*_MODEL_WORDS, *INSERTED_WORDS, *_WITHOUT_EFFECT)
        report_unknown(tag, "the whole robot", known, context)
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
