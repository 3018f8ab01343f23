"""Worlds, models and what has a name and a place in them, made of normalised elements.

All errors that sdformat finds on the way are told in its order: nested models, links, joints,
frames, then the model itself.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.element_checks import (
    check_atmosphere,
    check_axis,
    check_inertial,
    check_light,
    check_link_parts,
    check_name,
    check_sensors,
    check_spherical_coordinates,
    check_unique,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.console import Code, Console, SdfError
from gazelle.description.sdformat_emulation.gz_sdf_command.specification import (
    Definition,
    specification,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.values import (
    bool_of,
    notation_of,
    pose_of,
)
from gazelle.geometry import Pose

__all__ = [
    "Frame",
    "Joint",
    "Link",
    "Loader",
    "ModelScope",
    "WorldScope",
    "load_model",
    "load_world",
    "shared_names",
]

_RENAMED_BEFORE = (1, 7)
_JOINTS = frozenset(
    {
        "ball",
        "continuous",
        "fixed",
        "gearbox",
        "prismatic",
        "revolute",
        "revolute2",
        "screw",
        "universal",
    }
)


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


@dataclass(frozen=True, slots=True)
class Loader:
    """What loading needs besides the elements.

    Attributes:
        console: receives warnings.
        versions: version of the document that an element came from, by identity; elements inside
            it follow.
    """

    console: Console
    versions: dict[int, tuple[int, ...]]


def shared_names(element: SdfElement, definition: Definition | None) -> list[SdfElement]:
    """Return the elements, depth first, among whose children two share a name.

    Plug-ins and elements of other namespaces are not looked into.
    """
    if element.name == "plugin" or ":" in element.name:
        return []
    found = [element] if any(n > 1 for n in _counted_names(element, definition).values()) else []
    children = definition.resolved.children if definition is not None else {}
    for child in element.children:
        found += shared_names(child, children.get(child.name))
    return found


def load_world(
    element: SdfElement, version: tuple[int, ...], loader: Loader, errors: list[SdfError]
) -> WorldScope:
    """Return a world; errors are appended. For the arguments see `load_model`."""
    check_name(element, "world", errors)
    for name, check in (
        ("atmosphere", check_atmosphere),
        ("spherical_coordinates", check_spherical_coordinates),
    ):
        found = element.find(name)
        if found is not None:
            check(found, errors)
    world = WorldScope(element.attributes["name"])
    definition = specification(loader.console.release).children["world"]
    for location in ("world-names", "world-names-again"):
        _warn_of_names(element, definition, location, "world", loader)
    world.models = _models(element, version, loader, errors)
    check_unique(element, "physics", lambda one, found: check_name(one, "physics", found), errors)
    check_unique(element, "actor", lambda one, found: None, errors)
    check_unique(element, "light", check_light, errors)
    taken = {model.name for model in world.models}
    world.frames = _frames(element, errors)
    for frame in world.frames:
        if frame.name in taken:
            _rename(frame, "frame", taken, "world-frame-renamed", f"world with name [{world.name}]",
                    loader)  # fmt: skip
        taken.add(frame.name)
    return world


def load_model(
    element: SdfElement, version: tuple[int, ...], loader: Loader, errors: list[SdfError]
) -> ModelScope:
    """Return a model and those nested in it; errors are appended.

    Args:
        element: ``<model>``.
        version: of the document it came from: names that collide are changed in old ones.
        loader: what else is needed.
        errors: receives errors.
    """
    version = loader.versions.get(id(element), version)
    check_name(element, "model", errors)
    pose, relative_to = _pose(element)
    model = ModelScope(
        element.attributes["name"], pose, relative_to,
        is_static=bool(bool_of(_text(element, "static"))),
        canonical_link=element.attributes.get("canonical_link", ""),
        placement_frame=element.attributes.get("placement_frame", ""),
    )  # fmt: skip
    definition = specification(loader.console.release).children["model"]
    _warn_of_names(element, definition, "model-names", "model", loader)
    model.models = _models(element, version, loader, errors)
    taken = {nested.name for nested in model.models}
    links = check_unique(element, "link", _check_link, errors)
    model.links = [_link(link) for link in links]
    _resolve_collisions(model.links, "link", taken, model, version, loader)
    if not model.has_link:
        errors.append(SdfError(Code.MODEL_WITHOUT_LINK, "A model must have at least one link."))
    model.joints = [_joint(one) for one in check_unique(element, "joint", _check_joint, errors)]
    _resolve_collisions(model.joints, "joint", taken, model, version, loader)
    model.frames = _frames(element, errors)
    _resolve_collisions(model.frames, "frame", taken, model, version, loader)
    return model


def _counted_names(element: SdfElement, definition: Definition | None) -> Counter[str]:
    """Return how often each name occurs among an element's children; plug-ins do not count.

    A child that may have a name and has none counts under the specification's default.
    """
    names: Counter[str] = Counter()
    for child in element.children:
        if child.name == "plugin":
            continue
        name = child.attributes.get("name")
        if name is None:
            name = _default_name(child, definition)
        if name is not None:
            names[name] += 1
    return names


def _default_name(child: SdfElement, definition: Definition | None) -> str | None:
    known = definition.resolved.children.get(child.name) if definition is not None else None
    attribute = known.resolved.attribute("name") if known is not None else None
    return attribute.default if attribute is not None else None


def _models(
    parent: SdfElement, version: tuple[int, ...], loader: Loader, errors: list[SdfError]
) -> list[ModelScope]:
    loaded: dict[int, ModelScope] = {}

    def check(element: SdfElement, found: list[SdfError]) -> None:
        loaded[id(element)] = load_model(element, version, loader, found)

    return [loaded[id(one)] for one in check_unique(parent, "model", check, errors)]


def _check_link(link: SdfElement, errors: list[SdfError]) -> None:
    check_name(link, "link", errors)
    check_link_parts(link, errors)
    check_inertial(link, errors)


def _link(element: SdfElement) -> Link:
    pose, relative_to = _pose(element)
    return Link(element.attributes["name"], pose, relative_to, element.find("inertial"))


def _check_joint(joint: SdfElement, errors: list[SdfError]) -> None:
    check_name(joint, "joint", errors)
    name, parent, child = joint.attributes["name"], _text(joint, "parent"), _text(joint, "child")
    for word, end in (("parent", parent), ("child", child)):
        if end == "__root__":
            message = f"The supplied joint {word} name [{end}] is not valid."
            errors.append(SdfError(Code.RESERVED_NAME, message))
    if child == "world":
        message = f"Joint with name[{name}] specified invalid child link [world]."
        errors.append(SdfError(Code.JOINT_CHILD_LINK_INVALID, message))
    if child == parent:
        message = (
            f"Joint with name[{name}] must specify different frame names for parent and child, "
            f"while [{child}] was specified for both."
        )
        errors.append(SdfError(Code.JOINT_PARENT_SAME_AS_CHILD, message))
    for axis in (joint.find("axis"), joint.find("axis2")):
        if axis is not None:
            check_axis(axis, errors)
    kind = joint.attributes["type"].lower()
    if kind not in _JOINTS:
        message = (
            f"Joint type of {kind} is invalid. Refer to the SDF documentation for a list of valid "
            "joint types"
        )
        errors.append(SdfError(Code.ATTRIBUTE_INVALID, message))
    check_sensors(joint, errors)


def _joint(element: SdfElement) -> Joint:
    pose, relative_to = _pose(element)
    parent, child = _text(element, "parent"), _text(element, "child")
    return Joint(element.attributes["name"], pose, relative_to, parent, child)


def _frames(element: SdfElement, errors: list[SdfError]) -> list[Frame]:
    found = check_unique(element, "frame", lambda one, more: check_name(one, "frame", more), errors)
    frames = []
    for one in found:
        pose, relative_to = _pose(one)
        attached_to = one.attributes.get("attached_to", "")
        frames.append(Frame(one.attributes["name"], pose, relative_to, attached_to))
    return frames


def _resolve_collisions(
    items: list[Link] | list[Joint] | list[Frame],
    kind: str,
    taken: set[str],
    model: ModelScope,
    version: tuple[int, ...],
    loader: Loader,
) -> None:
    where = f"model with name [{model.name}]"
    for item in items:
        if item.name in taken and version < _RENAMED_BEFORE:
            _rename(item, kind, taken, f"{kind}-renamed", where, loader)
        elif item.name in taken:
            loader.console.error(
                f"{kind}-collision",
                f"{kind.capitalize()} with name [{item.name}] in {where} has a name collision. "
                f"Please rename this {kind}.",
            )
        taken.add(item.name)


def _rename(
    item: Link | Joint | Frame,
    kind: str,
    taken: set[str],
    location: str,
    where: str,
    loader: Loader,
) -> None:
    name = f"{item.name}_{kind}"
    number = 0
    while name in taken:
        name = f"{item.name}_{kind}{number}"
        number += 1
    loader.console.warn(
        location,
        f"{kind.capitalize()} with name [{item.name}] in {where} has a name collision, changing "
        f"{kind} name to [{name}].",
    )
    item.name = name


def _warn_of_names(
    element: SdfElement, definition: Definition, location: str, kind: str, loader: Loader
) -> None:
    for name, count in sorted(_counted_names(element, definition).items()):
        if count > 1:
            loader.console.warn(
                location,
                f"Non-unique name[{name}] detected {count} times in XML children of {kind} with "
                f"name[{element.attributes['name']}].",
            )


def _pose(element: SdfElement) -> tuple[Pose, str]:
    pose = element.find("pose")
    if pose is None:
        return Pose(), ""
    relative_to = pose.attributes.get("relative_to", "")
    return pose_of(pose.text, notation_of(pose.attributes)), relative_to


def _text(element: SdfElement, name: str) -> str:
    found = element.find(name)
    return found.text if found is not None else ""
