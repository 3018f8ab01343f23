"""Words of Gazebo's solver that have no meaning in this one: told once for all who use them."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.description.model import Joint, Surface, World
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.engine.scoped_names import scoped

__all__ = ["report_ignored_parameters"]

_SURFACE_WORDS = {
    "min_depth_m": "minDepth",
    "soft_cfm": "soft_cfm",
    "soft_erp": "soft_erp",
}
_JOINT_WORDS = {
    "cfm": "cfm",
    "erp": "erp",
    "limit_cfm": "limit cfm (stopCfm)",
    "limit_erp": "limit erp (stopErp)",
}
_Use = tuple[str, SourceSpan | None]


def report_ignored_parameters(world: World, diagnostics: Diagnostics) -> None:
    """Report contact and joint parameters that are set and change nothing."""
    collisions: dict[str, list[_Use]] = {}
    joints: dict[str, list[_Use]] = {}
    for model in world.models:
        for link in model.links:
            for collision in link.collisions:
                name = f"{scoped(model.name, link.name)}::{collision.name}"
                span = collision.surface.span or collision.span
                _note(collision.surface, _SURFACE_WORDS, (name, span), collisions)
        for joint in model.joints:
            _note(joint, _JOINT_WORDS, (scoped(model.name, joint.name), joint.span), joints)
    _report("engine.idle-contact-word", "collision", collisions, diagnostics)
    _report("engine.idle-joint-word", "joint", joints, diagnostics)


def _note(
    value: Surface | Joint, words: dict[str, str], use: _Use, into: dict[str, list[_Use]]
) -> None:
    for field, word in words.items():
        if getattr(value, field) is not None:
            into.setdefault(word, []).append(use)


def _report(code: str, kind: str, uses: dict[str, list[_Use]], diagnostics: Diagnostics) -> None:
    """Report each group of words that the same things use, at the first of them."""
    groups: dict[tuple[_Use, ...], list[str]] = {}
    for word, users in uses.items():
        groups.setdefault(tuple(users), []).append(word)
    for group, words in groups.items():
        verb = "has" if len(words) == 1 else "have"
        message = f"{', '.join(words)} of {_named(kind, group)} {verb} no effect"
        diagnostics.report(code, message, group[0][1])


def _named(kind: str, users: Iterable[_Use]) -> str:
    first, *others = (name for name, _ in users)
    return f"{kind} '{first}'" + (f" and {len(others)} more" if others else "")
