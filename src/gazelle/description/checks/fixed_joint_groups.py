"""Links that fixed joints make one body."""

from __future__ import annotations

from gazelle.description.model import JointType, Model

__all__ = ["fixed_groups", "fixed_heads"]


def fixed_heads(model: Model) -> dict[str, str]:
    """Return for every link the first of those it is fixed to."""
    above = {joint.child: joint.parent for joint in model.joints if joint.type is JointType.FIXED}
    heads: dict[str, str] = {}
    for link in model.links:
        name, way = link.name, dict[str, None]()
        while name in above and name not in heads and name not in way:
            way[name] = None
            name = above[name]
        head = heads.get(name, name)
        heads[link.name] = head
        heads |= dict.fromkeys(way, head)
    return heads


def fixed_groups(model: Model) -> dict[str, tuple[str, ...]]:
    """Return the links of every body by its first link, that one included."""
    groups: dict[str, list[str]] = {}
    for name, head in fixed_heads(model).items():
        groups.setdefault(head, []).append(name)
    return {head: tuple(names) for head, names in groups.items()}
