"""The names an SRDF may use, and what is told about others."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from gazelle.description.model import Joint, Model
from gazelle.description.xml import Tag, attribute_span
from gazelle.diagnostics import Diagnostics, did_you_mean

__all__ = ["Names", "link_names"]

_WORLD = "world"

_PHRASES = {
    "link": "Link '{}' is not known to URDF",
    "joint": "Joint '{}' is not known to the URDF",
    "group": "Group '{}' is not known",
}


def link_names(robot: Model) -> list[str]:
    """Return a robot's links; a root link ``world``, which models have not, is one in MoveIt."""
    names = [link.name for link in robot.links]
    is_root = _WORLD not in names and any(joint.parent == _WORLD for joint in robot.joints)
    return [_WORLD, *names] if is_root else names


@dataclass(frozen=True, slots=True)
class Names:
    """Links and joints of the robot; without a robot every name is taken as it is.

    Attributes:
        robot: the robot, None when only the SRDF is at hand.
        virtual: names of the virtual joints.
        groups: names of the groups.
        diagnostics: receives what is wrong.
    """

    robot: Model | None
    virtual: frozenset[str]
    groups: frozenset[str]
    diagnostics: Diagnostics

    @property
    def joints(self) -> dict[str, Joint]:
        """The robot's joints by name."""
        return {joint.name: joint for joint in self.robot.joints} if self.robot else {}

    def required(self, tag: Tag, attribute: str) -> str:
        """Return an attribute's text, trimmed; empty (reported) when it is missing."""
        text = tag.attributes.get(attribute, "").strip()
        if not text:
            message = f"<{tag.name}> has no '{attribute}' and is left out"
            fix = did_you_mean(attribute, tag.attributes)
            self.diagnostics.report("srdf.missing-attribute", message, tag.span, fix=fix)
        return text

    def link(self, tag: Tag, attribute: str) -> str:
        """Return the link that an attribute names; empty (reported) when there is none."""
        known = link_names(self.robot) if self.robot else None
        return self._known(tag, attribute, "link", known)

    def joint(self, tag: Tag, attribute: str) -> str:
        """Return the joint, virtual ones included; empty (reported) when there is none."""
        known = [*self.joints, *sorted(self.virtual)] if self.robot else None
        return self._known(tag, attribute, "joint", known)

    def group(self, tag: Tag, attribute: str) -> str:
        """Return the group that an attribute names; empty (reported) when there is none."""
        return self._known(tag, attribute, "group", sorted(self.groups))

    def _known(self, tag: Tag, attribute: str, kind: str, known: Collection[str] | None) -> str:
        name = self.required(tag, attribute)
        if not name or known is None or name in known:
            return name
        owner = "the SRDF" if kind == "group" else "the robot"
        text = f"<{tag.name} {attribute}=\"{name}\">: {owner} has no {kind} '{name}'"
        text += f" ({_PHRASES[kind].format(name)}); it is left out, as MoveIt does"
        fix = did_you_mean(name, known) or f"there are: {', '.join(known) or 'none'}"
        span = attribute_span(tag.span, attribute)
        self.diagnostics.report("parameters.srdf-name", text, span, fix=fix)
        return ""
