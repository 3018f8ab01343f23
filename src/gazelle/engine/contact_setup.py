"""Who touches whom and how: bits, priorities and explicit pairs of the MuJoCo spec.

MuJoCo takes the larger friction of two geoms, Gazebo the smaller. MuJoCo also knows priorities:
the geom with the higher one decides alone. So the smaller a geom's friction the higher its
priority, which gives exactly the smaller of the two at no cost. Only pairs that this cannot
express (resolved springs, bounce, spin or rolling friction, direction-dependent friction) become
explicit MuJoCo pairs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import Any

from gazelle.description.model import Plane
from gazelle.diagnostics import Diagnostics
from gazelle.engine.bodies import BuiltGeom, SpecBuilder
from gazelle.engine.collision_groups import (
    EVERY_MASK,
    CollisionKind,
    assign_groups,
    may_touch,
)
from gazelle.engine.surfaces import (
    HARD_SOLIMP,
    MIN_MU,
    RESOLVED,
    PairSurface,
    combine,
    contact_spring,
    hard_spring,
    is_plain,
    surface_key,
)
from gazelle.engine.tree import KinematicTree

__all__ = ["ExplicitPair", "apply_pair_springs", "set_up_contacts"]

_UNREACHABLE_M = 1e6
_MOST_PAIRS = 20000
_MOST_PLAIN_PAIRS = 400


@dataclass(frozen=True, slots=True)
class ExplicitPair:
    """A geom pair whose contact priorities cannot express.

    Attributes:
        name: of MuJoCo's pair.
        surface: the combined surface.
    """

    name: str
    surface: PairSurface


def set_up_contacts(builder: SpecBuilder) -> tuple[ExplicitPair, ...]:
    """Set bits, priorities, springs, excludes and explicit pairs of everything built."""
    geoms = builder.geoms
    kinds = [_kind(geom) for geom in geoms]
    groups, crowded = assign_groups(kinds)
    ranks = _priorities(geoms)
    spring = hard_spring(builder.step_s)
    for geom, kind in zip(geoms, kinds, strict=True):
        element = geom.element
        element.contype, element.conaffinity = groups[kind].contype, groups[kind].conaffinity
        mu = _smallest_mu(geom)
        element.priority = ranks[mu]
        element.condim = 3 if mu > MIN_MU else 1
        element.friction = [max(mu, MIN_MU), 0.0, 0.0]
        element.solref, element.solimp = list(spring.solref), list(HARD_SOLIMP)
        if geom.collision.surface.collide_without_contact:
            element.margin, element.gap = -_UNREACHABLE_M, _UNREACHABLE_M
        _report_unmapped(geom, builder.diagnostics)
    _exclude(builder, crowded)
    return _explicit_pairs(builder, kinds)


def apply_pair_springs(
    model: Any, pairs: Sequence[ExplicitPair], ids: Sequence[int], step_s: float
) -> None:
    """Write the springs of explicit pairs, now that the effective masses are known."""
    for pair, index in zip(pairs, ids, strict=True):
        bodies = model.geom_bodyid[[model.pair_geom1[index], model.pair_geom2[index]]]
        inverse_mass = float(model.body_invweight0[bodies, 0].sum())
        spring = contact_spring(pair.surface, inverse_mass, step_s)
        model.pair_solref[index] = spring.solref
        model.pair_solreffriction[index] = spring.solreffriction
        model.pair_solimp[index] = spring.solimp


def _kind(geom: BuiltGeom) -> CollisionKind:
    mask = geom.collision.surface.collide_bitmask
    mask = EVERY_MASK if mask is None else mask
    own = geom.link.self_collide
    touches_itself = geom.model.self_collide if own is None else own
    alone = len(geom.model.links) == 1 or touches_itself
    return CollisionKind("" if alone else geom.model.name, mask)


def _smallest_mu(geom: BuiltGeom) -> float:
    surface = geom.collision.surface
    pair = combine(surface, surface)
    return min(pair.mu1, pair.mu2)


def _priorities(geoms: Sequence[BuiltGeom]) -> dict[float, int]:
    """Rank friction coefficients: the smaller the higher."""
    ordered = sorted({_smallest_mu(geom) for geom in geoms}, reverse=True)
    return {mu: rank for rank, mu in enumerate(ordered)}


def _exclude(builder: SpecBuilder, crowded: frozenset[str]) -> None:
    """Exclude body pairs: joined by a loop joint, or of families that share bits."""
    for model_name, tree in builder.trees.items():
        excluded = {tuple(sorted((loop.parent, loop.child))) for loop in tree.loops}
        excluded |= _joined(tree)
        if model_name in crowded:
            names = [entry.link.name for entry in tree.links]
            excluded |= {
                tuple(sorted(pair))
                for pair in combinations_with_replacement(names, 2)
                if pair[0] != pair[1]
            }
        known = {entry.link.name for entry in tree.links}
        for first, second in sorted(excluded):
            if first in known and second in known and first != second:
                builder.spec.add_exclude(
                    bodyname1=f"{model_name}::{first}", bodyname2=f"{model_name}::{second}"
                )


def _joined(tree: KinematicTree) -> set[tuple[str, ...]]:
    """Links that a joint joins: Gazebo never lets them touch."""
    return {
        tuple(sorted((entry.parent, entry.link.name)))
        for entry in tree.links
        if entry.parent is not None
    }


def _explicit_pairs(
    builder: SpecBuilder, kinds: Sequence[CollisionKind]
) -> tuple[ExplicitPair, ...]:
    """Add the pairs that priorities cannot express, then plain ones while there are few.

    A pair has its own sliding rate, a geom has not, so plain pairs slide more evenly; but every
    pair costs some nanoseconds in every step. Pairs with the ground come first and always.
    """
    special: list[tuple[int, int, PairSurface]] = []
    plain: list[tuple[int, int, PairSurface]] = []
    for a, b, surface, is_special in _candidates(builder, kinds):
        (special if is_special else plain).append((a, b, surface))
    on_ground = [item for item in plain if _is_plane(builder, item)]
    if len(plain) > _MOST_PLAIN_PAIRS:
        plain = on_ground
    chosen = (special + plain)[:_MOST_PAIRS]
    geoms = builder.geoms
    return tuple(
        _add_pair(builder.spec, geoms[a], geoms[b], surface, number)
        for number, (a, b, surface) in enumerate(chosen)
    )


def _candidates(
    builder: SpecBuilder, kinds: Sequence[CollisionKind]
) -> Iterator[tuple[int, int, PairSurface, bool]]:
    geoms = builder.geoms
    classes: dict[tuple[object, ...], list[int]] = {}
    for index, geom in enumerate(geoms):
        key = (geom.static, geom.heaviest_kg, *surface_key(geom.collision.surface))
        classes.setdefault(key, []).append(index)
    for first, second in combinations_with_replacement(list(classes.values()), 2):
        one, other = geoms[first[0]], geoms[second[0]]
        if one.static and other.static:
            continue
        surface = combine(one.collision.surface, other.collision.surface)
        special = _is_special(one, other, surface, builder.step_s)
        for a, b in _index_pairs(first, second):
            if _plausible(builder, kinds, a, b):
                yield a, b, surface, special


def _is_plane(builder: SpecBuilder, item: tuple[int, int, PairSurface]) -> bool:
    shapes = (builder.geoms[index].collision.shape for index in item[:2])
    return any(isinstance(shape, Plane) for shape in shapes)


def _index_pairs(first: list[int], second: list[int]) -> list[tuple[int, int]]:
    if first is second:
        return [(a, b) for i, a in enumerate(first) for b in first[i + 1 :]]
    return [(a, b) for a in first for b in second]


def _is_special(a: BuiltGeom, b: BuiltGeom, surface: PairSurface, step_s: float) -> bool:
    """Whether priorities cannot express the combined surface."""
    inverse_mass = 1.0 / a.heaviest_kg + 1.0 / b.heaviest_kg
    hard = step_s * step_s * surface.kp * inverse_mass > RESOLVED
    return not (hard and is_plain(surface))


def _plausible(builder: SpecBuilder, kinds: Sequence[CollisionKind], a: int, b: int) -> bool:
    first, second = builder.geoms[a], builder.geoms[b]
    if first.link_name == second.link_name or (first.static and second.static):
        return False
    if first.model is second.model:
        return False
    ghosts = first.collision.surface.collide_without_contact
    ghosts = ghosts or second.collision.surface.collide_without_contact
    return not ghosts and may_touch(kinds[a], kinds[b])


def _add_pair(
    spec: Any, a: BuiltGeom, b: BuiltGeom, surface: PairSurface, number: int
) -> ExplicitPair:
    pair = spec.add_pair(name=f"pair {number}", geomname1=a.name, geomname2=b.name)
    mu1, mu2 = max(surface.mu1, MIN_MU), max(surface.mu2, MIN_MU)
    rolling = max(surface.rolling_m, MIN_MU)
    pair.friction = [mu1, mu2, max(surface.torsional_m, MIN_MU), rolling, rolling]
    pair.condim = surface.condim
    return ExplicitPair(pair.name, surface)


def _report_unmapped(geom: BuiltGeom, diagnostics: Diagnostics) -> None:
    surface = geom.collision.surface
    span = surface.span or geom.collision.span
    if surface.fdir1 is not None and surface.mu1 != surface.mu2:
        diagnostics.report(
            "engine.friction-direction",
            f"collision '{geom.collision_name}' sets fdir1; the engine cannot turn the friction"
            " directions with the body and applies mu and mu2 along its own tangents (for level"
            " ground: mu along the world's y, mu2 along x)",
            span,
        )
    if (surface.slip1 or 0.0) > 0 or (surface.slip2 or 0.0) > 0:
        diagnostics.report(
            "engine.slip",
            f"collision '{geom.collision_name}' sets slip1 {surface.slip1 or 0:g} and slip2"
            f" {surface.slip2 or 0:g}; the engine has no force-dependent slip, friction acts"
            " without it",
            span,
        )
    if surface.max_contacts is not None and 0 < surface.max_contacts < 4:
        diagnostics.report(
            "engine.max-contacts",
            f"collision '{geom.collision_name}' allows {surface.max_contacts} contact points; the"
            " engine always keeps the few points it finds (at most 4 for a box on a plane)",
            span,
        )
