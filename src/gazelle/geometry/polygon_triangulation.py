"""Triangulating closed outlines with holes (ear clipping, holes joined by bridges)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["triangulate"]

Points = NDArray[np.float64]
Outline = Sequence[tuple[float, float]]
Triangle = tuple[int, int, int]

_FLAT_SHARE = 1e-12


def triangulate(outlines: Sequence[Outline]) -> tuple[list[Points], NDArray[np.intp]]:
    """Triangulate the even-odd inside of closed outlines that do not cross each other.

    Args:
        outlines: points in order, either way round; a repeated last point is dropped.

    Returns:
        cleaned rings (solid ones anticlockwise, holes clockwise); triangles as indices into the
        concatenated rings, anticlockwise.

    Raises:
        ValueError: no outline has three different points.
    """
    rings = [ring for ring in map(_cleaned, outlines) if len(ring) >= 3]
    if not rings:
        raise ValueError("an outline needs at least three different points")
    depth = [_depth(index, rings) for index in range(len(rings))]
    rings = [
        ring if (_area(ring) > 0) == (level % 2 == 0) else ring[::-1]
        for ring, level in zip(rings, depth, strict=True)
    ]
    points = np.concatenate(rings)
    starts = np.cumsum([0, *(len(ring) for ring in rings)])
    triangles: list[Triangle] = []
    for index, level in enumerate(depth):
        if level % 2 == 0:
            holes = [
                list(range(starts[i], starts[i + 1]))
                for i in range(len(rings))
                if depth[i] == level + 1 and _inside(rings[i][0], rings[index])
            ]
            loop = list(range(starts[index], starts[index + 1]))
            triangles += _clip_ears(points, _bridged(points, loop, holes))
    return rings, np.array(triangles, np.intp).reshape(-1, 3)


def _cleaned(outline: Outline) -> Points:
    points = np.asarray(outline, np.float64).reshape(-1, 2)
    if len(points) < 3:
        return points
    return points[np.any(points != np.roll(points, 1, axis=0), axis=1)]


def _area(ring: Points) -> float:
    x, y = ring.T
    return float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2


def _depth(index: int, rings: list[Points]) -> int:
    others = (ring for i, ring in enumerate(rings) if i != index)
    return sum(_inside(rings[index][0], ring) for ring in others)


def _inside(point: Points, ring: Points) -> bool:
    x, y = ring.T
    x2, y2 = np.roll(x, -1), np.roll(y, -1)
    spans = (y > point[1]) != (y2 > point[1])
    rise = np.where(y2 == y, 1.0, y2 - y)
    return bool(np.count_nonzero(spans & (point[0] < (x2 - x) * (point[1] - y) / rise + x)) % 2)


def _bridged(points: Points, loop: list[int], holes: list[list[int]]) -> list[int]:
    """Cut the holes open, rightmost first, each joined to a vertex it can see."""
    for hole in sorted(holes, key=lambda ring: -float(points[ring, 0].max())):
        start = int(np.argmax(points[hole, 0]))
        ring = hole[start:] + hole[: start + 1]
        obstacles = [loop, *holes]
        at = _visible(points, ring[0], loop, obstacles)
        loop = [*loop[: at + 1], *ring, *loop[at:]]
    return loop


def _visible(points: Points, origin: int, loop: list[int], obstacles: list[list[int]]) -> int:
    distances = np.linalg.norm(points[loop] - points[origin], axis=1)
    for at in np.argsort(distances, kind="stable"):
        ends = points[origin], points[loop[at]]
        if _opens_towards(points, loop, int(at), points[origin]) and not any(
            _crosses(points, ring, *ends) for ring in obstacles
        ):
            return int(at)
    return int(np.argmin(distances))


def _opens_towards(points: Points, loop: list[int], at: int, target: Points) -> bool:
    """Whether a point lies within the inner angle of a loop's corner."""
    before, here, after = (points[loop[(at + i) % len(loop)]] for i in (-1, 0, 1))
    left = _turn(here, after, target) >= 0
    right = _turn(before, here, target) >= 0
    return left and right if _turn(before, here, after) >= 0 else left or right


def _crosses(points: Points, ring: list[int], a: Points, b: Points) -> bool:
    c, d = points[ring], points[np.roll(ring, -1)]
    side_c, side_d = _turns(a, b, c), _turns(a, b, d)
    side_a = (d[:, 0] - c[:, 0]) * (a[1] - c[:, 1]) - (d[:, 1] - c[:, 1]) * (a[0] - c[:, 0])
    side_b = (d[:, 0] - c[:, 0]) * (b[1] - c[:, 1]) - (d[:, 1] - c[:, 1]) * (b[0] - c[:, 0])
    return bool(np.any((side_c * side_d < 0) & (side_a * side_b < 0)))


def _turn(a: Points, b: Points, c: Points) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def _turns(a: Points, b: Points, many: Points) -> Points:
    turns: Points = (b[0] - a[0]) * (many[:, 1] - a[1]) - (b[1] - a[1]) * (many[:, 0] - a[0])
    return turns


def _clip_ears(points: Points, loop: list[int]) -> list[Triangle]:
    triangles = []
    loop = list(loop)
    while len(loop) >= 3:
        at = _best_ear(points, loop)
        triangles.append((loop[at - 1], loop[at], loop[(at + 1) % len(loop)]))
        del loop[at]
    return _without_slivers(points, [item for item in triangles if len(set(item)) == 3])


def _without_slivers(points: Points, triangles: list[Triangle]) -> list[Triangle]:
    """Remove triangles without area: their middle point splits the neighbour instead.

    Dropping them would leave an edge with a point on it, which is a crack in a solid.
    """
    smallest = _FLAT_SHARE * float(np.ptp(points, axis=0).max()) ** 2
    for _ in range(len(triangles)):
        flat = next((t for t in triangles if _turn(*points[list(t)]) <= smallest), None)
        if flat is None:
            break
        triangles.remove(flat)
        p, q, middle = _longest_edge_first(points, flat)
        neighbour = next((t for t in triangles if (q, p) in _edges(t)), None)
        if neighbour is not None:
            triangles.remove(neighbour)
            (apex,) = set(neighbour) - {p, q}
            triangles += [(q, middle, apex), (middle, p, apex)]
    return triangles


def _edges(triangle: Triangle) -> tuple[tuple[int, int], ...]:
    a, b, c = triangle
    return ((a, b), (b, c), (c, a))


def _longest_edge_first(points: Points, triangle: Triangle) -> Triangle:
    a, b, c = triangle
    turned = ((a, b, c), (b, c, a), (c, a, b))
    return max(turned, key=lambda t: float(np.linalg.norm(points[t[0]] - points[t[1]])))


def _best_ear(points: Points, loop: list[int]) -> int:
    for at in range(len(loop)):
        before, here, after = loop[at - 1], loop[at], loop[(at + 1) % len(loop)]
        a, b, c = points[before], points[here], points[after]
        if _turn(a, b, c) <= 0:
            continue
        others = points[loop]
        away = (others != a).any(axis=1) & (others != b).any(axis=1) & (others != c).any(axis=1)
        within = (_turns(a, b, others) >= 0) & (_turns(b, c, others) >= 0)
        within &= _turns(c, a, others) >= 0
        if not (within & away).any():
            return at
    # Only degenerate corners are left (points on one line): dropping the flattest loses no area.
    turns = [
        abs(_turn(points[loop[i - 1]], points[loop[i]], points[loop[(i + 1) % len(loop)]]))
        for i in range(len(loop))
    ]
    return int(np.argmin(turns))
