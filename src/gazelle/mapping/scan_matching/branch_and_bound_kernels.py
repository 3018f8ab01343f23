# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled inner loops of branch and bound.

Bounds are sums of bytes, 255 of which are 1, rounded up; what decides is read from the field
itself. The smallest blocks have 4 × 4 shifts. A word holds the bytes of four neighbouring cells, 16
bits each, so that one addition counts a point for the four shifts of a row.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.kernels import kernel

__all__ = ["LEAF", "bound_search", "cells_of", "packed", "rounded_up", "sliding"]

LEAF = 2
"""The smallest blocks have 2^LEAF × 2^LEAF shifts."""

_SIDE = 1 << LEAF
_FULL = 255
# So many points a 16 bit sum holds.
_MAX = 256
# Points between two looks at whether the rest can still matter.
_PART = 40
# So many are sorted by insertion; so many parts wait at most.
_FEW = 15
_MAX_DEPTH = 100


class _Search(NamedTuple):
    """What the smallest blocks are searched with; see `bound_search`, and `sums` is scratch."""

    values: NDArray[np.float32]
    words: NDArray[np.uint64]
    cells: NDArray[np.int32]
    boxes: NDArray[np.int64]
    reach: int
    done: int
    sums: NDArray[np.int64]


@kernel
def rounded_up(field, out):
    """Fill `out`, uint8, with 255 times a field's values, within [0, 1], rounded up."""
    for y in range(field.shape[0]):
        row, bytes_ = field[y], out[y]
        for x in range(row.shape[0]):
            bytes_[x] = np.uint8(math.ceil(row[x] * np.float32(_FULL)))


@kernel
def packed(bytes_, out):
    """Fill `out`, uint64, with each cell and the three to its right, the lowest bits first."""
    height, width = bytes_.shape
    for y in range(height):
        row, words = bytes_[y], out[y]
        for x in range(width - 3):
            a, b = np.uint64(row[x]), np.uint64(row[x + 1])
            c, d = np.uint64(row[x + 2]), np.uint64(row[x + 3])
            words[x] = a | (b << np.uint64(16)) | (c << np.uint64(32)) | (d << np.uint64(48))
        for x in range(width - 3, width):
            words[x] = np.uint64(0)
            for k in range(width - x):
                words[x] |= np.uint64(row[x + k]) << np.uint64(16 * k)


@kernel
def sliding(level, step, out):
    """Fill `out` with the greatest of each cell and those `step` right, above and diagonal."""
    height, width = level.shape
    higher = np.empty(width, np.uint8)
    inner = max(0, width - step)
    shifted = higher[step:]
    for y in range(height):
        low, high, row = level[y], level[min(y + step, height - 1)], out[y]
        for x in range(width):
            higher[x] = low[x] if low[x] > high[x] else high[x]
        for x in range(inner):
            row[x] = higher[x] if higher[x] > shifted[x] else shifted[x]
        for x in range(inner, width):
            row[x] = max(higher[x], higher[width - 1])


@kernel
def cells_of(points, x, y, turns, cell, width):
    """Return in which cells points lie for every turn.

    Args:
        points: in the robot's frame, (n, 2).
        x: of the robot from the field's corner, metres.
        y: the same.
        turns: headings, (t,).
        cell: side of a cell, metres.
        width: cells in a row.

    Returns:
        int32 (t, 3, n), columns, rows and places in the flat field; int64 (t, 4), least column,
        least row, greatest column, greatest row.
    """
    n = points.shape[0]
    cells = np.empty((turns.shape[0], 3, n), np.int32)
    boxes = np.empty((turns.shape[0], 4), np.int64)
    for t in range(turns.shape[0]):
        c, s = math.cos(turns[t]), math.sin(turns[t])
        columns, rows, flat = cells[t, 0], cells[t, 1], cells[t, 2]
        left, low, right, high = 1 << 30, 1 << 30, -(1 << 30), -(1 << 30)
        for i in range(n):
            column = math.floor((c * points[i, 0] - s * points[i, 1] + x) / cell)
            row = math.floor((s * points[i, 0] + c * points[i, 1] + y) / cell)
            columns[i], rows[i], flat[i] = column, row, row * width + column
            left, right = min(left, column), max(right, column)
            low, high = min(low, row), max(high, row)
        boxes[t, 0], boxes[t, 1], boxes[t, 2], boxes[t, 3] = left, low, right, high
    return cells, boxes


@kernel
def _sum(values, cells, box, ix, iy, least, full):
    """Return the sum of shifted points' values; once `least` is out of reach, some lower one."""
    height, width = values.shape
    n = cells.shape[1]
    is_inside = (
        box[0] + ix >= 0 and box[1] + iy >= 0 and box[2] + ix < width and box[3] + iy < height
    )
    flat, places, shift = values.reshape(height * width), cells[2], iy * width + ix
    total = full * 0
    begin = 0
    while begin < n:
        end = min(begin + _PART, n)
        if is_inside:
            for i in range(begin, end):
                # Unsigned places need no check for negative ones.
                total += flat[np.uint64(places[i] + shift)]
        else:
            for i in range(begin, end):
                gx, gy = cells[0, i] + ix, cells[1, i] + iy
                if 0 <= gx < width and 0 <= gy < height:
                    total += values[gy, gx]
        if total + full * (n - end) <= least:
            return total * 0
        begin = end
    return total


@kernel
def _block_sums(words, cells, ix, iy, least, sums):
    """Fill `sums`, (4, 4), with the bounds of a block's shifts; tell if any may exceed `least`."""
    height, width = words.shape
    n = cells.shape[1]
    flat, places, shift = words.reshape(height * width), cells[2], iy * width + ix
    sums[:] = 0
    begin = 0
    while begin < n:
        end = min(begin + _MAX, n)
        a = b = c = d = np.uint64(0)
        for i in range(begin, end):
            place = places[i] + shift
            a += flat[np.uint64(place)]
            b += flat[np.uint64(place + width)]
            c += flat[np.uint64(place + 2 * width)]
            d += flat[np.uint64(place + 3 * width)]
        most = 0
        for k in range(_SIDE):
            bits = np.uint64(16 * k)
            sums[0, k] += np.int64((a >> bits) & np.uint64(0xFFFF))
            sums[1, k] += np.int64((b >> bits) & np.uint64(0xFFFF))
            sums[2, k] += np.int64((c >> bits) & np.uint64(0xFFFF))
            sums[3, k] += np.int64((d >> bits) & np.uint64(0xFFFF))
            most = max(most, sums[0, k], sums[1, k], sums[2, k], sums[3, k])
        if most + _FULL * (n - end) <= least:
            return False
        begin = end
    return True


@kernel
def _best_of_block(search, turn, ox, oy, best):
    """Return the best shift of a smallest block, (sum, columns, rows), as far as it exceeds."""
    values, reach, done, sums = search.values, search.reach, search.done, search.sums
    cells, box = search.cells[turn], search.boxes[turn]
    height, width = values.shape
    best_x, best_y = ox, oy
    if box[0] + ox < 0 or box[1] + oy < 0 or box[2] + ox >= width or box[3] + oy + 3 >= height:
        sums[:] = _FULL * cells.shape[1]
    elif not _block_sums(search.words, cells, ox, oy, best * _FULL, sums):
        return best, best_x, best_y
    for a in range(_SIDE):
        for b in range(_SIDE):
            is_done = max(abs(ox + b), abs(oy + a)) <= done
            if is_done or ox + b > reach or oy + a > reach:
                sums[a, b] = 0
    while True:
        a, b = 0, 0
        for k in range(_SIDE * _SIDE):
            if sums[k // _SIDE, k % _SIDE] > sums[a, b]:
                a, b = k // _SIDE, k % _SIDE
        if sums[a, b] <= best * _FULL:
            return best, best_x, best_y
        sums[a, b] = 0
        worth = _sum(values, cells, box, ox + b, oy + a, best, 1.0)
        if worth > best:
            best, best_x, best_y = worth, ox + b, oy + a


@kernel
def _descending(bounds):
    """Return the order of bounds from the greatest on.

    Which of equal ones comes first is the same each time.
    """
    count = bounds.shape[0]
    order = np.arange(count)
    stack = np.empty((_MAX_DEPTH, 2), np.int64)
    stack[0, 0], stack[0, 1] = 0, count - 1
    depth = 1
    while depth > 0:
        depth -= 1
        low, high = stack[depth, 0], stack[depth, 1]
        while high - low >= _FEW:
            at = _divided(bounds, order, low, high)
            # The longer part waits.
            if high - at > at - low:
                stack[depth, 0], stack[depth, 1] = at + 1, high
                high = at - 1
            else:
                stack[depth, 0], stack[depth, 1] = low, at - 1
                low = at + 1
            depth += 1
        for i in range(low + 1, high + 1):
            one = order[i]
            j = i
            while j > low and bounds[one] > bounds[order[j - 1]]:
                order[j] = order[j - 1]
                j -= 1
            order[j] = one
    return order


@kernel
def _divided(bounds, order, low, high):
    """Put what is greater than a middle one before it, the rest after it; return its place."""
    mid = (low + high) >> 1
    if bounds[order[mid]] > bounds[order[low]]:
        order[low], order[mid] = order[mid], order[low]
    if bounds[order[high]] > bounds[order[mid]]:
        order[high], order[mid] = order[mid], order[high]
    if bounds[order[mid]] > bounds[order[low]]:
        order[low], order[mid] = order[mid], order[low]
    pivot = bounds[order[mid]]
    order[high], order[mid] = order[mid], order[high]
    i, j = low, high - 1
    while True:
        while i < high and bounds[order[i]] > pivot:
            i += 1
        while j >= low and pivot > bounds[order[j]]:
            j -= 1
        if i >= j:
            break
        order[i], order[j] = order[j], order[i]
        i += 1
        j -= 1
    order[i], order[high] = order[high], order[i]
    return i


@kernel
def bound_search(values, words, levels, cells, boxes, reach, done, least):
    """Branch and bound over turns and whole-cell shifts (Hess et al. 2016).

    Args:
        values: the field, float32 (height, width).
        words: of `packed`.
        levels: uint8 (depth, height, width); level h holds the greatest value of the squares of
            2^(h + LEAF) cells a side that begin at each cell, rounded up.
        cells: of `cells_of`.
        boxes: the same.
        reach: half side of the window, in cells: what lies beyond is cut.
        done: half side of a window that was searched already, -1 when none was.
        least: mean value that must be exceeded.

    Returns:
        (turn, shift in columns, shift in rows, mean value); turn −1 when nothing exceeds it.
    """
    depth, turns, n = levels.shape[0], cells.shape[0], cells.shape[2]
    side = 1 << (depth - 1 + LEAF)
    across = 2 * reach // side + 1
    m = across * across
    best, best_turn, best_x, best_y = least * n, -1, 0, 0
    roots, bounds, count = np.empty(turns * m, np.int64), np.empty(turns * m), 0
    for t in range(turns):
        for k in range(m):
            x, y = k % across * side - reach, k // across * side - reach
            worth = _sum(levels[depth - 1], cells[t], boxes[t], x, y, best * _FULL, _FULL) / _FULL
            if worth > best:
                roots[count], bounds[count] = t * m + k, worth
                count += 1
    order = _descending(bounds[:count])
    stack = np.empty((4 * depth + 4, 3), np.int64)
    worths = np.empty(4 * depth + 4)
    sums = np.empty((_SIDE, _SIDE), np.int64)
    search = _Search(values, words, cells, boxes, reach, done, sums)
    for place in range(count):
        if bounds[order[place]] <= best:
            break
        root = roots[order[place]]
        turn = root // m
        stack[0, 0] = depth - 1
        stack[0, 1] = root % m % across * side - reach
        stack[0, 2] = root % m // across * side - reach
        worths[0] = bounds[order[place]]
        top = 1
        while top > 0:
            top -= 1
            if worths[top] <= best:
                continue
            h, ox, oy = stack[top, 0], stack[top, 1], stack[top, 2]
            if h == 0:
                worth, x, y = _best_of_block(search, turn, ox, oy, best)
                if worth > best:
                    best, best_turn, best_x, best_y = worth, turn, x, y
                continue
            half = 1 << (h - 1 + LEAF)
            first = top
            for a in range(2):
                for b in range(2):
                    x, y = ox + a * half, oy + b * half
                    if x > reach or y > reach:
                        continue
                    if min(x, y) >= -done and max(x, y) + half - 1 <= done:
                        continue
                    limit = best * _FULL
                    worth = _sum(levels[h - 1], cells[turn], boxes[turn], x, y, limit, _FULL)
                    worth /= _FULL
                    if worth <= best:
                        continue
                    # The best child is searched first: children stay sorted on the stack.
                    at = top
                    while at > first and worths[at - 1] > worth:
                        worths[at] = worths[at - 1]
                        for k in range(3):
                            stack[at, k] = stack[at - 1, k]
                        at -= 1
                    worths[at] = worth
                    stack[at, 0], stack[at, 1], stack[at, 2] = h - 1, x, y
                    top += 1
    return best_turn, best_x, best_y, best / n
