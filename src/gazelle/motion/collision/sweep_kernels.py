# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled check of a whole motion: whether all of it is free, not only some states of it.

Conservative advancement as F. Schwarzer, M. Saha and J.-C. Latombe use it for arms, "Adaptive
dynamic collision checking for single and multiple articulated robots in complex environments"
(IEEE Trans. Robotics 21, 2005): no point of a link moves further than the joints above it turn
times how far from them it can be. Two solids that are further apart in the middle of a motion than
both can move until its ends do not meet on it; other pairs are looked at in both halves, down to
the step that was asked for.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel
from gazelle.motion.collision.gjk_kernels import (
    APART,
    BOX_HALF,
    CENTRE,
    FRAME,
    OVERLAP,
    RADIUS,
    separation,
    slab_m,
)
from gazelle.motion.collision.sweep_arguments import PASSING, Carried
from gazelle.motion.kinematics.kernels import tree

__all__ = ["COLLIDES", "FREE", "MAX_STEPS", "TOO_LONG", "UNDECIDED", "pair_clear", "sweep"]

FREE, COLLIDES, UNDECIDED, TOO_LONG = 0, 1, 2, 3

MAX_STEPS = 10_000
"""Longer motions are looked at piece by piece, or room for their parts would be too large."""

_NEVER_M = 1e300
_ONLY_A_LOOK = -1.0
# Of so many pairs of solids on the way of so short a piece all are looked at, the exact ones.
_FEW = 64
_SHORT = 0.05
_LOOK_EVERY = 0.4
_MAX_LOOKS = 63


@kernel
def _ball(number, placed, out, at):
    """Write the centre of a solid's ball in the robot's frame."""
    solids, kinds, R, p = placed.rows, placed.kinds, placed.rotations, placed.positions_m
    frame = kinds[number, FRAME]
    x, y, z = solids[number, CENTRE], solids[number, CENTRE + 1], solids[number, CENTRE + 2]
    for k in range(3):
        out[at, k] = R[frame, k, 0] * x + R[frame, k, 1] * y + R[frame, k, 2] * z + p[frame, k]


@kernel
def _clear(one, other, placed, enough, passings, axis, work):
    """Return `separation` of two solids, their balls looked at first, and whether it is enough."""
    solids, passing = placed.rows, passings[0]
    _ball(one, placed, work, 0)
    _ball(other, placed, work, 1)
    square = 0.0
    for k in range(3):
        work[2, k] = work[0, k] - work[1, k]
        square += work[2, k] * work[2, k]
        # How far the solids' centres are from those of the links or things they are of.
        passing.offsets_m[0, k] = work[0, k] - passing.centres_m[0, k]
        passing.offsets_m[1, k] = work[1, k] - passing.centres_m[1, k]
    passing.radii_m[0], passing.radii_m[1] = solids[one, RADIUS], solids[other, RADIUS]
    gap = math.sqrt(square)
    clear = gap - solids[one, RADIUS] - solids[other, RADIUS]
    if clear > enough:
        return APART, clear, True
    if axis[0] == 0.0 and axis[1] == 0.0 and axis[2] == 0.0:
        if gap > 1e-9:
            for k in range(3):
                axis[k] = work[2, k] / gap
        else:
            axis[0] = 1.0
    else:
        clear = slab_m(one, other, placed, axis)
        if _is_enough(clear, enough, passings, axis):
            return APART, clear, True
    least = min(enough, passing.changed_m)
    state, clear = separation(one, other, placed, enough, least, axis, work)
    return state, clear, state == APART and _is_enough(clear, enough, passings, axis)


@kernel
def _is_enough(clear, enough, passings, axis):
    """Tell whether two solids are so far apart across `axis` that they do not meet.

    They may come closer by `enough` in any direction; across this one less, see `_pass`.
    """
    passing = passings[0]
    if clear > enough:
        return True
    if clear <= passing.changed_m:
        return False
    x, y, z = axis[0], axis[1], axis[2]
    along = x * passing.way_m[0] + y * passing.way_m[1] + z * passing.way_m[2]
    around = 0.0
    for side in range(2):
        u, v, w = passing.turns_rad[side, 0], passing.turns_rad[side, 1], passing.turns_rad[side, 2]
        a, b, c = y * w - z * v, z * u - x * w, x * v - y * u
        across = math.sqrt(a * a + b * b + c * c)
        # A floor has no end, and it does not turn.
        if across > 0.0:
            around += across * passing.radii_m[side]
            off = passing.offsets_m[side]
            part = a * off[0] + b * off[1] + c * off[2]
            along += part if side == 0 else -part
    return clear > abs(along) + around + passing.changed_m


@kernel
def _box(body, members, placed, carried):
    """Write the box around a link or thing whose sides are along the robot's axes."""
    solids, kinds, R, p = placed.rows, placed.kinds, placed.rotations, placed.positions_m
    centres, halves = carried.centres_m, carried.halves_m
    number = members[body, 0]
    frame = kinds[number, FRAME]
    for k in range(3):
        x, y, z = R[frame, k, 0], R[frame, k, 1], R[frame, k, 2]
        centres[body, k] = (
            x * solids[number, CENTRE]
            + y * solids[number, CENTRE + 1]
            + z * solids[number, CENTRE + 2]
        ) + p[frame, k]
        halves[body, k] = (
            abs(x) * solids[number, BOX_HALF] + abs(y) * solids[number, BOX_HALF + 1]
        ) + abs(z) * solids[number, BOX_HALF + 2]


@kernel
def pair_clear(pair, bodies, placed, enough, few, passings, work):
    """Say how two links or things lie to each other, with the distance that is certain.

    Says, too, whether that is enough, see `_is_enough`.

    Of several solids the one around all is looked at first, and no other where that is apart and
    there are more than `few`: how far exactly is seen in the halves of a motion sooner.
    """
    passing, members, axes = passings[0], bodies.members, bodies.axes
    kinds, R = placed.kinds, placed.rotations
    a, b = bodies.pairs[pair, 0], bodies.pairs[pair, 1]
    first, last = members[a, 1], members[a, 1] + members[a, 2]
    begin, end = members[b, 1], members[b, 1] + members[b, 2]
    around, about = members[a, 0], members[b, 0]
    # Directions are kept in the frame of the second, so that they turn with it.
    frame = kinds[about, FRAME]
    x, y, z = axes[pair, 0], axes[pair, 1], axes[pair, 2]
    for k in range(3):
        work[9, k] = R[frame, k, 0] * x + R[frame, k, 1] * y + R[frame, k, 2] * z
    state, clear, is_enough = _clear(around, about, placed, enough, passings, work[9], work)
    x, y, z = work[9, 0], work[9, 1], work[9, 2]
    for k in range(3):
        axes[pair, k] = R[frame, 0, k] * x + R[frame, 1, k] * y + R[frame, 2, k] * z
    are_many = (last - first) * (end - begin) > few
    if is_enough or (state == APART and are_many) or (around == first and about == begin):
        return state, clear, is_enough
    if end - begin > last - first:
        first, last, begin, end, about = begin, end, first, last, around
        _swap(passings)
    least, worst, are_enough = 1e300, APART, True
    for i in range(first, last):
        _forget(work)
        state, clear, is_enough = _clear(i, about, placed, enough, passings, work[9], work)
        if is_enough:
            least = min(least, clear)
            continue
        for j in range(begin, end):
            _forget(work)
            state, clear, is_enough = _clear(i, j, placed, enough, passings, work[9], work)
            if state == OVERLAP:
                return OVERLAP, clear, False
            least = min(least, clear)
            if not is_enough:
                # No more than this can be shown: whether any two overlap is all that is left.
                are_enough, enough, passing.changed_m = False, 0.0, _NEVER_M
            if state != APART:
                worst = state
    return worst, least, are_enough


@kernel
def _swap(passings):
    """Let the first be the second, and the other way round."""
    passing = passings[0]
    way, turns, centres = passing.way_m, passing.turns_rad, passing.centres_m
    for k in range(3):
        way[k] = -way[k]
        turns[0, k], turns[1, k] = turns[1, k], turns[0, k]
        centres[0, k], centres[1, k] = centres[1, k], centres[0, k]


@kernel
def _forget(work):
    work[9, 0], work[9, 1], work[9, 2] = 0.0, 0.0, 0.0


@kernel
def _carried(way, motions, carried):
    """Write how far each joint turns on a way, rad, and how far it carries each link or thing.

    The second is a bound; beside it stands how far the joints behind it carry the same, m.
    """
    moves, turns = motions.moves, motions.turns
    rates, below = carried.rates_rad, carried.bounds_m
    for j in range(moves.shape[1]):
        rates[j] = 0.0
        for k in range(len(way)):
            rates[j] += way[k] * turns[j, k]
    for body in range(moves.shape[0]):
        behind = 0.0
        for j in range(moves.shape[1] - 1, -1, -1):
            own = 0.0
            for k in range(len(way)):
                own += abs(way[k]) * moves[body, j, k]
            below[body, j, 0], below[body, j, 1] = own, behind
            behind += own


@kernel
def _axes(motions, placed, carried):
    """Write the axis of each joint that turns, and a point of it."""
    joints, joint_lines, lines = motions.joints, motions.lines, carried.lines
    R, p = placed.rotations, placed.positions_m
    for j in range(len(joints)):
        link = joints[j]
        if link < 0:
            continue
        for k in range(3):
            lines[j, k] = _along(R, link, k, joint_lines, j, 0)
            lines[j, 3 + k] = _along(R, link, k, joint_lines, j, 3) + p[link, k]


@kernel
def _carried_from(body, radius, half, joints, carried):
    """Write how far each joint carries a link or thing from where it is, m.

    A joint that turns carries no point further than the point is away from its axis: how far that
    is now, and how much further the joints behind it can carry it. All of it is within a radius.
    """
    lines, rates, below = carried.lines, carried.rates_rad, carried.bounds_m
    centres, out = carried.centres_m, carried.carried_m
    for j in range(len(joints)):
        most = half * below[body, j, 0]
        if joints[j] >= 0 and most > 0.0:
            x, y, z = lines[j, 0], lines[j, 1], lines[j, 2]
            a = centres[body, 0] - lines[j, 3]
            b = centres[body, 1] - lines[j, 4]
            c = centres[body, 2] - lines[j, 5]
            k, m, n = y * c - z * b, z * a - x * c, x * b - y * a
            away = math.sqrt(k * k + m * m + n * n) + radius
            most = min(most, half * abs(rates[j]) * (away + half * below[body, j, 1]))
        out[body, j] = most


@kernel
def _pass(pair, half, bodies, motions, carried, passings):
    """Write how two links or things pass each other while joints turn.

    Across one direction two come closer by what the speed of now has there, and by what that speed
    can change: no point of a link is accelerated by more than, for each joint, how fast the joint
    carries it, times how fast that joint and twice those before it turn. All is seen from the
    last link that both hang from.

    Leaves the places for solids, see `PASSING`, as they are.
    """
    apart, one, other = bodies.apart, bodies.pairs[pair, 0], bodies.pairs[pair, 1]
    joints, above = motions.joints, motions.above
    rates, lines, centres = carried.rates_rad, carried.lines, carried.centres_m
    passing = passings[0]
    way, turns = passing.way_m, passing.turns_rad
    passing.changed_m = _NEVER_M
    passing.radii_m[0], passing.radii_m[1] = 0.0, 0.0
    for k in range(3):
        way[k] = 0.0
        turns[0, k], turns[1, k] = 0.0, 0.0
        passing.centres_m[0, k], passing.centres_m[1, k] = centres[one, k], centres[other, k]
    changed, turned_one, turned_other = 0.0, 0.0, 0.0
    for j in range(len(joints)):
        if not apart[pair, j]:
            continue
        if joints[j] < 0:
            return
        body = one if above[one, j] else other
        turn = half * rates[j]
        x, y, z = turn * lines[j, 0], turn * lines[j, 1], turn * lines[j, 2]
        a = centres[body, 0] - lines[j, 3]
        b = centres[body, 1] - lines[j, 4]
        c = centres[body, 2] - lines[j, 5]
        sign, side = (1.0, 0) if body == one else (-1.0, 1)
        way[0] += sign * (y * c - z * b)
        way[1] += sign * (z * a - x * c)
        way[2] += sign * (x * b - y * a)
        turns[side, 0] += x
        turns[side, 1] += y
        turns[side, 2] += z
        before = turned_one if body == one else turned_other
        changed += carried.carried_m[body, j] * (abs(turn) + 2.0 * before)
        if body == one:
            turned_one += abs(turn)
        else:
            turned_other += abs(turn)
    passing.changed_m = changed / 2.0


@kernel
def _along(R, frame, k, lines, j, at):
    return (
        R[frame, k, 0] * lines[j, at]
        + R[frame, k, 1] * lines[j, at + 1]
        + R[frame, k, 2] * (lines[j, at + 2])
    )


@kernel
def _to_the_front(pair, order):
    before = order[0]
    order[0] = pair
    place = 0
    while before != pair:
        place += 1
        before, order[place] = order[place], before


@kernel
def _first_looks(length):
    """Return at how many states to look first: most motions that are not free show it there."""
    looks = 0
    while looks < _MAX_LOOKS and length > _LOOK_EVERY * (looks + 1):
        looks = 2 * looks + 1
    return looks


@kernel
def sweep(q0, way, step, arguments):
    """Say whether a motion from `q0` along `way` is free; its beginning is not looked at.

    Where `way` is zero only the state is looked at.

    Args:
        q0: configuration of the group.
        way: what is added to it.
        step: longest piece, in the configuration's norm, of which only the middle is looked at.
        arguments: all of the robot and its surroundings, a `SweepArguments`.

    Returns:
        `FREE`; `COLLIDES` and where, 0 to 1; `UNDECIDED` and how many states are; or `TOO_LONG`.
    """
    links, group, motions, bodies, placed, work, doubtful = arguments
    positions, indices, followers = group.positions, group.indices, group.followers
    members, pairs, order = bodies.members, bodies.pairs, bodies.order
    n, count = len(q0), len(pairs)
    length = 0.0
    for k in range(n):
        length += way[k] * way[k]
    length = math.sqrt(length)
    moved, moving = motions.moves.shape[0], motions.moves.shape[1]
    carried = Carried(
        np.empty(moving), np.empty((moved, moving, 2)), np.empty((moving, 6)),
        np.zeros((moved, moving)), np.empty((len(members), 3)), np.empty((len(members), 3)),
    )  # fmt: skip
    centres, halves_m, carried_m = carried.centres_m, carried.halves_m, carried.carried_m
    passings = np.zeros(1, PASSING)
    if length > 0.0:
        _carried(way, motions, carried)
    first_looks = _first_looks(length)
    most = 4 * int(length / step) + 16 + first_looks
    middles, halves = np.empty(most), np.empty(most)
    begins, ends = np.empty(most, np.int64), np.empty(most, np.int64)
    lists = np.empty(4 * count + 4096, np.int64)
    seen = np.full(len(members), -1)
    for i in range(count):
        lists[i] = order[i]
    # The end; some states, whether any two overlap there; then the middle of all, the middles of
    # both halves, and so on, and whatever is near there.
    for i in range(first_looks + 2):
        begins[i], ends[i] = 0, count
        halves[i] = _ONLY_A_LOOK
    middles[0], halves[0] = 1.0, 0.0
    for i in range(1, first_looks + 1):
        part = 1
        while 2 * part <= i:
            part *= 2
        middles[i] = (2 * (i - part) + 1) / (2.0 * part)
    middles[first_looks + 1], halves[first_looks + 1] = 0.5, 0.5
    here, waiting, used, doubts = 0, first_looks + 2 if length > 0.0 else 1, count, 0
    while here < waiting:
        t, half = middles[here], halves[here]
        is_leaf = 2.0 * half * length <= step
        few = _FEW if 2.0 * half * length <= _SHORT else 0
        for k in range(n):
            positions[indices[k]] = q0[k] + way[k] * t
        for k in range(len(followers)):
            leader = positions[indices[group.leaders[k]]]
            positions[followers[k]] = group.rules[k, 0] * leader + group.rules[k, 1]
        tree(links, positions, placed.rotations, placed.positions_m)
        if not is_leaf:
            _axes(motions, placed, carried)
        kept, is_sure = used, True
        if used + ends[here] - begins[here] > len(lists):
            longer = np.empty(2 * len(lists) + count, np.int64)
            for i in range(used):
                longer[i] = lists[i]
            lists = longer
        for place in range(begins[here], ends[here]):
            pair = lists[place]
            one, other = pairs[pair, 0], pairs[pair, 1]
            for body in (one, other):
                # Of a deep half few pairs are left, and most links are in none of them.
                if seen[body] != here:
                    seen[body] = here
                    _box(body, members, placed, carried)
                    if not is_leaf:
                        radius = placed.rows[members[body, 0], RADIUS]
                        _carried_from(body, radius, half, motions.joints, carried)
            enough = 0.0
            if not is_leaf:
                for k in range(moving):
                    if bodies.apart[pair, k]:
                        enough += carried_m[one, k] + carried_m[other, k]
            is_far = False
            for k in range(3):
                gap = abs(centres[one, k] - centres[other, k])
                gap -= halves_m[one, k] + halves_m[other, k]
                is_far = is_far or gap > enough
            if is_far:
                continue
            passings[0].changed_m = _NEVER_M
            if not is_leaf:
                _pass(pair, half, bodies, motions, carried, passings)
            state, _, is_enough = pair_clear(pair, bodies, placed, enough, few, passings, work)
            if state == OVERLAP:
                _to_the_front(pair, order)
                return COLLIDES, t
            if is_enough or half == _ONLY_A_LOOK:
                continue
            lists[kept] = pair
            kept += 1
            is_sure = is_sure and state == APART
        if is_leaf:
            if not is_sure:
                if doubts == len(doubtful):
                    return TOO_LONG, t
                doubtful[doubts] = t
                doubts += 1
        elif kept > used:
            for side in range(2):
                middles[waiting] = t + (half if side else -half) / 2.0
                halves[waiting] = half / 2.0
                begins[waiting], ends[waiting] = used, kept
                waiting += 1
            used = kept
        here += 1
    return (UNDECIDED if doubts else FREE), float(doubts)
