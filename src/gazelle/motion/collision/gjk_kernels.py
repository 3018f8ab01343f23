# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202, PLW3301
"""The compiled distance between two convex solids, as a bound that cannot be wrong.

The search is that of E. Gilbert, D. Johnson and S. Keerthi, "A fast procedure for computing the
distance between complex objects in three-dimensional space" (IEEE J. Robotics and Automation 4,
1988). What it says does not rest on its convergence: two solids are `APART` when they lie on both
sides of a slab of the thickness asked for, and they `OVERLAP` when a tetrahedron of their
difference holds the origin. What is neither is `UNKNOWN`.

Solids are given as `sweep_arguments.PlacedSolids`.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel

__all__ = [
    "APART",
    "BOX",
    "BOX_HALF",
    "CENTRE",
    "CYLINDER",
    "ELLIPSOID",
    "FIRST_VERTEX",
    "FRAME",
    "HALF",
    "HULL",
    "KIND",
    "OTHER",
    "OVERLAP",
    "PLANE",
    "POSITION",
    "RADIUS",
    "ROTATION",
    "ROUNDING",
    "SEGMENT",
    "SLACK",
    "UNKNOWN",
    "VERTICES",
    "outside_m",
    "separation",
    "slab_m",
]

APART, OVERLAP, UNKNOWN = 0, 1, 2

ROTATION, POSITION, HALF, ROUNDING, SLACK, CENTRE, RADIUS, BOX_HALF = 0, 9, 12, 15, 16, 17, 20, 21
"""Columns of a solid's row, see `convex_rows.ConvexRows`."""
KIND, FRAME, FIRST_VERTEX, VERTICES = range(4)
"""Columns of its integers."""
HULL, BOX, CYLINDER, SEGMENT, ELLIPSOID, PLANE, OTHER = range(7)
"""Kinds of solids. Of the last nothing is known."""

_MAX_ROUNDS = 32
_ATTEMPTS = 3
_DEEP_M = 5e-6
"""An overlap of less is left to MuJoCo, which stops its own search at a millionth of a metre."""


@kernel
def _support(number, placed, x, y, z, out, at):
    """Write the point of a solid that is farthest in a direction of the robot's frame."""
    solids, kinds, vertices = placed.rows, placed.kinds, placed.vertices_m
    R, p = placed.rotations, placed.positions_m
    frame = kinds[number, FRAME]
    u = R[frame, 0, 0] * x + R[frame, 1, 0] * y + R[frame, 2, 0] * z
    v = R[frame, 0, 1] * x + R[frame, 1, 1] * y + R[frame, 2, 1] * z
    w = R[frame, 0, 2] * x + R[frame, 1, 2] * y + R[frame, 2, 2] * z
    kind = kinds[number, KIND]
    if kind == HULL:
        first = kinds[number, FIRST_VERTEX]
        best, farthest = first, -1e300
        for corner in range(first, first + kinds[number, VERTICES]):
            reach = vertices[0, corner] * u + vertices[1, corner] * v + vertices[2, corner] * w
            if reach > farthest:
                best, farthest = corner, reach
        a, b, c = vertices[0, best], vertices[1, best], vertices[2, best]
    else:
        k = (
            solids[number, ROTATION] * u
            + solids[number, ROTATION + 3] * v
            + solids[number, ROTATION + 6] * w
        )
        m = (
            solids[number, ROTATION + 1] * u
            + solids[number, ROTATION + 4] * v
            + solids[number, ROTATION + 7] * w
        )
        n = (
            solids[number, ROTATION + 2] * u
            + solids[number, ROTATION + 5] * v
            + solids[number, ROTATION + 8] * w
        )
        i, j, h = 0.0, 0.0, 0.0
        if kind == BOX:
            i = math.copysign(solids[number, HALF], k)
            j = math.copysign(solids[number, HALF + 1], m)
            h = math.copysign(solids[number, HALF + 2], n)
        elif kind == CYLINDER:
            flat = math.sqrt(k * k + m * m)
            if flat > 1e-12:
                i, j = solids[number, HALF] * k / flat, solids[number, HALF] * m / flat
            h = math.copysign(solids[number, HALF + 1], n)
        elif kind == SEGMENT:
            h = math.copysign(solids[number, HALF + 1], n)
        elif kind == ELLIPSOID:
            i, j, h = (
                solids[number, HALF] * k,
                solids[number, HALF + 1] * m,
                solids[number, HALF + 2] * n,
            )
            length = math.sqrt(i * i + j * j + h * h)
            if length > 1e-300:
                i, j, h = (
                    i * solids[number, HALF] / length,
                    j * solids[number, HALF + 1] / length,
                    h * solids[number, HALF + 2] / length,
                )
        a = (
            solids[number, ROTATION] * i
            + solids[number, ROTATION + 1] * j
            + solids[number, ROTATION + 2] * h
            + solids[number, POSITION]
        )
        b = (
            solids[number, ROTATION + 3] * i
            + solids[number, ROTATION + 4] * j
            + solids[number, ROTATION + 5] * h
            + solids[number, POSITION + 1]
        )
        c = (
            solids[number, ROTATION + 6] * i
            + solids[number, ROTATION + 7] * j
            + solids[number, ROTATION + 8] * h
            + solids[number, POSITION + 2]
        )
    out[at, 0] = R[frame, 0, 0] * a + R[frame, 0, 1] * b + R[frame, 0, 2] * c + p[frame, 0]
    out[at, 1] = R[frame, 1, 0] * a + R[frame, 1, 1] * b + R[frame, 1, 2] * c + p[frame, 1]
    out[at, 2] = R[frame, 2, 0] * a + R[frame, 2, 1] * b + R[frame, 2, 2] * c + p[frame, 2]


@kernel(flags="nnan nsz reassoc")
def _farthest(vertices, first, last, u, v, w):
    """Return how far vertices reach in a direction; the machine looks at several at a time."""
    reach = -1e300
    for i in range(first, last):
        reach = max(reach, vertices[0, i] * u + vertices[1, i] * v + vertices[2, i] * w)
    return reach


@kernel
def _reach(number, placed, x, y, z):
    """Return how far a solid reaches in a direction of the robot's frame."""
    solids, kinds, vertices = placed.rows, placed.kinds, placed.vertices_m
    R, p = placed.rotations, placed.positions_m
    frame = kinds[number, FRAME]
    reach = p[frame, 0] * x + p[frame, 1] * y + p[frame, 2] * z
    u = R[frame, 0, 0] * x + R[frame, 1, 0] * y + R[frame, 2, 0] * z
    v = R[frame, 0, 1] * x + R[frame, 1, 1] * y + R[frame, 2, 1] * z
    w = R[frame, 0, 2] * x + R[frame, 1, 2] * y + R[frame, 2, 2] * z
    kind = kinds[number, KIND]
    if kind == HULL:
        first = kinds[number, FIRST_VERTEX]
        return reach + _farthest(vertices, first, first + kinds[number, VERTICES], u, v, w)
    reach += (
        solids[number, POSITION] * u
        + solids[number, POSITION + 1] * v
        + solids[number, POSITION + 2] * w
    )
    k = (
        solids[number, ROTATION] * u
        + solids[number, ROTATION + 3] * v
        + solids[number, ROTATION + 6] * w
    )
    m = (
        solids[number, ROTATION + 1] * u
        + solids[number, ROTATION + 4] * v
        + solids[number, ROTATION + 7] * w
    )
    n = (
        solids[number, ROTATION + 2] * u
        + solids[number, ROTATION + 5] * v
        + solids[number, ROTATION + 8] * w
    )
    if kind == BOX:
        return (
            reach
            + solids[number, HALF] * abs(k)
            + solids[number, HALF + 1] * abs(m)
            + solids[number, HALF + 2] * abs(n)
        )
    if kind == CYLINDER:
        return (
            reach
            + solids[number, HALF] * math.sqrt(k * k + m * m)
            + solids[number, HALF + 1] * abs(n)
        )
    if kind == SEGMENT:
        return reach + solids[number, HALF + 1] * abs(n)
    i, j, h = solids[number, HALF] * k, solids[number, HALF + 1] * m, solids[number, HALF + 2] * n
    return reach + math.sqrt(i * i + j * j + h * h)


@kernel
def slab_m(one, other, placed, axis):
    """Return how thick the slab across `axis` is that lies between two solids."""
    solids, kinds = placed.rows, placed.kinds
    if kinds[one, KIND] >= PLANE or kinds[other, KIND] >= PLANE:
        return -1e300
    x, y, z = axis[0], axis[1], axis[2]
    near = _reach(one, placed, -x, -y, -z)
    far = _reach(other, placed, x, y, z)
    larger = (
        solids[one, ROUNDING] + solids[other, ROUNDING] + solids[one, SLACK] + solids[other, SLACK]
    )
    return -near - far - larger


@kernel
def _dot(W, i, j):
    return W[i, 0] * W[j, 0] + W[i, 1] * W[j, 1] + W[i, 2] * W[j, 2]


@kernel
def _on_triangle(W, a, b, c, weights):
    """Write the weights of the point of a triangle that is nearest to the origin.

    Regions of corners, edges and face as in C. Ericson, "Real-Time Collision Detection", 5.1.5.
    """
    aa, bb, cc = _dot(W, a, a), _dot(W, b, b), _dot(W, c, c)
    ab, ac, bc = _dot(W, a, b), _dot(W, a, c), _dot(W, b, c)
    d1, d2 = aa - ab, aa - ac
    d3, d4 = ab - bb, ab - bc
    d5, d6 = ac - bc, ac - cc
    weights[0], weights[1], weights[2] = 0.0, 0.0, 0.0
    if d1 <= 0.0 and d2 <= 0.0:
        weights[0] = 1.0
        return
    if d3 >= 0.0 and d4 <= d3:
        weights[1] = 1.0
        return
    if d6 >= 0.0 and d5 <= d6:
        weights[2] = 1.0
        return
    vc = d1 * d4 - d3 * d2
    if vc <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        weights[1] = d1 / (d1 - d3)
        weights[0] = 1.0 - weights[1]
        return
    vb = d5 * d2 - d1 * d6
    if vb <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        weights[2] = d2 / (d2 - d6)
        weights[0] = 1.0 - weights[2]
        return
    va = d3 * d6 - d5 * d4
    if va <= 0.0 and d4 >= d3 and d5 >= d6:
        weights[2] = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        weights[1] = 1.0 - weights[2]
        return
    total = va + vb + vc
    weights[1], weights[2] = vb / total, vc / total
    weights[0] = 1.0 - weights[1] - weights[2]


@kernel
def _height(W, a, b, c, d):
    """Return how far the origin lies on the side of d from the plane of a, b and c."""
    ux, uy, uz = W[b, 0] - W[a, 0], W[b, 1] - W[a, 1], W[b, 2] - W[a, 2]
    vx, vy, vz = W[c, 0] - W[a, 0], W[c, 1] - W[a, 1], W[c, 2] - W[a, 2]
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    length = math.sqrt(nx * nx + ny * ny + nz * nz)
    if length < 1e-18:
        return -1.0
    far = nx * (W[d, 0] - W[a, 0]) + ny * (W[d, 1] - W[a, 1]) + nz * (W[d, 2] - W[a, 2])
    own = -(nx * W[a, 0] + ny * W[a, 1] + nz * W[a, 2])
    return (own if far >= 0.0 else -own) / length


@kernel
def _outward(W, v, work):
    """Find the side of a tetrahedron that is nearest to the origin in it.

    Writes its corners first, its outward normal into the last column of `work`, and how far off
    the other sides are into v[1].
    """
    nearest, least, second = 0, 1e300, 1e300
    for out in range(4):
        a, b, c = (out + 1) % 4, (out + 2) % 4, (out + 3) % 4
        height = _height(W, a, b, c, out)
        if height < least:
            nearest, least, second = out, height, least
        else:
            second = min(second, height)
    v[1] = second
    for k in range(3):
        W[nearest, k], W[3, k] = W[3, k], W[nearest, k]
    ux, uy, uz = W[1, 0] - W[0, 0], W[1, 1] - W[0, 1], W[1, 2] - W[0, 2]
    vx, vy, vz = W[2, 0] - W[0, 0], W[2, 1] - W[0, 1], W[2, 2] - W[0, 2]
    x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    length = math.sqrt(x * x + y * y + z * z)
    inwards = x * (W[3, 0] - W[0, 0]) + y * (W[3, 1] - W[0, 1]) + z * (W[3, 2] - W[0, 2])
    length = max(length, 1e-300) * (-1.0 if inwards > 0.0 else 1.0)
    work[0, 3], work[1, 3], work[2, 3] = x / length, y / length, z / length


@kernel
def _room(W):
    """Return how far the origin, in or near the first side, is from the others at least."""
    return min(
        abs(_height(W, 0, 1, 3, 2)), min(abs(_height(W, 1, 2, 3, 0)), abs(_height(W, 0, 2, 3, 1)))
    )


@kernel
def _nearest(W, count, v, weights, best):
    """Write the point of a simplex nearest to the origin; keep only the corners it needs.

    Returns the corners kept, or 0 where a tetrahedron holds the origin; its depth is in v[0] then.
    """
    if count == 1:
        for k in range(3):
            v[k] = W[0, k]
        return 1
    if count == 2:
        aa, ab, bb = _dot(W, 0, 0), _dot(W, 0, 1), _dot(W, 1, 1)
        square = aa - 2.0 * ab + bb
        t = (aa - ab) / square if square > 1e-300 else 0.0
        t = min(1.0, max(0.0, t))
        best[0], best[1], best[2], best[3] = 1.0 - t, t, 0.0, 0.0
    elif count == 3:
        _on_triangle(W, 0, 1, 2, weights)
        best[0], best[1], best[2], best[3] = weights[0], weights[1], weights[2], 0.0
    else:
        inside = min(
            min(_height(W, 1, 2, 3, 0), _height(W, 0, 2, 3, 1)),
            min(_height(W, 0, 1, 3, 2), _height(W, 0, 1, 2, 3)),
        )
        if inside >= 0.0:
            v[0] = inside
            return 0
        least = 1e300
        for left_out in range(4):
            a = 1 if left_out == 0 else 0
            b = 2 if left_out <= 1 else 1
            c = 3 if left_out <= 2 else 2
            _on_triangle(W, a, b, c, weights)
            square = 0.0
            for k in range(3):
                part = weights[0] * W[a, k] + weights[1] * W[b, k] + weights[2] * W[c, k]
                square += part * part
            if square < least:
                least = square
                best[0], best[1], best[2], best[3] = 0.0, 0.0, 0.0, 0.0
                best[a], best[b], best[c] = weights[0], weights[1], weights[2]
    kept = 0
    v[0], v[1], v[2] = 0.0, 0.0, 0.0
    for i in range(count):
        if best[i] > 0.0:
            for k in range(3):
                v[k] += best[i] * W[i, k]
                W[kept, k] = W[i, k]
            kept += 1
    return kept


@kernel
def separation(one, other, placed, enough, least, axis, work):
    """Say how two solids lie to each other.

    Args:
        one: number of a solid.
        other: number of another.
        placed: the solids.
        enough: distance in metres that is asked for.
        least: where they are not further apart than this it does not matter how far.
        axis: unit vector from the other to the one to begin with; the best one when it returns.
        work: scratch of (9, 4).

    Returns:
        `APART` with a distance that is certain, more than `enough` where that could be shown;
        `OVERLAP`, or `UNKNOWN`, with a distance that is not more than the real one.
    """
    solids, kinds = placed.rows, placed.kinds
    if kinds[one, KIND] == PLANE:
        one, other = other, one
    if kinds[one, KIND] >= PLANE or kinds[other, KIND] > PLANE:
        return UNKNOWN, -1.0
    rounding = solids[one, ROUNDING] + solids[other, ROUNDING]
    slack = solids[one, SLACK] + solids[other, SLACK]
    if kinds[other, KIND] == PLANE:
        r, o = placed.rotations[kinds[other, FRAME]], placed.positions_m[kinds[other, FRAME]]
        row = solids[other]
        for k in range(3):
            axis[k] = (
                r[k, 0] * row[ROTATION + 2]
                + r[k, 1] * row[ROTATION + 5]
                + r[k, 2] * row[ROTATION + 8]
            )
            work[2, k] = (
                r[k, 0] * row[POSITION]
                + r[k, 1] * row[POSITION + 1]
                + r[k, 2] * row[POSITION + 2]
                + o[k]
            )
        _support(one, placed, -axis[0], -axis[1], -axis[2], work, 0)
        clear = -rounding
        for k in range(3):
            clear += axis[k] * (work[0, k] - work[2, k])
        if clear - slack > 0.0:
            return APART, clear - slack
        return (OVERLAP if clear < -_DEEP_M and slack == 0.0 else UNKNOWN), clear - slack
    W, v, weights, best = work[2:6], work[6], work[7], work[8]
    clear = -1e300
    for attempt in range(_ATTEMPTS):
        # Where the origin lies on an edge of the difference the first search may see too little.
        x, y, z = axis[0], axis[1], axis[2]
        if attempt == 1:
            x, y, z = 0.36, 0.48, 0.8
        elif attempt == 2:
            x, y, z = -0.64, 0.6, -0.48
        count, length, last = 0, 1.0, 1e300
        for _ in range(_MAX_ROUNDS):
            _support(one, placed, -x, -y, -z, work, 0)
            _support(other, placed, x, y, z, work, 1)
            for k in range(3):
                W[count, k] = work[0, k] - work[1, k]
            reach = x * W[count, 0] + y * W[count, 1] + z * W[count, 2]
            if reach - rounding - slack > clear:
                clear = reach - rounding - slack
                axis[0], axis[1], axis[2] = x, y, z
                if clear > enough:
                    return APART, clear
            if count > 0 and length - reach <= 1e-6 * length + 1e-9:
                break
            count = _nearest(W, count + 1, v, weights, best)
            if count == 0:
                if v[0] <= _DEEP_M:
                    _outward(W, v, work)
                    x, y, z = work[0, 3], work[1, 3], work[2, 3]
                    _support(one, placed, x, y, z, work, 0)
                    _support(other, placed, -x, -y, -z, work, 1)
                    for k in range(3):
                        W[3, k] = work[0, k] - work[1, k]
                    v[0] = min(v[1], _room(W))
                if v[0] > _DEEP_M:
                    return OVERLAP, -v[0]
                break
            length = math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
            if length < 1e-9 or length >= last or count == 4:
                break
            last = length
            if length <= rounding - _DEEP_M:
                return OVERLAP, length - rounding
            if clear > 0.0 and length - rounding - slack <= least:
                return APART, clear
            x, y, z = v[0] / length, v[1] / length, v[2] / length
        if clear > 0.0:
            return APART, clear
    return UNKNOWN, clear


@kernel
def outside_m(points, corners):
    """Return how far points lie outside the hull of corners at most, 0 for those inside."""
    found = np.zeros(len(points))
    work = np.empty((7, 4))
    W, v, weights, best = work[:4], work[4], work[5], work[6]
    for i in range(len(points)):
        for k in range(3):
            v[k] = corners[0, k] - points[i, k]
            W[0, k] = v[k]
        count, last = 1, 1e300
        for _ in range(_MAX_ROUNDS):
            square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
            if square >= last or square < 1e-18:
                break
            last = square
            farthest, reach = 0, 1e300
            for j in range(len(corners)):
                own = corners[j, 0] * v[0] + corners[j, 1] * v[1] + corners[j, 2] * v[2]
                if own < reach:
                    farthest, reach = j, own
            reach -= points[i, 0] * v[0] + points[i, 1] * v[1] + points[i, 2] * v[2]
            if square - reach <= 1e-6 * square:
                break
            for k in range(3):
                W[count, k] = corners[farthest, k] - points[i, k]
            count = _nearest(W, count + 1, v, weights, best)
            if count == 0:
                last = 0.0
                break
        found[i] = math.sqrt(min(last, v[0] * v[0] + v[1] * v[1] + v[2] * v[2])) if count else 0.0
    return found
