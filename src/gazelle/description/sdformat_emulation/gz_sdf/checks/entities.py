"""Worlds, models and what has a name and a place in them, as sdformat's objects hold them."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.geometry import Pose

__all__ = ["Frame", "Joint", "Link", "ModelScope", "WorldScope"]


@dataclass(slots=True)
class Link:
    """A link.

    Attributes:
        name: may differ from the element's when a document is old and names collide.
        pose: in `relative_to`, the model's frame when that is empty.
        relative_to: frame of the pose.
        inertial: its element, None when there is none.
    """

    name: str
    pose: Pose
    relative_to: str
    inertial: SdfElement | None = None


@dataclass(slots=True)
class Joint:
    """A joint; the pose is in the child's frame when `relative_to` is empty."""

    name: str
    pose: Pose
    relative_to: str
    parent: str
    child: str


@dataclass(slots=True)
class Frame:
    """A ``<frame>``."""

    name: str
    pose: Pose
    relative_to: str
    attached_to: str


@dataclass(slots=True)
class ModelScope:
    """A model with everything in it that frames can be attached to."""

    name: str
    pose: Pose
    relative_to: str
    is_static: bool
    canonical_link: str
    placement_frame: str
    links: list[Link] = field(default_factory=list)
    joints: list[Joint] = field(default_factory=list)
    frames: list[Frame] = field(default_factory=list)
    models: list[ModelScope] = field(default_factory=list)

    @property
    def has_link(self) -> bool:
        """Whether something in it can carry the model's frame."""
        return bool(self.links or self.models or self.is_static)

    def canonical(self) -> tuple[bool, str]:
        """Return whether the canonical link exists and its name from this model's scope."""
        if self.canonical_link:
            return any(link.name == self.canonical_link for link in self._all_links()), (
                self.canonical_link
            )
        if self.links:
            return True, self.links[0].name
        if self.models:
            first = self.models[0]
            found, name = first.canonical()
            return found, f"{first.name}::{name}" if found else name
        return False, ""

    def _all_links(self, prefix: str = "") -> list[Link]:
        """Return the links, those of nested models with ``model::`` before their names."""
        own = [Link(prefix + link.name, link.pose, link.relative_to) for link in self.links]
        nested = [
            link for model in self.models for link in model._all_links(f"{prefix}{model.name}::")
        ]
        return own + nested


@dataclass(slots=True)
class WorldScope:
    """A world with its models and frames."""

    name: str
    models: list[ModelScope] = field(default_factory=list)
    frames: list[Frame] = field(default_factory=list)
