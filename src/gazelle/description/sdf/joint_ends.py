"""The links that a joint connects."""

from __future__ import annotations

from gazelle.description.model import Joint
from gazelle.description.sdf.frames import WORLD_FRAME, FramePoint
from gazelle.description.sdf.joints import joint_type_of, read_joint
from gazelle.description.sdf.resolving import PoseResolver
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean

__all__ = ["JointEnds"]


class JointEnds:
    """Finds the links that joints of one scope connect."""

    def __init__(self, resolver: PoseResolver, scope: str) -> None:
        self._resolver = resolver
        self._scope = scope

    def joint(self, tag: Tag, point: FramePoint) -> Joint | None:
        """Return a joint; None (reported) when its type or one of its ends is not usable."""
        kind = joint_type_of(tag, self._resolver.context)
        parent, child = self._end(tag, "parent"), self._end(tag, "child")
        if kind is None or not parent or not child or self._is_loop(tag, parent, child):
            return None
        return read_joint(tag, kind, parent, child, point, self._resolver)

    def _is_loop(self, tag: Tag, parent: str, child: str) -> bool:
        if parent != child:
            return False
        name = tag.attributes.get("name", "")
        message = f"joint '{name}' joins '{parent}' to itself; it is left out"
        self._resolver.context.diagnostics.report("sdf.bad-joint", message, tag.span)
        return True

    def _end(self, tag: Tag, end: str) -> str:
        """Return the link at one end, ``world`` for the world, empty when there is none."""
        diagnostics, frames = self._resolver.context.diagnostics, self._resolver.frames
        found, name = tag.find(end), tag.attributes.get("name", "")
        wanted = found.text if found is not None else ""
        if not wanted:
            message = f"joint '{name}' names no <{end}>; it is left out"
            diagnostics.report("xml.missing-tag", message, tag.span)
            return ""
        if wanted == WORLD_FRAME and end == "parent":
            return WORLD_FRAME
        link = frames.attached_link(wanted) if wanted in frames else ""
        if not link or link == WORLD_FRAME:
            message = (
                f"{end} frame with name '{wanted}' specified by joint with name '{name}' not "
                f"found in {self._scope}; the joint is left out"
            )
            place = found if found is not None else tag
            fix = did_you_mean(wanted, frames.names)
            diagnostics.report("sdf.bad-joint", message, place.span, fix=fix)
            return ""
        return link
