"""Which collisions touch and how: bits, excludes, priorities and explicit pairs of the MuJoCo spec.

MuJoCo takes the larger friction of two geoms, Gazebo the smaller. MuJoCo also knows priorities:
the geom with the higher one decides alone. So the smaller a geom's friction the higher its
priority, which gives exactly the smaller of the two at no cost. Only pairs that this cannot
express (resolved springs, bounce, spin or rolling friction, direction-dependent friction) become
explicit MuJoCo pairs.

Gazebo's rules: links of one model collide only when both say ``self_collide`` (or their model
does); links joined by a joint never do; two collisions touch when the and of their
``collide_bitmask`` is not 0. MuJoCo has 32 bits, so every *kind* of collision (model and mask)
takes one bit and lists the kinds it touches; beyond 32 kinds models share a kind and their own
links are excluded pair by pair.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import Any, NamedTuple

from gazelle.description.model import Link, Model, Plane
from gazelle.diagnostics import Diagnostics
from gazelle.engine.contact_solref_solimp import HARD_SOLIMP, RESOLVED, contact_spring, hard_spring
from gazelle.engine.friction import MIN_MU, least_friction, report_friction_direction
from gazelle.engine.kinematic_tree import KinematicTree
from gazelle.engine.mjspec_builder import BuiltGeom, SpecBuilder
from gazelle.engine.scoped_names import scoped
from gazelle.engine.surface_combination import PairSurface, combine, is_plain, surface_key

__all__ = [
    "EVERY_MASK",
    "CollisionKind",
    "ExplicitPair",
    "Group",
    "apply_pair_springs",
    "assign_groups",
    "may_touch",
    "set_up_contacts",
]


EVERY_MASK = 0xFFFF
_BITS = 32
_SIGN_BIT = 1 << 31
_UNREACHABLE_M = 1e6
_MAX_PAIRS = 20000
_MAX_PLAIN_PAIRS = 400
_Candidate = tuple[int, int, PairSurface]


@dataclass(frozen=True, slots=True)
class CollisionKind:
    """What decides whether a collision touches another.

    Attributes:
        family: name of the model; empty when it has one link only, which cannot touch itself.
        mask: ``collide_bitmask``.
        touches_itself: ``self_collide`` of the link, or of its model.
    """

    family: str
    mask: int = EVERY_MASK
    touches_itself: bool = False


@dataclass(frozen=True, slots=True)
class Group:
    """MuJoCo's two bit fields of a geom."""

    contype: int
    conaffinity: int


@dataclass(frozen=True, slots=True)
class ExplicitPair:
    """A geom pair whose contact priorities cannot express.

    Attributes:
        name: of MuJoCo's pair.
        surface: the combined surface.
    """

    name: str
    surface: PairSurface


class _ClassPair(NamedTuple):
    first: list[int]
    second: list[int]
    surface: PairSurface
    is_special: bool


def set_up_contacts(builder: SpecBuilder) -> tuple[ExplicitPair, ...]:
    """Set bits, priorities, springs, excludes and explicit pairs of everything built."""
    geoms = builder.geoms
    kinds = [_kind(geom) for geom in geoms]
    groups, sharing_bits = assign_groups(kinds)
    mus = [least_friction(geom.collision.surface) for geom in geoms]
    ranks = _priorities(mus)
    spring = hard_spring(builder.step_s)
    for geom, kind, mu in zip(geoms, kinds, mus, strict=True):
        element = geom.element
        element.contype, element.conaffinity = groups[kind].contype, groups[kind].conaffinity
        element.priority = ranks[mu]
        element.condim = 3 if mu > MIN_MU else 1
        element.friction = [max(mu, MIN_MU), 0.0, 0.0]
        element.solref, element.solimp = list(spring.solref), list(HARD_SOLIMP)
        if geom.collision.surface.collide_without_contact:
            element.margin, element.gap = -_UNREACHABLE_M, _UNREACHABLE_M
        slips = geom.link_name in builder.slip_bodies
        report_friction_direction(geom.collision, geom.collision_name, builder.diagnostics)
        _report_unmapped(geom, builder.diagnostics, slips=slips)
    _exclude(builder, sharing_bits)
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


def may_touch(first: CollisionKind, second: CollisionKind) -> bool:
    """Whether Gazebo lets collisions of these kinds touch."""
    related = first.family != "" and first.family == second.family
    if related and not (first.touches_itself and second.touches_itself):
        return False
    return first.mask & second.mask != 0


def assign_groups(
    kinds: Iterable[CollisionKind],
) -> tuple[dict[CollisionKind, Group], frozenset[str]]:
    """Give every kind its bits.

    Returns:
        The bits by kind, and the families whose links must be excluded pair by pair because
        there are more kinds than bits.
    """
    ordered = sorted(set(kinds), key=_sort_key)
    if len(ordered) <= _BITS:
        return _exact(ordered), frozenset()
    shared = [CollisionKind("", kind.mask) for kind in ordered]
    groups = _exact(sorted(set(shared), key=_sort_key)[:_BITS])
    everything = Group(1, 1)
    table = {kind: groups.get(base, everything) for kind, base in zip(ordered, shared, strict=True)}
    return table, frozenset(kind.family for kind in ordered if kind.family)


def _sort_key(kind: CollisionKind) -> tuple[str, int, bool]:
    return (kind.family, kind.mask, kind.touches_itself)


def _exact(ordered: Sequence[CollisionKind]) -> dict[CollisionKind, Group]:
    groups: dict[CollisionKind, Group] = {}
    for index, kind in enumerate(ordered):
        touched = sum(
            1 << other for other, candidate in enumerate(ordered) if may_touch(kind, candidate)
        )
        groups[kind] = Group(_signed(1 << index), _signed(touched))
    return groups


def _signed(bits: int) -> int:
    """MuJoCo keeps the fields in signed 32-bit integers."""
    return bits - (1 << 32) if bits & _SIGN_BIT else bits


def _kind(geom: BuiltGeom) -> CollisionKind:
    mask = geom.collision.surface.collide_bitmask
    mask = EVERY_MASK if mask is None else mask
    if len(geom.model.links) == 1:
        return CollisionKind("", mask)
    return CollisionKind(geom.model.name, mask, _touches_itself(geom.model, geom.link))


def _touches_itself(model: Model, link: Link) -> bool:
    return model.self_collide if link.self_collide is None else link.self_collide


def _priorities(mus: Sequence[float]) -> dict[float, int]:
    """Rank friction coefficients: the smaller the higher."""
    return {mu: rank for rank, mu in enumerate(sorted(set(mus), reverse=True))}


def _exclude(builder: SpecBuilder, sharing_bits: frozenset[str]) -> None:
    """Exclude body pairs: joined by a loop joint, or of families that share bits."""
    for model_name, tree in builder.trees.items():
        excluded = {tuple(sorted((loop.parent, loop.child))) for loop in tree.loops}
        excluded |= _joined(tree)
        if model_name in sharing_bits:
            excluded |= _not_self_colliding(builder.world.model(model_name))
        known = {entry.link.name for entry in tree.links}
        for first, second in sorted(excluded):
            if first in known and second in known and first != second:
                names = [scoped(model_name, link) for link in (first, second)]
                bodies = [builder.slip_bodies.get(name, name) for name in names]
                builder.spec.add_exclude(bodyname1=bodies[0], bodyname2=bodies[1])


def _not_self_colliding(model: Model | None) -> set[tuple[str, ...]]:
    """Pairs of a model's links that do not both collide with their own model."""
    links = model.links if model is not None else ()
    return {
        tuple(sorted((first.name, second.name)))
        for index, first in enumerate(links)
        for second in links[index + 1 :]
        if model is not None
        and not (_touches_itself(model, first) and _touches_itself(model, second))
    }


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
    special: list[_Candidate] = []
    on_ground: list[_Candidate] = []
    plain: list[_ClassPair] = []
    for pair in _class_pairs(builder):
        if pair.is_special:
            special.extend(_members(builder, kinds, pair))
        elif _has_plane(builder, pair):
            on_ground.extend(_members(builder, kinds, pair))
        else:
            plain.append(pair)
    rest: list[_Candidate] = []
    if sum(len(pair.first) * len(pair.second) for pair in plain) <= 4 * _MAX_PLAIN_PAIRS:
        rest = [item for pair in plain for item in _members(builder, kinds, pair)]
    if len(on_ground) + len(rest) > _MAX_PLAIN_PAIRS:
        rest = []
    geoms = builder.geoms
    return tuple(
        _add_pair(builder.spec, geoms[a], geoms[b], surface, number)
        for number, (a, b, surface) in enumerate((special + on_ground + rest)[:_MAX_PAIRS])
    )


def _class_pairs(builder: SpecBuilder) -> Iterator[_ClassPair]:
    """Pair up classes of geoms that behave alike, resting ones not with resting ones."""
    geoms = builder.geoms
    classes: dict[tuple[object, ...], list[int]] = {}
    for index, geom in enumerate(geoms):
        plane = isinstance(geom.collision.shape, Plane)
        key = (plane, geom.static, geom.heaviest_kg, *surface_key(geom.collision.surface))
        classes.setdefault(key, []).append(index)
    for first, second in combinations_with_replacement(list(classes.values()), 2):
        one, other = geoms[first[0]], geoms[second[0]]
        if not (one.static and other.static):
            surface = combine(one.collision.surface, other.collision.surface)
            special = _is_special(one, other, surface, builder.step_s)
            yield _ClassPair(first, second, surface, special)


def _members(
    builder: SpecBuilder, kinds: Sequence[CollisionKind], pair: _ClassPair
) -> list[_Candidate]:
    return [
        (a, b, pair.surface)
        for a, b in _index_pairs(pair.first, pair.second)
        if _plausible(builder, kinds, a, b)
    ]


def _has_plane(builder: SpecBuilder, pair: _ClassPair) -> bool:
    shapes = (builder.geoms[group[0]].collision.shape for group in (pair.first, pair.second))
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


def _report_unmapped(geom: BuiltGeom, diagnostics: Diagnostics, *, slips: bool) -> None:
    surface = geom.collision.surface
    span = surface.span or geom.collision.span
    if not slips and ((surface.slip1 or 0.0) > 0 or (surface.slip2 or 0.0) > 0):
        diagnostics.report(
            "engine.slip",
            f"collision '{geom.collision_name}' sets slip1 {surface.slip1 or 0:g} and slip2"
            f" {surface.slip2 or 0:g}; the engine lets only wheels slip: cylinders"
            " and spheres on a joint that turns, with fdir1 along its axis or slip1 = slip2;"
            " friction acts without it",
            span,
        )
    if surface.max_contacts is not None and 0 < surface.max_contacts < 4:
        diagnostics.report(
            "engine.max-contacts",
            f"collision '{geom.collision_name}' allows {surface.max_contacts} contact points; the"
            " engine always keeps the few points it finds (at most 4 for a box on a plane)",
            span,
        )
