"""Robots, models and worlds: a picture, and the tree of links and joints."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gazelle.errors import GazelleError
from gazelle.notebook.html_parts import figure, picture_tag, png_of, png_text, table, tree
from gazelle.rich_display import Bundle

if TYPE_CHECKING:
    from gazelle.description.model import Model, World
    from gazelle.simulator import Simulation
    from gazelle.simulator.simulation_handles import SimControllers, SimModel

__all__ = [
    "controllers_bundle",
    "drawn",
    "model_bundle",
    "model_lines",
    "posed_world",
    "sim_model_bundle",
    "simulation_bundle",
    "world_bundle",
]

_SIZE_PX = (480, 320)


def model_bundle(model: Model) -> Bundle:
    """Return a robot as its file has it."""
    from gazelle.description.model import World

    return _bundle(World(models=(model,)), _model_caption(model), tree(model_lines(model)))


def world_bundle(world: World) -> Bundle:
    """Return a world as its file has it."""
    rows = [
        (one.name, "stands" if one.static else "moves", len(one.links), len(one.joints))
        for one in world.models
    ]
    caption = f"world '{world.name}': {len(world.models)} models, {len(world.lights)} lights"
    return _bundle(world, caption, table(("model", "", "links", "joints"), rows))


def simulation_bundle(sim: Simulation) -> Bundle:
    """Return a simulation as it stands."""
    world = sim.world
    rows = [
        (one.name, "stands" if one.static else "moves", len(one.links), len(one.joints))
        for one in world.models
    ]
    caption = f"{sim.time_s:.3f} s simulated; sim.view() shows it live"
    below = table(("model", "", "links", "joints"), rows)
    return _bundle(posed_world(sim), caption, below)


def sim_model_bundle(model: SimModel) -> Bundle:
    """Return a model's tree and where it stands."""
    x, y, z = model.pose.position_m
    caption = f"{_model_caption(model.description)}; at x {x:.3f}, y {y:.3f}, z {z:.3f} m"
    return {"text/html": figure(tree(model_lines(model.description)), caption)}


def controllers_bundle(controllers: SimControllers) -> Bundle:
    """Return the loaded controllers."""
    rows = [
        (name, record.type, record.state.value) for name, record in controllers.controllers.items()
    ]
    shown = table(("controller", "type", "state"), rows)
    return {"text/html": figure(shown, f"controller manager {controllers.namespace or '/'}")}


def posed_world(sim: Simulation) -> World:
    """Return the description of a simulation's world with everything where it is now."""
    from dataclasses import replace

    from gazelle.geometry import IDENTITY_POSE, Pose

    snapshot = sim.server.engine.snapshot()
    poses = {
        name: Pose((row[0], row[1], row[2]), (row[3], row[4], row[5], row[6]))
        for name, row in zip(snapshot.link_names, snapshot.T.tolist(), strict=True)
    }
    world = sim.world

    def placed(model: Model) -> Model:
        if not any(f"{model.name}::{link.name}" in poses for link in model.links):
            return model
        T_world_model = model.T_world_model
        links = tuple(
            replace(
                link,
                T_model_link=poses.get(
                    f"{model.name}::{link.name}", T_world_model @ link.T_model_link
                ),
            )
            for link in model.links
        )
        return replace(model, T_world_model=IDENTITY_POSE, links=links)

    return replace(world, models=tuple(map(placed, world.models)))


def model_lines(model: Model) -> Iterator[tuple[int, str, str]]:
    """Yield depth, link and joint of a model's tree, from its roots on; loops are cut."""
    children: dict[str, list[Any]] = {}
    for joint in model.joints:
        children.setdefault(joint.parent, []).append(joint)
    below = {joint.child for joint in model.joints}
    seen: set[str] = set()
    waiting = [(0, link.name, "") for link in reversed(model.links) if link.name not in below]
    while waiting:
        depth, name, remark = waiting.pop()
        yield depth, name, remark
        if name in seen:
            continue
        seen.add(name)
        for joint in reversed(children.get(name, [])):
            waiting.append((depth + 1, joint.child, f"{joint.name} ({joint.type.value})"))


def _bundle(world: World, caption: str, below: str) -> Bundle:
    data = drawn(world, _SIZE_PX)
    picture = picture_tag(data, caption) if data else ""
    bundle: Bundle = {"text/html": figure(picture + below, caption)}
    return {**bundle, "image/png": png_text(data)} if data else bundle


def drawn(world: World, size_px: tuple[int, int]) -> bytes:
    """Return the PNG of a world as it stands; empty where it cannot be drawn."""
    from gazelle.diagnostics import Diagnostics
    from gazelle.sensors import warm_up
    from gazelle.sensors.view_image import take_picture

    try:
        warm_up(lambda text: print(text, file=sys.stderr))  # noqa: T201 - below the cell
        picture = take_picture(world, size_px=size_px, diagnostics=Diagnostics())
    except (GazelleError, ValueError):
        return b""
    return png_of(picture.rgb)


def _model_caption(model: Model) -> str:
    moving = sum(joint.axis is not None for joint in model.joints)
    return f"'{model.name}': {len(model.links)} links, {moving} joints that move"
