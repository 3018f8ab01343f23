"""SDF ``<model>``: links, joints, frames, nested and included models."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeVar

from gazelle.description.model import Frame, Joint, JointType, Link, Model, PluginTag
from gazelle.description.model.plugin import read_plugins
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import child_bool, name_of
from gazelle.description.sdf_reader.frame_graph import (
    MODEL_FRAME,
    WORLD_FRAME,
    FrameGraph,
    FramePoint,
)
from gazelle.description.sdf_reader.includes import closes_circle, included_file, share_findings
from gazelle.description.sdf_reader.joints import JointEnds
from gazelle.description.sdf_reader.known_elements import check_elements
from gazelle.description.sdf_reader.links import read_link
from gazelle.description.sdf_reader.poses import (
    PoseResolver,
    named_children,
    pose_of,
    relative_to_of,
)
from gazelle.description.sdf_reader.versions import upgraded, version_of
from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, Severity, SourceSpan, did_you_mean
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["Flattened", "ModelParts", "included_model", "model_around", "read_model"]

_Named = TypeVar("_Named", Link, Joint)


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


def read_model(tag: Tag, context: ReadContext) -> ModelParts | None:
    """Return the model of a ``<model>`` element.

    Returns:
        The model in its own frame; None (reported) when it has no name or no link.
    """
    name = name_of(tag, context, default="unnamed_model")
    nested = _nested_models(tag, context)
    links = named_children(tag, "link", context)
    if not links and not any(item.model.links for item in nested):
        _report_no_link(tag, name, context)
        return None
    return _ModelReader(tag, name, context, links, nested).read()


def included_model(
    tag: Tag, context: ReadContext, *, file: Path | None = None
) -> ModelParts | None:
    """Return the model that an ``<include>`` brings, with the include's own words applied.

    Args:
        tag: the ``<include>``.
        context: where it stands.
        file: the file it means, when that is known already.
    """
    path = file or included_file(tag, context)
    if path is None or closes_circle(path, tag, context):
        return None
    key = ("sdf model", path)
    if key not in context.cache:
        context.cache[key] = _model_of_file(path, tag, context)
    parts: ModelParts | None = context.cache[key]
    return None if parts is None else _overridden(parts, tag, context)


def model_around(merged: ModelParts, tag: Tag, context: ReadContext) -> Model:
    """Return the model of a ``<model>`` element into which another one is merged.

    Args:
        merged: gives links, joints and frames under their own names.
        tag: the element.
        context: where problems are reported.
    """
    nested = (merged, *_nested_models(tag, context))
    links = named_children(tag, "link", context)
    return _ModelReader(tag, merged.model.name, context, links, nested).read().model


def _held(link: Link) -> Joint:
    return Joint(
        name=f"{link.name}::__static__",
        type=JointType.FIXED,
        parent=WORLD_FRAME,
        child=link.name,
        T_model_joint=link.T_model_link,
        span=link.span,
    )


def _overridden(parts: ModelParts, tag: Tag, context: ReadContext) -> ModelParts:
    """Return a model with an include's name, pose, static flag, frame and plug-ins."""
    model = parts.model
    name = tag.text_of("name", default=model.name)
    static = child_bool(tag, "static", model.static, context)
    plugins = (*model.plugins, *read_plugins(tag))
    parts = replace(
        parts,
        model=replace(model, name=name, static=static, plugins=plugins),
        merged=tag.attributes.get("merge", "").strip().lower() in ("true", "1"),
    )
    if tag.find("pose") is not None:
        parts = replace(parts, pose=pose_of(tag, context), relative_to=relative_to_of(tag))
    else:
        # The file's own pose stays, its frame belonged to another scope.
        parts = replace(parts, relative_to="")
    placement = tag.text_of("placement_frame")
    return _with_placement(parts, placement, tag, context) if placement else parts


def _placed_models(
    models: Sequence[ModelParts], frames: FrameGraph, *, in_static: bool
) -> tuple[Flattened, ...]:
    """Return what nested models add to the model whose frames these are."""
    return tuple(
        item.flattened(frames.pose(item.frame_name), in_static=in_static) for item in models
    )


def _with_placement(parts: ModelParts, frame: str, tag: Tag, context: ReadContext) -> ModelParts:
    if frame in parts.frames or frame == MODEL_FRAME:
        return replace(parts, placement_frame=frame)
    message = f"placement_frame '{frame}' is no frame of model '{parts.model.name}'"
    context.diagnostics.report(
        "sdf.unknown-frame", message, tag.span, fix=did_you_mean(frame, parts.frames)
    )
    return parts


def _report_no_link(tag: Tag, name: str, context: ReadContext) -> None:
    severity = Severity.WARNING if context.in_world else Severity.ERROR
    message = f"model '{name}' has no link, so there is nothing to load"
    context.diagnostics.report("sdf.model-without-link", message, tag.span, severity=severity)


def _nested_models(tag: Tag, context: ReadContext) -> tuple[ModelParts, ...]:
    """Return nested and included models in document order."""
    found: dict[str, ModelParts] = {}
    for child in tag.children:
        if child.name == "model":
            parts = read_model(child, context)
        elif child.name == "include":
            parts = included_model(child, context)
        else:
            continue
        if parts is None:
            continue
        name = parts.model.name
        if name in found:
            message = f"model with name '{name}' stands twice here; the second one is left out"
            context.diagnostics.report("sdf.duplicate-name", message, child.span)
            continue
        found[name] = parts
    return tuple(found.values())


def _model_of_file(path: Path, tag: Tag, context: ReadContext) -> ModelParts | None:
    found = Diagnostics()
    inner = replace(context.for_file(path), diagnostics=found)
    root = read_xml(path, found)
    parts = None
    if root is not None:
        parts = _urdf_parts(path, inner) if root.name == "robot" else _first_model(root, inner)
    share_findings(found, tag, context)
    return parts and replace(parts, model=replace(parts.model, file=path))


def _first_model(root: Tag, context: ReadContext) -> ModelParts | None:
    root = upgraded(root, context)
    versioned = context.for_version(version_of(root, context))
    check_elements(root, versioned)
    model = root if root.name == "model" else root.find("model")
    if model is not None:
        return read_model(model, versioned)
    message = f"'{context.file}' holds no <model>"
    context.diagnostics.report("sdf.no-model", message, root.span)
    return None


def _urdf_parts(path: Path, context: ReadContext) -> ModelParts | None:
    """Return a URDF robot, which an ``<include>`` may name as well."""
    from gazelle.description.urdf_reader import read_urdf

    root = read_xml(path, context.diagnostics)
    model = None if root is None else read_urdf(root, context=context)
    if model is None:
        return None
    frames = {link.name: link.T_model_link for link in model.links}
    return ModelParts(model, frames=frames, attached={name: name for name in frames})


class _ModelReader:
    """Reads one model whose links are known to exist."""

    def __init__(
        self,
        tag: Tag,
        name: str,
        context: ReadContext,
        links: Sequence[Tag],
        nested: Sequence[ModelParts],
    ) -> None:
        self._tag = tag
        self._name = name
        self._context = context
        self._links = links
        self._nested = nested
        self._joints = named_children(tag, "joint", context)
        self._frames = named_children(tag, "frame", context)
        self._static = child_bool(tag, "static", False, context)

    def read(self) -> ModelParts:
        points = dict(self._points())
        canonical = self._canonical_link(points)
        graph = FrameGraph(
            points,
            self._context,
            scope=f"model '{self._name}'",
            default_attached=canonical,
        )
        resolver = PoseResolver(self._context, graph)
        model = self._model(resolver, points, canonical)
        parts = ModelParts(
            model=model,
            pose=pose_of(self._tag, self._context),
            relative_to=relative_to_of(self._tag),
            frames={name: graph.pose(name) for name in points},
            attached={name: graph.attached_link(name) for name in points},
        )
        placement = self._tag.attributes.get("placement_frame", "").strip()
        return _with_placement(parts, placement, self._tag, self._context) if placement else parts

    def _points(self) -> Iterator[tuple[str, FramePoint]]:
        taken: dict[str, FramePoint] = {}
        for kind, tags in (("link", self._links), ("frame", self._frames)):
            for tag in tags:
                taken.setdefault(tag.attributes["name"].strip(), self._point(kind, tag))
        for item in self._nested:
            for name, point in item.points().items():
                taken.setdefault(name, point)
        for tag in self._joints:
            point = self._point("joint", tag)
            if tag.text_of("child") not in taken:  # reported where the joint is read
                point = replace(point, relative_to=relative_to_of(tag), attached_to="")
            taken.setdefault(point.name, point)
        yield from taken.items()
        for tag in self._joints:
            name = tag.attributes["name"].strip()
            if taken[name].span != tag.span:
                yield _joint_key(name), replace(self._point("joint", tag), name=_joint_key(name))

    def _point(self, kind: str, tag: Tag) -> FramePoint:
        name, relative_to = tag.attributes["name"].strip(), relative_to_of(tag)
        attached_to = name
        if kind == "joint":
            attached_to = tag.text_of("child")
        elif kind == "frame":
            attached_to = tag.attributes.get("attached_to", "").strip()
        if kind != "link":
            relative_to = relative_to or attached_to
        pose = pose_of(tag, self._context)
        return FramePoint(kind, name, relative_to, pose, attached_to, tag.span)

    def _canonical_link(self, points: Mapping[str, FramePoint]) -> str:
        wanted = self._tag.attributes.get("canonical_link", "").strip()
        if wanted:
            point = points.get(wanted)
            if point is not None and point.attached_to == wanted:
                return wanted
            message = f"canonical_link '{wanted}' is no link of model '{self._name}'"
            self._context.diagnostics.report(
                "sdf.unknown-frame", message, self._tag.span, fix=did_you_mean(wanted, points)
            )
        if self._links:
            return self._links[0].attributes["name"].strip()
        first = next(item for item in self._nested if item.model.links)
        return first.scoped(first.model.canonical_link)

    def _model(
        self, resolver: PoseResolver, points: Mapping[str, FramePoint], canonical: str
    ) -> Model:
        context, graph = self._context, resolver.frames
        inner = _placed_models(self._nested, graph, in_static=self._static)
        links = tuple(
            read_link(
                tag, graph.pose(tag.attributes["name"].strip()), resolver, static=self._static
            )
            for tag in self._links
        )
        joints = self._own_joints(resolver, points)
        return Model(
            name=self._name,
            static=self._static,
            self_collide=child_bool(self._tag, "self_collide", False, context),
            allow_auto_disable=child_bool(self._tag, "allow_auto_disable", True, context),
            links=self._unique((*links, *(link for item in inner for link in item.links))),
            joints=self._unique((*joints, *(joint for item in inner for joint in item.joints))),
            frames=self._own_frames(graph)
            + tuple(frame for item in inner for frame in item.frames),
            canonical_link=canonical,
            plugins=read_plugins(self._tag)
            + tuple(plugin for item in inner for plugin in item.plugins),
            source_format="sdf",
            span=self._tag.span,
        )

    def _unique(self, items: tuple[_Named, ...]) -> tuple[_Named, ...]:
        """Leave out what a merged model brings under a name that is taken."""
        found: dict[str, _Named] = {}
        for item in items:
            if found.setdefault(item.name, item) is not item:
                kind = type(item).__name__.lower()
                message = (
                    f"{kind} with name '{item.name}' comes into model '{self._name}' twice by "
                    "merging; the second one is left out"
                )
                self._context.diagnostics.report("sdf.duplicate-name", message, item.span)
        return tuple(found.values())

    def _own_frames(self, graph: FrameGraph) -> tuple[Frame, ...]:
        names = [tag.attributes["name"].strip() for tag in self._frames]
        return tuple(Frame(name, graph.attached_link(name), graph.pose(name)) for name in names)

    def _own_joints(
        self, resolver: PoseResolver, points: Mapping[str, FramePoint]
    ) -> tuple[Joint, ...]:
        ends = JointEnds(resolver, f"model '{self._name}'")
        found: list[Joint] = []
        for tag in self._joints:
            name = tag.attributes["name"].strip()
            point = points.get(_joint_key(name), points[name])
            joint = ends.joint(tag, point)
            if joint is not None:
                found.append(joint)
        return tuple(found)


def _joint_key(name: str) -> str:
    """Key of a joint whose name a link or frame has too; no name in a file has a blank first."""
    return f" {name}"
