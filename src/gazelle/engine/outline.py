"""Cutting a simple polygon into triangles."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["ear_clipped"]

Point = tuple[float, float]


def ear_clipped(outline: Sequence[Point]) -> tuple[tuple[Point, Point, Point], ...]:
    """Cut a closed outline into triangles by clipping ears (Meisters 1975).

    Args:
        outline: corners in order, either direction; a repeated last corner is allowed.
    """
    corners = list(dict.fromkeys((float(x), float(y)) for x, y in outline))
    if _doubled_area(corners) < 0:
        corners.reverse()
    triangles: list[tuple[Point, Point, Point]] = []
    while len(corners) > 3:
        index = next((i for i in range(len(corners)) if _is_ear(corners, i)), 0)
        triangles.append((corners[index - 1], corners[index], corners[(index + 1) % len(corners)]))
        del corners[index]
    if len(corners) == 3:
        triangles.append((corners[0], corners[1], corners[2]))
    return tuple(triangles)


def _doubled_area(corners: Sequence[Point]) -> float:
    return sum(
        a[0] * b[1] - b[0] * a[1]
        for a, b in zip(corners, [*corners[1:], *corners[:1]], strict=True)
    )


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _is_ear(corners: Sequence[Point], index: int) -> bool:
    a, b, c = corners[index - 1], corners[index], corners[(index + 1) % len(corners)]
    if _turn(a, b, c) <= 0:
        return False
    others = (point for point in corners if point not in (a, b, c))
    return not any(
        _turn(a, b, p) >= 0 and _turn(b, c, p) >= 0 and _turn(c, a, p) >= 0 for p in others
    )
