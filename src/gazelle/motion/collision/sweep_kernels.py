# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202, C901, PLR0915, PLR0917
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

from gazelle.compiling import njit
from gazelle.motion.collision.gjk_kernels import APART, OVERLAP, separation, slab_m
from gazelle.motion.kinematics.kernels import tree

__all__ = ["COLLIDES", "FREE", "TOO_LONG", "UNDECIDED", "pair_clear", "sweep"]

FREE, COLLIDES, UNDECIDED, TOO_LONG = 0, 1, 2, 3


@njit(cache=True, nogil=True)
def _ball(number, solids, kinds, R, p, out, at):
    """Write the centre of a solid's ball in the robot's frame."""
    frame = kinds[number, 1]
    x, y, z = solids[number, 17], solids[number, 18], solids[number, 19]
    for k in range(3):
        out[at, k] = R[frame, k, 0] * x + R[frame, k, 1] * y + R[frame, k, 2] * z + p[frame, k]


@njit(cache=True, nogil=True)
def _clear(one, other, solids, kinds, vertices, R, p, enough, axis, work):
    """Return `separation` of two solids, their balls looked at first."""
    _ball(one, solids, kinds, R, p, work, 0)
    _ball(other, solids, kinds, R, p, work, 1)
    square = 0.0
    for k in range(3):
        work[2, k] = work[0, k] - work[1, k]
        square += work[2, k] * work[2, k]
    gap = math.sqrt(square)
    clear = gap - solids[one, 20] - solids[other, 20]
    if clear > enough:
        return APART, clear
    if axis[0] == 0.0 and axis[1] == 0.0 and axis[2] == 0.0:
        if gap > 1e-9:
            for k in range(3):
                axis[k] = work[2, k] / gap
        else:
            axis[0] = 1.0
    else:
        clear = slab_m(one, other, solids, kinds, vertices, R, p, axis)
        if clear > enough:
            return APART, clear
    return separation(one, other, solids, kinds, vertices, R, p, enough, axis, work)


@njit(cache=True, nogil=True)
def _boxes(members, solids, kinds, R, p, centres, halves):
    """Write boxes around links and things whose sides are along the robot's axes."""
    for body in range(len(members)):
        number = members[body, 0]
        frame = kinds[number, 1]
        for k in range(3):
            x, y, z = R[frame, k, 0], R[frame, k, 1], R[frame, k, 2]
            centres[body, k] = (
                x * solids[number, 17] + y * solids[number, 18] + z * solids[number, 19]
            ) + p[frame, k]
            halves[body, k] = (abs(x) * solids[number, 21] + abs(y) * solids[number, 22]) + abs(
                z
            ) * solids[number, 23]


@njit(cache=True, nogil=True)
def pair_clear(pair, pairs, members, solids, kinds, vertices, R, p, enough, axes, work):
    """Say how two links or things lie to each other, with the distance that is certain.

    Of several solids the one around all is looked at first, and no other where it is apart: how
    far exactly is seen in the halves of a motion sooner than in its many solids.
    """
    a, b = pairs[pair, 0], pairs[pair, 1]
    first, last = members[a, 1], members[a, 1] + members[a, 2]
    begin, end = members[b, 1], members[b, 1] + members[b, 2]
    around, about = members[a, 0], members[b, 0]
    # Directions are kept in the frame of the second, so that they turn with it.
    frame = kinds[about, 1]
    x, y, z = axes[pair, 0], axes[pair, 1], axes[pair, 2]
    for k in range(3):
        work[9, k] = R[frame, k, 0] * x + R[frame, k, 1] * y + R[frame, k, 2] * z
    state, clear = _clear(around, about, solids, kinds, vertices, R, p, enough, work[9], work)
    x, y, z = work[9, 0], work[9, 1], work[9, 2]
    for k in range(3):
        axes[pair, k] = R[frame, 0, k] * x + R[frame, 1, k] * y + R[frame, 2, k] * z
    if state == APART or (around == first and about == begin):
        return state, clear
    if end - begin > last - first:
        first, last, begin, end, about = begin, end, first, last, around
    least, worst = 1e300, APART
    for i in range(first, last):
        _forget(work)
        state, clear = _clear(i, about, solids, kinds, vertices, R, p, enough, work[9], work)
        if state == APART and clear > enough:
            least = min(least, clear)
            continue
        for j in range(begin, end):
            _forget(work)
            state, clear = _clear(i, j, solids, kinds, vertices, R, p, enough, work[9], work)
            if state == OVERLAP:
                return OVERLAP, clear
            least = min(least, clear)
            if clear <= enough:
                # No more than this can be shown: whether any two overlap is all that is left.
                enough = 0.0
            if state != APART:
                worst = state
    return worst, least


@njit(cache=True, nogil=True)
def _forget(work):
    work[9, 0], work[9, 1], work[9, 2] = 0.0, 0.0, 0.0


@njit(cache=True, nogil=True)
def _carried(way, moves, motions, rates, below):
    """Write how far each joint turns on a way, rad, and how far it carries each link or thing.

    Both are bounds; beside the second stands how far the joints behind it carry the same, m.
    """
    for j in range(moves.shape[1]):
        rates[j] = 0.0
        for k in range(len(way)):
            rates[j] += abs(way[k]) * motions[j, k]
    for body in range(moves.shape[0]):
        behind = 0.0
        for j in range(moves.shape[1] - 1, -1, -1):
            own = 0.0
            for k in range(len(way)):
                own += abs(way[k]) * moves[body, j, k]
            below[body, j, 0], below[body, j, 1] = own, behind
            behind += own


@njit(cache=True, nogil=True)
def _carried_from(half, joints, joint_lines, rates, below, members, solids, R, p, centres, out):
    """Write how far each joint carries each link or thing from where it is, m.

    A joint that turns carries no point further than the point is away from its axis: how far that
    is now, and how much further the joints behind it can carry it.
    """
    for j in range(len(joints)):
        link = joints[j]
        x, y, z, u, v, w = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        if link >= 0:
            x = _along(R, link, 0, joint_lines, j, 0)
            y = _along(R, link, 1, joint_lines, j, 0)
            z = _along(R, link, 2, joint_lines, j, 0)
            u = _along(R, link, 0, joint_lines, j, 3) + p[link, 0]
            v = _along(R, link, 1, joint_lines, j, 3) + p[link, 1]
            w = _along(R, link, 2, joint_lines, j, 3) + p[link, 2]
        for body in range(len(members)):
            most = half * below[body, j, 0]
            if link >= 0 and most > 0.0:
                a, b, c = centres[body, 0] - u, centres[body, 1] - v, centres[body, 2] - w
                k, m, n = y * c - z * b, z * a - x * c, x * b - y * a
                away = math.sqrt(k * k + m * m + n * n) + solids[members[body, 0], 20]
                most = min(most, half * rates[j] * (away + half * below[body, j, 1]))
            out[body, j] = most


@njit(cache=True, nogil=True)
def _along(R, frame, k, lines, j, at):
    return (
        R[frame, k, 0] * lines[j, at]
        + R[frame, k, 1] * lines[j, at + 1]
        + R[frame, k, 2] * (lines[j, at + 2])
    )


@njit(cache=True, nogil=True)
def _to_the_front(pair, order):
    before = order[0]
    order[0] = pair
    place = 0
    while before != pair:
        place += 1
        before, order[place] = order[place], before


@njit(cache=True, nogil=True)
def sweep(
    q0, way, step, parents, A, a, joint_kinds, joint_axes, places, B, b,
    positions, indices, followers, leaders, rules,
    members, pairs, joints, joint_lines, motions, moves, apart,
    solids, kinds, vertices, axes, order, R, p, work, unsure,
):  # fmt: skip
    """Say whether a motion from `q0` along `way` is free; its beginning is not looked at.

    Where `way` is zero only the state is looked at.

    Args:
        q0: configuration of the group.
        way: what is added to it.
        step: longest piece, in the configuration's norm, of which only the middle is looked at.
        parents: this and what follows up to `b` are the arguments of `kinematics.kernels.tree`.
        A: see there.
        a: see there.
        joint_kinds: see there.
        joint_axes: see there.
        places: see there.
        B: see there.
        b: see there.
        positions: of the whole robot; the group's part is overwritten.
        indices: places of the group in it.
        followers: places of what mimics.
        leaders: places in the group of what is mimicked.
        rules: factor and offset of each.
        members: of each link or thing: the solid around all of it, its first solid, their number.
        pairs: numbers of links or things that must not touch.
        joints: number of the frame each joint moves with, -1 where it does not turn.
        joint_lines: axis and a point of it in that frame.
        motions: (j, n) how far each turns for one rad of a variable.
        moves: (bodies, j, n) how far a joint carries a link or thing at most, m, for one rad or m.
        apart: (pairs, j) whether a joint moves one of both, and not both.
        solids: of all links and things, see `convex_rows.ConvexRows`.
        kinds: likewise.
        vertices: (3, v) likewise.
        axes: directions in which pairs were apart last; written.
        order: pairs, those that met last first; written.
        R: rotations of the frames; those of links that move are written.
        p: their positions.
        work: scratch of (10, 4).
        unsure: (n,) takes the parts of the way, 0 to 1, of states that are not decided.

    Returns:
        `FREE`; `COLLIDES` and where, 0 to 1; `UNDECIDED` and how many states are; or `TOO_LONG`.
    """
    n, count = len(q0), len(pairs)
    length = 0.0
    for k in range(n):
        length += way[k] * way[k]
    length = math.sqrt(length)
    bodies, turns = moves.shape[0], moves.shape[1]
    rates, below = np.empty(turns), np.empty((bodies, turns, 2))
    carried = np.zeros((bodies, turns))
    if length > 0.0:
        _carried(way, moves, motions, rates, below)
    most = 4 * int(length / step) + 16
    middles, halves = np.empty(most), np.empty(most)
    begins, ends = np.empty(most, np.int64), np.empty(most, np.int64)
    lists = np.empty(max(64 * most, 4 * count), np.int64)
    box_centres, box_halves = np.empty((len(members), 3)), np.empty((len(members), 3))
    for i in range(count):
        lists[i] = order[i]
    # The middle of all, the end, then the middles of both halves, and so on.
    middles[0], halves[0], begins[0], ends[0] = 0.5, 0.5, 0, count
    if length == 0.0:
        middles[0], halves[0] = 1.0, 0.0
    here, waiting, used, doubts = 0, 1, count, 0
    while here < waiting:
        t, half = middles[here], halves[here]
        is_leaf = 2.0 * half * length <= step
        for k in range(n):
            positions[indices[k]] = q0[k] + way[k] * t
        for k in range(len(followers)):
            positions[followers[k]] = rules[k, 0] * positions[indices[leaders[k]]] + rules[k, 1]
        tree(parents, A, a, joint_kinds, joint_axes, places, B, b, positions, R, p)
        _boxes(members, solids, kinds, R, p, box_centres, box_halves)
        if not is_leaf:
            _carried_from(
                half, joints, joint_lines, rates, below, members, solids, R, p, box_centres,
                carried,
            )  # fmt: skip
        kept, is_sure = used, True
        if used + ends[here] - begins[here] > len(lists):
            longer = np.empty(2 * len(lists) + count, np.int64)
            longer[:used] = lists[:used]
            lists = longer
        for place in range(begins[here], ends[here]):
            pair = lists[place]
            one, other = pairs[pair, 0], pairs[pair, 1]
            enough = 0.0
            if not is_leaf:
                for k in range(turns):
                    if apart[pair, k]:
                        enough += carried[one, k] + carried[other, k]
            is_far = False
            for k in range(3):
                gap = abs(box_centres[one, k] - box_centres[other, k])
                gap -= box_halves[one, k] + box_halves[other, k]
                is_far = is_far or gap > enough
            if is_far:
                continue
            state, clear = pair_clear(
                pair, pairs, members, solids, kinds, vertices, R, p, enough, axes, work
            )  # fmt: skip
            if state == OVERLAP:
                _to_the_front(pair, order)
                return COLLIDES, t
            if state == APART and clear > enough:
                continue
            lists[kept] = pair
            kept += 1
            is_sure = is_sure and state == APART
        if is_leaf:
            if not is_sure:
                if doubts == len(unsure):
                    return TOO_LONG, t
                unsure[doubts] = t
                doubts += 1
            if here == 0 and half > 0.0:
                middles[1], halves[1], begins[1], ends[1] = 1.0, 0.0, 0, count
                waiting = 2
        elif kept > used:
            if here == 0:
                middles[1], halves[1], begins[1], ends[1] = 1.0, 0.0, used, kept
                waiting = 2
            for side in range(2):
                middles[waiting] = t + (half if side else -half) / 2.0
                halves[waiting] = half / 2.0
                begins[waiting], ends[waiting] = used, kept
                waiting += 1
            used = kept
        here += 1
    return (UNDECIDED if doubts else FREE), float(doubts)
