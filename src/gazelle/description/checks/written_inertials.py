"""What the checks of mass and inertia look at: every link as written, with its shapes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from gazelle.description.checks.shape_volumes import shape_body, shape_points_m
from gazelle.description.model import JointType, Link, MeshShape, Model, Shape
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.geometry import (
    IDENTITY_POSE,
    Inertia6,
    MassProperties,
    Pose,
    combined_mass_properties,
)

__all__ = ["JointRecord", "LinkRecord", "WrittenInertial", "joint_records_of", "records_of"]

_TENSOR_COMPONENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_SDF_DEFAULTS = {"ixx": "1", "iyy": "1", "izz": "1"}
_TRUE = ("1", "true")
# So many of the links that hang on one are named.
_NAMED = 3

_Children = dict[str, list[str]]
FindTag = Callable[[Link], Tag | None]


@dataclass(frozen=True, slots=True)
class WrittenInertial:
    """An ``<inertial>`` as the file has it, before any reader mends it.

    Attributes:
        mass_kg: mass; may be anything, also not a finite number.
        inertia_kg_m2: the tensor about the centre of mass in the axes of `T_link_com`.
        T_link_com: frame of the centre of mass.
        span, mass_span, inertia_span: places.
    """

    mass_kg: float
    inertia_kg_m2: Inertia6
    T_link_com: Pose = IDENTITY_POSE
    span: SourceSpan | None = None
    mass_span: SourceSpan | None = None
    inertia_span: SourceSpan | None = None

    @property
    def body(self) -> MassProperties:
        """The mass properties in the link's frame."""
        about_com = MassProperties(self.mass_kg, (0.0, 0.0, 0.0), self.inertia_kg_m2)
        return about_com.transformed(self.T_link_com)


@dataclass(frozen=True)
class LinkRecord:
    """A link for the checks.

    Attributes:
        name: the link's, with the model's in front when the file holds several.
        source_format: ``urdf`` or ``sdf``.
        written: its ``<inertial>``; None when there is none, or none that can be read.
        is_computed: its mass properties come from its collisions (SDF ``auto="true"``).
        has_unreadable: an ``<inertial>`` is there and unusable, which the reader reported.
        needs_mass: it moves and nothing it is fixed to has mass.
        is_fixed: a fixed joint ties it to another link of a URDF; both move as one body.
        is_root: no joint moves its body.
        feels_gravity: False where gravity is switched off for it, as for what floats.
        below: the first few links that hang on its body; only of a URDF's.
        count_below: how many hang on it.
        span: place of the ``<link>``.
        collisions, visuals: shapes of 1 kg/m³, their mass is the volume; without the flat ones.
        points_m: (n, 3) points whose hull holds all its shapes, link frame.
        unscaled_meshes: places of meshes with a scale of 1.
    """

    name: str
    source_format: str
    written: WrittenInertial | None = None
    is_computed: bool = False
    has_unreadable: bool = False
    needs_mass: bool = True
    is_fixed: bool = False
    is_root: bool = False
    feels_gravity: bool = True
    below: tuple[str, ...] = ()
    count_below: int = 0
    span: SourceSpan | None = None
    collisions: tuple[MassProperties, ...] = ()
    visuals: tuple[MassProperties, ...] = ()
    points_m: NDArray[np.float64] | None = None
    unscaled_meshes: tuple[SourceSpan, ...] = ()

    @cached_property
    def volumes_m3(self) -> tuple[float, ...]:
        """Volume of the collisions, then of the visuals, where there is any."""
        sums = (sum(body.mass_kg for body in bodies) for bodies in (self.collisions, self.visuals))
        return tuple(total for total in sums if total > 0.0)

    @cached_property
    def shape_body(self) -> MassProperties | None:
        """The collisions, else the visuals, of 1 kg/m³; None without volume."""
        bodies = self.collisions or self.visuals
        return combined_mass_properties(bodies) if bodies else None

    @cached_property
    def extent_m(self) -> float:
        """Longest edge of the bounding box, 0 without shapes."""
        if self.points_m is None or not len(self.points_m):
            return 0.0
        return float(np.ptp(self.points_m, axis=0).max())


@dataclass(frozen=True, slots=True)
class JointRecord:
    """A joint that moves, with the masses of the two bodies it joins, fixed parts included."""

    name: str
    parent: str
    child: str
    parent_mass_kg: float
    child_mass_kg: float
    span: SourceSpan | None = None


def records_of(
    models: Iterable[Model], find_tag: FindTag, diagnostics: Diagnostics
) -> tuple[LinkRecord, ...]:
    """Return a record for every link of the models that can move.

    Args:
        models: as read.
        find_tag: returns a link's element in the file, None when it is not known.
        diagnostics: receives what is wrong with mesh files.
    """
    moving = [model for model in models if not model.static]
    several = len(moving) > 1
    records: dict[tuple[str, SourceSpan | str], LinkRecord] = {}
    for model in moving:
        heads, needy = _heads(model), _needy(model, find_tag)
        children = {joint.child for joint in model.joints}
        links_below: _Children = {}
        for joint in model.joints:
            links_below.setdefault(joint.parent, []).append(joint.child)
        counts = _counts_below(model, links_below)
        for link in model.links:
            name = f"{model.name}::{link.name}" if several else link.name
            record = _record(name, link, model, find_tag(link), diagnostics)
            tied = model.source_format == "urdf" and heads[link.name] != link.name
            # A model that is included many times is judged once.
            key = link.name, link.span or name
            record = replace(record, needs_mass=link.name in needy, is_fixed=tied)
            if record.needs_mass:
                record = replace(record, is_root=heads[link.name] not in children)
            if record.needs_mass and model.source_format == "urdf":
                head = heads[link.name]
                below, count = _below(link.name, head, links_below, counts.get(head))
                record = replace(record, below=below, count_below=count)
            records.setdefault(key, record)
    return tuple(records.values())


def joint_records_of(models: Iterable[Model], find_tag: FindTag) -> tuple[JointRecord, ...]:
    """Return a record for every joint that can move and joins two bodies with mass."""
    found = []
    for model in models:
        heads, masses = _heads(model), dict[str, float]()
        for link in model.links:
            written = _written(find_tag(link), link, model.source_format)
            mass = written.mass_kg if written else link.inertial.mass_kg if link.inertial else 0.0
            masses[heads[link.name]] = masses.get(heads[link.name], 0.0) + mass
        for joint in model.joints:
            above, below = (heads.get(name, name) for name in (joint.parent, joint.child))
            parent, child = masses.get(above, 0.0), masses.get(below, 0.0)
            if joint.type is not JointType.FIXED and parent > 0.0 and child > 0.0:
                found.append(JointRecord(joint.name, above, below, parent, child, joint.span))
    return tuple(found)


def _needy(model: Model, find_tag: FindTag) -> set[str]:
    """Return the links that must have mass of their own: one of every body without any."""
    if model.source_format == "sdf":
        return {link.name for link in model.links}
    heads = _heads(model)
    groups: dict[str, list[Link]] = {}
    for link in model.links:
        groups.setdefault(heads[link.name], []).append(link)
    groups.pop("world" if model.link("world") is None else "", None)
    needy = set()
    for links in groups.values():
        written = (_written(find_tag(link), link, "urdf") for link in links)
        if not any(item is not None and item.mass_kg > 0.0 for item in written):
            shaped = (link.name for link in links if link.collisions or link.visuals)
            needy.add(next(shaped, links[0].name))
    return needy


def _below(
    name: str, head: str, links: _Children, count: int | None
) -> tuple[tuple[str, ...], int]:
    """Return the first links that hang on a link's body, without it, and how many there are.

    Args:
        name: the link.
        head: of its body.
        links: links below each.
        count: of links below the head where they are a tree.
    """
    walk = _walk_below(head, links)
    if count is None:
        found = [other for other in walk if other != name]
        return tuple(found[:_NAMED]), len(found)
    first = islice((other for other in walk if other != name), _NAMED)
    return tuple(first), count - (name != head)


def _walk_below(head: str, links: _Children) -> Iterator[str]:
    found, waiting = set[str](), [head]
    while waiting:
        for child in links.get(waiting.pop(), ()):
            if child not in found:
                found.add(child)
                waiting.append(child)
                yield child


def _counts_below(model: Model, links: _Children) -> dict[str, int]:
    """Return how many links are below each link that stands in a tree; nothing for graphs."""
    children = [joint.child for joint in model.joints]
    above = {joint.child: joint.parent for joint in model.joints}
    if len(above) < len(children):
        return {}
    names = dict.fromkeys((*(link.name for link in model.links), *above.values()))
    roots = [name for name in names if name not in above]
    counts = {name: 0 for root in roots for name in (root, *_walk_below(root, links))}
    for name in reversed(tuple(counts)):
        if name in above:
            counts[above[name]] = counts.get(above[name], 0) + counts[name] + 1
    return counts


def _heads(model: Model) -> dict[str, str]:
    """Return for every link the first of those it is fixed to."""
    above = {joint.child: joint for joint in model.joints}
    heads, known = dict[str, str](), dict[str, str]()
    for link in model.links:
        name, way = link.name, dict[str, None]()
        while name not in known and name not in way:
            way[name] = None
            joint = above.get(name)
            if joint is None or joint.type is not JointType.FIXED:
                known |= dict.fromkeys(way, name)
            else:
                name = joint.parent
        heads[link.name] = known.get(name, name)
    return heads


def _record(
    name: str,
    link: Link,
    model: Model,
    tag: Tag | None,
    diagnostics: Diagnostics,
) -> LinkRecord:
    collisions = [(item.shape, item.T_link_collision, item.span) for item in link.collisions]
    visuals = [(item.shape, item.T_link_visual, item.span) for item in link.visuals]
    inertial = _inertial_tag(tag, link)
    auto = inertial is not None and inertial.attributes.get("auto", "").strip().lower() in _TRUE
    written = None if auto else _written(tag, link, model.source_format)
    shapes = collisions + visuals
    clouds = [pose.transform(shape_points_m(shape, diagnostics)) for shape, pose, _ in shapes]
    return LinkRecord(
        name=name,
        source_format=model.source_format,
        written=written,
        is_computed=auto,
        has_unreadable=inertial is not None and written is None and not auto,
        feels_gravity=link.gravity,
        span=link.span,
        collisions=_bodies(collisions, diagnostics),
        visuals=_bodies(visuals, diagnostics),
        points_m=np.concatenate(clouds) if clouds else None,
        unscaled_meshes=tuple(
            span
            for shape, _, around in shapes
            if isinstance(shape, MeshShape)
            and shape.scale == (1.0, 1.0, 1.0)
            and (span := shape.span or around) is not None
        ),
    )


def _bodies(
    shapes: list[tuple[Shape, Pose, SourceSpan | None]], diagnostics: Diagnostics
) -> tuple[MassProperties, ...]:
    bodies = ((shape_body(shape, 1.0, diagnostics), pose) for shape, pose, _ in shapes)
    return tuple(body.transformed(pose) for body, pose in bodies if body is not None)


def _written(tag: Tag | None, link: Link, source_format: str) -> WrittenInertial | None:
    inertial = _inertial_tag(tag, link)
    if inertial is None:
        return _as_read(link) if tag is None else None
    is_urdf = source_format == "urdf"
    mass, moments = _urdf_numbers(inertial) if is_urdf else _sdf_numbers(inertial)
    if mass is None or moments is None:
        return None
    pose = _urdf_pose(inertial) if is_urdf or link.inertial is None else link.inertial.T_link_com
    return WrittenInertial(
        mass,
        moments,
        pose,
        inertial.span,
        (inertial.find("mass") or inertial).span,
        (inertial.find("inertia") or inertial).span,
    )


def _inertial_tag(tag: Tag | None, link: Link) -> Tag | None:
    """Return a link's ``<inertial>``: as its reader saw it, which a macro may have written."""
    if link.inertial_tag is not None:
        return link.inertial_tag
    return None if tag is None else tag.find("inertial")


def _as_read(link: Link) -> WrittenInertial | None:
    """Return what the reader made of a link whose element is not known."""
    read = link.inertial
    if read is None or read.estimated:
        return None
    spans = (read.span, read.span, read.span)
    return WrittenInertial(read.mass_kg, read.inertia_kg_m2, read.T_link_com, *spans)


def _urdf_numbers(inertial: Tag) -> tuple[float | None, Inertia6 | None]:
    mass, inertia = inertial.find("mass"), inertial.find("inertia")
    texts = {} if inertia is None else inertia.attributes
    moments = _moments([texts.get(word, "") for word in _TENSOR_COMPONENTS])
    return _number("" if mass is None else mass.attributes.get("value", "")), moments


def _sdf_numbers(inertial: Tag) -> tuple[float | None, Inertia6 | None]:
    inertia = inertial.find("inertia")
    texts = {word: _SDF_DEFAULTS.get(word, "0") for word in _TENSOR_COMPONENTS}
    if inertia is not None:
        texts |= {child.name: child.text for child in inertia.children if child.name in texts}
    return _number(inertial.text_of("mass", default="1")), _moments(list(texts.values()))


def _moments(texts: list[str]) -> Inertia6 | None:
    values = [value for value in map(_number, texts) if value is not None]
    if len(values) < len(_TENSOR_COMPONENTS):
        return None
    return (values[0], values[1], values[2], values[3], values[4], values[5])


def _number(word: str) -> float | None:
    try:
        return float(word)
    except ValueError:
        return None


def _urdf_pose(inertial: Tag) -> Pose:
    """Return ``<origin>`` of an inertial that the reader refused."""
    origin = inertial.find("origin")
    texts = {} if origin is None else origin.attributes
    xyz, rpy = (_triple(texts.get(word, "0 0 0")) for word in ("xyz", "rpy"))
    return Pose.from_xyz_rpy(xyz, rpy)


def _triple(text: str) -> tuple[float, float, float]:
    values = [_number(word) for word in text.split()]
    good = [value for value in values if value is not None and math.isfinite(value)]
    return (good[0], good[1], good[2]) if len(good) == 3 == len(values) else (0.0, 0.0, 0.0)
