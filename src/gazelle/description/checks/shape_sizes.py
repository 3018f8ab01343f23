"""Shapes of the wrong size or in the wrong place: units, scales, forgotten origins."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.description.checks.shape_volumes import Outline, Outlines
from gazelle.description.model import (
    Collision,
    Length,
    Link,
    MeshShape,
    Model,
    Solid,
    Visual,
)
from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["check_sizes"]

_MAX_RATIO = 8.0
_HUGE_RATIO = 100.0
_HUGE_M = 10.0
_LONG_M = 2.0
_TINY_M = 0.002
_APART_M = 0.02
# Smaller shapes are placeholders of frames.
_MARKER_M = 0.03
_DUMMY_M = 0.0025
_UNITS = {1000.0: "millimetres", 100.0: "centimetres", 39.37: "inches"}

Box = tuple[NDArray[np.float64], NDArray[np.float64]]


def check_sizes(model: Model, outlines: Outlines, diagnostics: Diagnostics) -> None:
    """Report what a user sees at once on a screen and nowhere else.

    Args:
        model: the robot or thing.
        outlines: of its shapes.
        diagnostics: receives the findings; links that have one of wrong units are passed over.
    """
    known = {item.span for item in diagnostics.by_code("inertia.units")}
    collisions, visuals = _boxes(outlines.collisions), _boxes(outlines.visuals)
    sizes = {
        name: max(_extent(boxes[name]) for boxes in (collisions, visuals) if name in boxes)
        for name in collisions.keys() | visuals.keys()
    }
    for link in model.links:
        meshes = _mesh_places(link)
        if any(span in known for span in meshes):
            continue
        if link.name in sizes and _check_solid_unit(link, sizes, diagnostics):
            continue
        if link.name in sizes and _check_mesh_unit(link, meshes, sizes, diagnostics):
            continue
        if link.name in collisions and link.name in visuals:
            _compare(link, collisions[link.name], visuals[link.name], diagnostics)


def _check_solid_unit(link: Link, sizes: dict[str, float], diagnostics: Diagnostics) -> bool:
    """Report the length of a box, cylinder or sphere that is written in millimetres."""
    parts: tuple[Collision | Visual, ...] = (*link.collisions, *link.visuals)
    others = [value for name, value in sizes.items() if name != link.name]
    typical = float(np.median(others)) if others else 0.5
    for part in parts:
        shape = part.shape
        if not isinstance(shape, Solid):
            continue
        for row in shape.lengths():
            value = getattr(shape, row.field)
            length = max(value) if isinstance(value, tuple) else value
            twins = _lengths_of_twins(part, parts, row.field)
            is_long = length > _HUGE_RATIO * max(typical, 1e-3) and (
                length > _HUGE_M or (length > _LONG_M and _is_thin(shape, length))
            )
            if any(900.0 < length / twin < 1100.0 for twin in twins if twin) or (
                is_long and not twins
            ):
                _report_solid(link, part, row, value, diagnostics)
                return True
    return False


def _is_thin(shape: Solid, length: float) -> bool:
    """Tell whether a shape is a wire: all its other lengths are as nothing."""
    values = [getattr(shape, row.field) for row in shape.lengths()]
    flat = sorted(one for item in values for one in (item if isinstance(item, tuple) else (item,)))
    return len(flat) > 1 and length > _HUGE_RATIO * flat[-2]


def _lengths_of_twins(
    part: Collision | Visual, parts: Sequence[Collision | Visual], field: str
) -> list[float]:
    """Return the same length of shapes of the same kind in a link."""
    found = []
    for other in parts:
        if other is not part and type(other.shape) is type(part.shape):
            value = getattr(other.shape, field)
            found.append(max(value) if isinstance(value, tuple) else value)
    return found


def _report_solid(
    link: Link,
    part: Collision | Visual,
    row: Length,
    value: float | tuple[float, ...],
    diagnostics: Diagnostics,
) -> None:
    values = value if isinstance(value, tuple) else (value,)
    metres = " ".join(f"{one / 1000 if one > 1.0 else one:.6g}" for one in values)
    what = "collision" if isinstance(part, Collision) else "visual"
    kind = type(part.shape).__name__.lower()
    text = f"the {row.word} of the {kind} in the {what} of link '{link.name}' is {max(values):.4g}"
    text += " m: it is in millimetres, URDF and SDF take it as metres"
    if part.shape_span is not None:
        fix = f'write {row.word}="{metres}"'
    else:
        fix = f"write <{row.word}>{metres}</{row.word}>"
    diagnostics.report("robot.size-unit", text, part.shape_span or part.span, fix=fix)


def _check_mesh_unit(
    link: Link, meshes: Sequence[SourceSpan], sizes: dict[str, float], diagnostics: Diagnostics
) -> bool:
    if not meshes:
        return False
    size = sizes[link.name]
    others = [value for name, value in sizes.items() if name != link.name]
    typical = float(np.median(others)) if others else 0.5
    if size > _HUGE_M and size > _HUGE_RATIO * max(typical, 1e-3):
        factor = min(_UNITS, key=lambda unit: abs(np.log(size / unit / max(typical, 0.01))))
        text = (
            f"link '{link.name}' is {size:.4g} m long by its mesh, other links are {typical:.2g} m"
            f": the mesh is in {_UNITS[factor]}, URDF and SDF take its numbers as metres"
        )
        scale = " ".join([f"{1 / factor:.4g}"] * 3)
        fix = f'write scale="{scale}" into <mesh> (SDF: <scale>{scale}</scale>)'
        diagnostics.report("robot.mesh-unit", text, meshes[0], fix=fix)
        return True
    scaled = _is_scaled_down(link)
    if scaled and size < _TINY_M and size * _HUGE_RATIO < typical:
        text = (
            f"link '{link.name}' is {size * 1e3:.3g} mm long by its mesh: the file is in metres "
            "already and is scaled down once more, so nobody will see it"
        )
        diagnostics.report("robot.mesh-unit", text, meshes[0], fix="remove the mesh's scale")
        return True
    return False


def _compare(link: Link, collision: Box, visual: Box, diagnostics: Diagnostics) -> None:
    sizes = _extent(collision), _extent(visual)
    shapes = link.collisions if sizes[0] < sizes[1] else link.visuals
    if min(sizes) < _DUMMY_M and not any(isinstance(one.shape, MeshShape) for one in shapes):
        return  # a box of a millimetre is there because Gazebo wants one
    span = link.collisions[0].span or link.span
    if max(sizes) > _MAX_RATIO * min(sizes) and max(sizes) > 0.05:
        which = "larger" if sizes[0] > sizes[1] else "smaller"
        ratio = max(sizes) / max(min(sizes), 1e-9)
        text = (
            f"the collision of link '{link.name}' is {ratio:,.3g} times {which} than what is seen: "
            f"{_shown(collision)} against {_shown(visual)} m"
        )
        if 300.0 < ratio < 3000.0:
            text += "; one of the two is in millimetres"
        fix = "correct the size or the scale of one of the two"
        diagnostics.report("robot.size-mismatch", text, span, fix=fix)
        return
    gap = np.maximum(collision[0] - visual[1], visual[0] - collision[1]).max()
    if gap > _APART_M and min(sizes) > _MARKER_M:
        text = (
            f"the collision of link '{link.name}' stands {gap:.3g} m beside what is seen: things "
            "bump into nothing there and pass through the robot"
        )
        fix = "give <collision> the same <origin> (SDF: <pose>) as <visual>"
        diagnostics.report("robot.collision-apart", text, span, fix=fix)


def _boxes(outlines: Iterable[Outline]) -> dict[str, Box]:
    boxes: dict[str, Box] = {}
    for item in outlines:
        low, high = boxes.get(item.link.name, (item.low_m, item.high_m))
        boxes[item.link.name] = np.minimum(low, item.low_m), np.maximum(high, item.high_m)
    return boxes


def _extent(box: Box) -> float:
    return float((box[1] - box[0]).max())


def _shown(box: Box) -> str:
    return " × ".join(f"{value:.3g}" for value in box[1] - box[0])


def _meshes(link: Link) -> Iterable[tuple[MeshShape, SourceSpan | None]]:
    parts: tuple[Collision | Visual, ...] = (*link.collisions, *link.visuals)
    for part in parts:
        if isinstance(part.shape, MeshShape):
            yield part.shape, part.span


def _mesh_places(link: Link) -> tuple[SourceSpan, ...]:
    spans = (shape.span or around for shape, around in _meshes(link))
    return tuple(span for span in spans if span is not None)


def _is_scaled_down(link: Link) -> bool:
    return any(max(map(abs, shape.scale)) < 0.1 for shape, _ in _meshes(link))
