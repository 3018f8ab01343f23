"""Poses of things inside a model, once the model's frames are known."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from itertools import count

from gazelle.description.context import ReadContext
from gazelle.description.sdf.frames import FrameGraph, FramePoint
from gazelle.description.sdf.poses import pose_of, relative_to_of
from gazelle.description.sdf.values import name_of
from gazelle.description.xml import Tag
from gazelle.geometry import Pose

__all__ = ["PoseResolver", "named_children"]

_SHAPES = frozenset({"collision", "visual"})


@dataclass(frozen=True, slots=True)
class PoseResolver:
    """A model's frames together with where problems are reported."""

    context: ReadContext
    frames: FrameGraph

    def in_link(self, tag: Tag, link: str) -> Pose:
        """Return the pose of a link's child (collision, visual, sensor, light) in the link."""
        written, relative_to = pose_of(tag, self.context), relative_to_of(tag)
        if relative_to in ("", link):
            return written
        user = FramePoint(
            tag.name, tag.attributes.get("name", ""), relative_to, written, "", tag.span
        )
        T_model_thing = self.frames.placed(written, relative_to, default=link, user=user)
        return self.frames.pose(link).inverse() @ T_model_thing

    def named(self, tag: Tag, kind: str) -> tuple[Tag, ...]:
        """Return the children of this kind that have a name of their own; report the others."""
        return named_children(tag, kind, self.context)


def named_children(tag: Tag, kind: str, context: ReadContext) -> tuple[Tag, ...]:
    """Return the children of a kind by unique name; nameless and repeated ones are reported.

    Nobody refers to shapes but sensors, so Gazebo loads both of one name; here the second one
    gets a name of its own. Of all else the first one counts.
    """
    found: dict[str, Tag] = {}
    for child in tag.find_all(kind):
        name = name_of(child, context)
        if not name:
            continue
        if name in found:
            other = _free_name(name, found) if kind in _SHAPES else ""
            effect = f"becomes '{other}'" if other else "is left out"
            owner = tag.attributes.get("name", "")
            message = (
                f"{kind} with name '{name}' stands twice in {tag.name} '{owner}' (first in line "
                f"{found[name].span.line}); the second one {effect}"
            )
            context.diagnostics.report("sdf.duplicate-name", message, child.span)
            if other:
                found[other] = replace(child, attributes={**child.attributes, "name": other})
            continue
        found[name] = child
    return tuple(found.values())


def _free_name(name: str, taken: Collection[str]) -> str:
    return next(free for number in count(1) if (free := f"{name}_{number}") not in taken)
