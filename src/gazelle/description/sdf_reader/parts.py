"""A model as it has been read, before its scope gives it a place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from gazelle.description.model import Frame, Joint, JointType, Link, Model, PluginTag
from gazelle.description.sdf_reader.frame_graph import MODEL_FRAME, WORLD_FRAME, FramePoint
from gazelle.diagnostics import SourceSpan
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["Flattened", "ModelParts"]


@dataclass(frozen=True, slots=True)
class Flattened:
    """What a nested model adds to the model around it."""

    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    frames: tuple[Frame, ...]
    plugins: tuple[PluginTag, ...]


@dataclass(frozen=True, slots=True)
class ModelParts:
    """A model with the frames that others may refer to.

    Attributes:
        model: the model; its names are its own, its pose is not decided yet.
        pose: its ``<pose>`` as written.
        relative_to: what the pose is relative to, empty for the scope's own frame.
        placement_frame: the frame of the model that stands at the pose, empty for its own.
        frames: pose of every named frame in the model's frame.
        attached: the link that every named frame moves with.
        merged: its elements become the surrounding model's own (``<include merge="true">``).
    """

    model: Model
    pose: Pose = IDENTITY_POSE
    relative_to: str = ""
    placement_frame: str = ""
    frames: Mapping[str, Pose] = field(default_factory=dict)
    attached: Mapping[str, str] = field(default_factory=dict)
    merged: bool = False

    @property
    def span(self) -> SourceSpan:
        """Place of the model."""
        return self.model.span or SourceSpan(str(self.model.file or ""))

    @property
    def frame_name(self) -> str:
        """Name of the model's own frame in its scope (sdformat's name for merged ones)."""
        return f"_merged__{self.model.name}__model__" if self.merged else self.model.name

    def scoped(self, name: str) -> str:
        """Return an inner name as the scope sees it."""
        return name if self.merged else f"{self.model.name}::{name}"

    def points(self) -> dict[str, FramePoint]:
        """Return the frames this model brings into its scope, its own one included."""
        own, canonical = self.frame_name, self.model.canonical_link
        placement = self.frames.get(self.placement_frame, IDENTITY_POSE)
        moves_with = self.scoped(canonical) if canonical else ""
        found = {
            own: FramePoint(
                "model",
                own,
                self.relative_to,
                self.pose @ placement.inverse(),
                moves_with,
                self.span,
            )
        }
        for name, pose in {MODEL_FRAME: IDENTITY_POSE, **self.frames}.items():
            if name == MODEL_FRAME and self.merged:
                continue
            link = self.attached.get(name, canonical)
            key = self.scoped(name)
            found[key] = FramePoint(
                "frame", key, own, pose, self.scoped(link) if link else "", self.span
            )
        return found

    def flattened(self, T_scope_model: Pose, *, in_static: bool) -> Flattened:
        """Return links, joints, frames and plug-ins under the names of the scope.

        Args:
            T_scope_model: where the model stands in the surrounding model.
            in_static: the surrounding model is static as a whole. If not, and this one is, fixed
                joints to the world hold its links.
        """
        model = self.model
        links = tuple(
            replace(
                item, name=self.scoped(item.name), T_model_link=T_scope_model @ item.T_model_link
            )
            for item in model.links
        )
        joints = tuple(self._joint(item, T_scope_model) for item in model.joints)
        if model.static and not in_static:
            joints += tuple(_held(link) for link in links)
        frames = tuple(
            Frame(
                self.scoped(item.name),
                self.scoped(item.attached_to),
                T_scope_model @ item.T_model_frame,
            )
            for item in model.frames
        )
        return Flattened(links, joints, frames, tuple(map(self._plugin, model.plugins)))

    def _joint(self, joint: Joint, T_scope_model: Pose) -> Joint:
        mimic, body = joint.mimic, joint.gearbox_reference_body
        return replace(
            joint,
            name=self.scoped(joint.name),
            parent=joint.parent if joint.parent == WORLD_FRAME else self.scoped(joint.parent),
            child=self.scoped(joint.child),
            T_model_joint=T_scope_model @ joint.T_model_joint,
            mimic=replace(mimic, joint=self.scoped(mimic.joint)) if mimic else None,
            gearbox_reference_body=self.scoped(body) if body else "",
        )

    def _plugin(self, plugin: PluginTag) -> PluginTag:
        """A plug-in's words are names of its own model: `reference` says which one that is."""
        if self.merged:
            return plugin
        scope = self.model.name
        return replace(
            plugin, reference=f"{scope}::{plugin.reference}" if plugin.reference else scope
        )


def _held(link: Link) -> Joint:
    return Joint(
        name=f"{link.name}::__static__",
        type=JointType.FIXED,
        parent=WORLD_FRAME,
        child=link.name,
        T_model_joint=link.T_model_link,
        span=link.span,
    )
