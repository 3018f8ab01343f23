"""Gazebo Classic's ``<population>``: many copies of one model."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import child_float, child_int, child_vector3
from gazelle.description.sdf_reader.models import ModelParts, included_model, read_model
from gazelle.description.sdf_reader.poses import pose_of
from gazelle.description.xml import Tag
from gazelle.geometry import Pose, Vector3

__all__ = ["populated"]

_AXES = {"linear-x": 0, "linear-y": 1, "linear-z": 2}
_SPREADS = ("random", "uniform", "grid", *_AXES)
_SEED = 0
_GOLDEN_ANGLE_RAD = math.pi * (3.0 - math.sqrt(5.0))


def populated(tag: Tag, context: ReadContext) -> tuple[ModelParts, ...]:
    """Return the copies of a ``<population>``, named ``<model>_clone_<number>`` as in Gazebo.

    Grids and rows stand where Gazebo puts them (`Population.cc`). ``random`` draws from a fixed
    seed, so that every run has the same world; ``uniform`` spreads evenly without Gazebo's
    random clustering.
    """
    model, include = tag.find("model"), tag.find("include")
    parts = read_model(model, context) if model is not None else None
    if include is not None and parts is None:
        parts = included_model(include, context)
    if parts is None:
        if model is None and include is None:
            message = "<population> has no <model>; it is left out"
            context.diagnostics.report("xml.missing-tag", message, tag.span)
        return ()
    T_world_region = pose_of(tag, context)
    return tuple(
        replace(
            parts,
            model=replace(parts.model, name=f"{parts.model.name}_clone_{number}"),
            pose=Pose((T_world_region @ Pose(offset)).position_m),
            relative_to="",
        )
        for number, offset in enumerate(_offsets(tag, context))
    )


def _offsets(tag: Tag, context: ReadContext) -> list[Vector3]:
    """Return the places of the copies relative to the region's centre."""
    distribution = tag.find("distribution")
    spread = distribution.text_of("type", default="random") if distribution else "random"
    if spread == "grid" and distribution is not None:
        return list(_grid(distribution, context))
    count = child_int(tag, "model_count", 1, context)
    if spread not in _SPREADS or count < 1:
        wrong = f"distribution '{spread}'" if count >= 1 else f"model_count {count}"
        message = f"<population> has the impossible {wrong}; it is left out"
        context.diagnostics.report(
            "sdf.bad-value", message, tag.span, fix="distributions are " + ", ".join(_SPREADS)
        )
        return []
    cylinder = tag.find("cylinder")
    if cylinder is not None:
        return _in_cylinder(cylinder, count, context, evenly=spread == "uniform")
    box = tag.find("box") or tag
    size = child_vector3(box, "size", (1.0, 1.0, 1.0), context)
    if spread in _AXES:
        return [_in_row(size, _AXES[spread], number / count) for number in range(count)]
    if spread == "uniform":
        return _evenly_in_box(size, count)
    return _points((np.random.default_rng(_SEED).random((count, 3)) - 0.5) * size)


def _grid(tag: Tag, context: ReadContext) -> Iterator[Vector3]:
    rows, columns = child_int(tag, "rows", 1, context), child_int(tag, "cols", 1, context)
    step = child_vector3(tag, "step", (1.0, 1.0, 1.0), context)
    for row in range(rows):
        for column in range(columns):
            yield (
                step[0] * (column - (columns - 1) / 2),
                step[1] * (row - (rows - 1) / 2),
                0.0,
            )


def _in_row(size: Vector3, axis: int, fraction: float) -> Vector3:
    """Return a place along one axis of the box, from its low side on, as Gazebo's rows run."""
    position_m = [0.0, 0.0, 0.0]
    position_m[axis] = size[axis] * (fraction - 0.5)
    return (position_m[0], position_m[1], position_m[2])


def _evenly_in_box(size: Vector3, count: int) -> list[Vector3]:
    """Return cell centres of the coarsest grid with at least `count` cells, floor by floor."""
    columns = max(1, math.ceil(math.sqrt(count * size[0] / size[1]))) if size[1] > 0 else count
    rows = math.ceil(count / columns)
    return [
        (
            size[0] * ((number % columns + 0.5) / columns - 0.5),
            size[1] * ((number // columns + 0.5) / rows - 0.5),
            0.0,
        )
        for number in range(count)
    ]


def _in_cylinder(tag: Tag, count: int, context: ReadContext, *, evenly: bool) -> list[Vector3]:
    radius_m = child_float(tag, "radius", 1.0, context)
    length_m = child_float(tag, "length", 1.0, context)
    if evenly:
        # A sunflower's spiral fills a disc evenly for any count (Vogel 1979).
        number = np.arange(count) + 0.5
        angle, reach = number * _GOLDEN_ANGLE_RAD, radius_m * np.sqrt(number / count)
        height = np.zeros(count)
    else:
        draw = np.random.default_rng(_SEED).random((3, count))
        angle, reach = draw[0] * 2 * np.pi, draw[1] * radius_m
        height = (draw[2] - 0.5) * length_m
    return _points(np.stack([reach * np.cos(angle), reach * np.sin(angle), height], axis=1))


def _points(values: NDArray[np.float64]) -> list[Vector3]:
    return [(float(x), float(y), float(z)) for x, y, z in values]
