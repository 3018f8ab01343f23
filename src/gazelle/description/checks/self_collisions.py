"""Collisions of one model that start inside each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.description.checks.shape_volumes import Outline, Outlines
from gazelle.description.forward_kinematics import fixed_heads
from gazelle.description.model import Link, Model, Shape, Solid
from gazelle.diagnostics import Diagnostics

__all__ = ["check_overlaps", "overlap_m"]

_TOLERATED_M = 0.001
_ROUNDS = 64

Array = NDArray[np.float64]


def check_overlaps(model: Model, outlines: Outlines, diagnostics: Diagnostics) -> None:
    """Report overlaps of links that collide with each other: those with self_collide.

    Meshes are left out: their hulls say little about them.
    """
    bodies = fixed_heads(model)
    joined = {
        frozenset((bodies.get(joint.parent, ""), bodies.get(joint.child, "")))
        for joint in model.joints
    }
    told = set[tuple[str, str]]()
    for first, second in _near_pairs(_colliding(model, outlines)):
        names = first.link.name, second.link.name
        pair = frozenset(bodies[name] for name in names)
        # The two ends of a joint never collide.
        if len(pair) < 2 or names in told or pair in joined:
            continue
        depth = overlap_m(first.points_m, second.points_m)
        if depth > _TOLERATED_M:
            told.add(names)
            text = (
                f"with all joints at 0 the collisions of '{names[0]}' and '{names[1]}' overlap by "
                f"{depth * 1e3:.3g} mm, and <self_collide> lets them push each other: the robot "
                "jitters or jumps when it is spawned"
            )
            span = second.collision.span if second.collision else None
            diagnostics.report("robot.self-overlap", text, span or second.link.span)


def overlap_m(first: Array, second: Array) -> float:
    """Return how deep two convex bodies, given by points (n, 3), are inside each other; 0 if not.

    Gilbert's algorithm decides whether there is a gap. The depth is the smallest of a few hundred
    directions, so it is an upper bound.
    """
    nearest = first.mean(axis=0) - second.mean(axis=0)
    for _ in range(_ROUNDS):
        length = float(np.linalg.norm(nearest))
        if length < 1e-6:
            break
        corner = first[(first @ nearest).argmin()] - second[(second @ nearest).argmax()]
        if float(corner @ nearest) > 0.0:
            return 0.0
        step = nearest - corner
        share = float(nearest @ step) / max(float(step @ step), 1e-18)
        nearest = nearest - min(1.0, max(0.0, share)) * step
    directions = _directions()
    reach = (first @ directions.T).max(axis=0) - (second @ directions.T).min(axis=0)
    return max(0.0, float(reach.min()))


def _directions() -> Array:
    """Return unit vectors spread evenly over the sphere, and the axes."""
    count = 400
    index = np.arange(count) + 0.5
    z = 1.0 - 2.0 * index / count
    angle = np.pi * (1.0 + 5.0**0.5) * index
    ring = np.sqrt(1.0 - z * z)
    spread = np.stack([ring * np.cos(angle), ring * np.sin(angle), z], axis=1)
    return np.concatenate([spread, np.eye(3), -np.eye(3)])


def _colliding(model: Model, outlines: Outlines) -> list[Outline]:
    return [
        item
        for item in outlines.collisions
        if item.collision is not None
        and _is_convex(item.collision.shape)
        and _self_collides(item.link, model)
    ]


def _is_convex(shape: Shape) -> bool:
    return isinstance(shape, Solid) and shape.is_convex


def _near_pairs(items: Sequence[Outline]) -> Iterator[tuple[Outline, Outline]]:
    """Yield the pairs whose bounding boxes overlap."""
    if len(items) < 2:
        return
    lows = np.array([item.low_m for item in items])
    highs = np.array([item.high_m for item in items])
    for index, item in enumerate(items[:-1]):
        rest = slice(index + 1, None)
        near = (lows[rest] <= highs[index]).all(axis=1) & (highs[rest] >= lows[index]).all(axis=1)
        for other in np.flatnonzero(near):
            yield item, items[index + 1 + int(other)]


def _self_collides(link: Link, model: Model) -> bool:
    return model.self_collide if link.self_collide is None else link.self_collide
