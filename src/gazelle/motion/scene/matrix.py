"""Which pairs of links and objects may touch."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from gazelle.description.srdf import Srdf

__all__ = ["AllowedCollisions"]

Pair = frozenset[str]


@dataclass(frozen=True)
class AllowedCollisions:
    """MoveIt's allowed collision matrix.

    A pair's own entry counts before the defaults of its members. Of two defaults both have to
    allow; a member without a default has no say.

    Attributes:
        pairs: True for pairs that may touch, False for pairs that may not.
        defaults: the same for one member with everything else.
    """

    pairs: Mapping[Pair, bool] = field(default_factory=dict)
    defaults: Mapping[str, bool] = field(default_factory=dict)

    @classmethod
    def from_srdf(cls, srdf: Srdf) -> AllowedCollisions:
        """Return what an SRDF disables and enables; disabled pairs have the last word."""
        pairs = {frozenset((item.link1, item.link2)): False for item in srdf.enabled_pairs}
        pairs |= {frozenset((item.link1, item.link2)): True for item in srdf.disabled_pairs}
        return cls(pairs, dict.fromkeys(srdf.no_default_collisions, True))

    def allows(self, first: str, second: str) -> bool:
        """Return whether two may touch."""
        own = self.pairs.get(frozenset((first, second)))
        if own is not None:
            return own
        said = [self.defaults[name] for name in (first, second) if name in self.defaults]
        return bool(said) and all(said)

    def with_pair(self, first: str, second: str, allowed: bool) -> AllowedCollisions:
        """Return the matrix with an entry for one pair."""
        return replace(self, pairs={**self.pairs, frozenset((first, second)): allowed})

    def with_pairs(self, name: str, others: Iterable[str], allowed: bool) -> AllowedCollisions:
        """Return the matrix with entries for one member and several others."""
        new = {frozenset((name, other)): allowed for other in others if other != name}
        return replace(self, pairs={**self.pairs, **new})

    def with_default(self, name: str, allowed: bool | None) -> AllowedCollisions:
        """Return the matrix with a member's default; None takes it away."""
        defaults = {key: value for key, value in self.defaults.items() if key != name}
        if allowed is not None:
            defaults[name] = allowed
        return replace(self, defaults=defaults)

    def without(self, name: str) -> AllowedCollisions:
        """Return the matrix without any entry of a member."""
        pairs = {pair: value for pair, value in self.pairs.items() if name not in pair}
        return replace(self.with_default(name, None), pairs=pairs)
