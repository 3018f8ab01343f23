"""Gazebo's saved ``<state>``: where things stood when a world was saved."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.model import Light, Link, Model, World
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.poses import pose_of
from gazelle.description.xml import Tag

__all__ = ["with_state"]

_MAX_SHIFT_M = 1e-4


def with_state(world: World, tag: Tag, context: ReadContext) -> World:
    """Return the world with the poses that a ``<state>`` holds.

    As Gazebo Classic's World::Load, the first state counts. Poses of models and lights are taken
    over, those of links in models without joints too. Links held by joints keep their place: a
    saved joint position cannot be told from a changed description. Models that the state deletes
    are gone; those it inserts have been read already.
    """
    deleted = {item.text for item in tag.children if item.name == "deletions"}
    deleted |= {name.text for item in tag.find_all("deletions") for name in item.find_all("name")}
    models = {item.attributes.get("name", ""): item for item in tag.find_all("model")}
    lights = {item.attributes.get("name", ""): item for item in tag.find_all("light")}
    return replace(
        world,
        models=tuple(
            _placed(model, models[model.name], context) if model.name in models else model
            for model in world.models
            if model.name not in deleted
        ),
        lights=tuple(
            _placed_light(light, lights[light.name], context) if light.name in lights else light
            for light in world.lights
            if light.name not in deleted
        ),
    )


def _placed_light(light: Light, tag: Tag, context: ReadContext) -> Light:
    return replace(light, T_parent_light=pose_of(tag, context)) if tag.find("pose") else light


def _placed(model: Model, tag: Tag, context: ReadContext) -> Model:
    if tag.find("pose") is not None:
        model = replace(model, T_world_model=pose_of(tag, context))
    states = {item.attributes.get("name", ""): item for item in tag.find_all("link")}
    moved = tuple(_placed_link(link, model, states.get(link.name), context) for link in model.links)
    if moved == model.links:
        return model
    if not model.joints:
        return replace(model, links=moved)
    message = (
        f"the saved state of model '{model.name}' moves links that joints hold; "
        "they start where the description puts them"
    )
    context.diagnostics.report("sdf.state", message, tag.span)
    return model


def _placed_link(link: Link, model: Model, tag: Tag | None, context: ReadContext) -> Link:
    """Return the link at its saved pose, which is given in the world."""
    if tag is None or tag.find("pose") is None:
        return link
    T_model_link = model.T_world_model.inverse() @ pose_of(tag, context)
    shift = link.T_model_link.matrix() - T_model_link.matrix()
    if float(abs(shift).max()) < _MAX_SHIFT_M:
        return link
    return replace(link, T_model_link=T_model_link)
