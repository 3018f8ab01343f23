"""Which collisions may touch, as MuJoCo's contype and conaffinity bits.

Gazebo's rules: links of one model collide only when both say ``self_collide`` (or their model
does); links joined by a joint never do; two collisions touch when the and of their
``collide_bitmask`` is not 0. MuJoCo has 32 bits, so every *kind* of collision (model and mask)
takes one bit and lists the kinds it touches; beyond 32 kinds models share a kind and their own
links are excluded pair by pair.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

__all__ = ["EVERY_MASK", "CollisionKind", "Group", "assign_groups", "may_touch"]

EVERY_MASK = 0xFFFF
_BITS = 32
_SIGN_BIT = 1 << 31


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
