# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled inner loops of kinematics: poses of links, Jacobians, damped least squares.

A chain is a list of steps from the robot's frame to a tip; each step is a fixed transform followed
by one elementary motion: 0 none, 1 a turn about an axis, 2 a slide along an axis, 3 a turn by a
unit quaternion.

The solver is the Levenberg-Marquardt method with the damping of T. Sugihara, "Solvability-
unconcerned inverse kinematics by the Levenberg-Marquardt method" (IEEE T-RO 27, 2011): half the
squared error plus a small constant. Joints at a limit that are pushed beyond it are left out of a
step.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.kernels import kernel

__all__ = ["FIXED", "QUATERNION", "SLIDE", "TURN", "chain_jacobian", "chain_pose", "solve", "tree"]

FIXED, TURN, SLIDE, QUATERNION = 0, 1, 2, 3

_MIN_DAMPING = 1e-5
_MAX_STEP = 1.0
_PATIENCE = 6
_ENOUGH_PROGRESS = 0.8
_REFINE = 2
_EXACT = 1e-9


@kernel
def _turn(axis, angle, out):
    """Rodrigues' formula for a unit axis."""
    s, c = math.sin(angle), math.cos(angle)
    x, y, z = axis[0], axis[1], axis[2]
    k = 1.0 - c
    out[0, 0] = c + x * x * k
    out[0, 1] = x * y * k - z * s
    out[0, 2] = x * z * k + y * s
    out[1, 0] = y * x * k + z * s
    out[1, 1] = c + y * y * k
    out[1, 2] = y * z * k - x * s
    out[2, 0] = z * x * k - y * s
    out[2, 1] = z * y * k + x * s
    out[2, 2] = c + z * z * k


@kernel
def _from_quaternion(x, y, z, w, out):
    n = math.sqrt(x * x + y * y + z * z + w * w)
    if n < 1e-12:
        x, y, z, w, n = 0.0, 0.0, 0.0, 1.0, 1.0
    x, y, z, w = x / n, y / n, z / n, w / n
    out[0, 0] = 1 - 2 * (y * y + z * z)
    out[0, 1] = 2 * (x * y - z * w)
    out[0, 2] = 2 * (x * z + y * w)
    out[1, 0] = 2 * (x * y + z * w)
    out[1, 1] = 1 - 2 * (x * x + z * z)
    out[1, 2] = 2 * (y * z - x * w)
    out[2, 0] = 2 * (x * z - y * w)
    out[2, 1] = 2 * (y * z + x * w)
    out[2, 2] = 1 - 2 * (x * x + y * y)


@kernel
def _put(M, out):
    """Copy a matrix; as an assignment of slices it would take seconds to compile."""
    for i in range(3):
        for j in range(3):
            out[i, j] = M[i, j]


@kernel
def _times(a, b, out):
    for i in range(3):
        for j in range(3):
            out[i, j] = a[i, 0] * b[0, j] + a[i, 1] * b[1, j] + a[i, 2] * b[2, j]


@kernel
def _moved(R, p, v):
    """Add R v to p."""
    for i in range(3):
        p[i] += R[i, 0] * v[0] + R[i, 1] * v[1] + R[i, 2] * v[2]


@kernel
def tree(links, positions, R, p):
    """Write rotation and position of every link of a `LinkTree`.

    A planar joint is kind 4, a floating one 5.
    """
    parents, A, a = links.parents, links.A, links.a
    kinds, axes, places = links.kinds, links.axes, links.places
    B, b = links.B, links.b
    M = np.empty((3, 3))
    S = np.empty((3, 3))
    v = np.zeros(3)
    z = np.array([0.0, 0.0, 1.0])
    for i in range(len(parents)):
        kind, at = kinds[i], places[i]
        if parents[i] < 0:
            _put(A[i], R[i])
            for k in range(3):
                p[i, k] = a[i, k]
        else:
            _times(R[parents[i]], A[i], R[i])
            for k in range(3):
                p[i, k] = p[parents[i], k]
            _moved(R[parents[i]], p[i], a[i])
        if kind == SLIDE:
            for k in range(3):
                v[k] = axes[i, k] * positions[at]
            _moved(R[i], p[i], v)
        elif kind == 4:
            v[0], v[1], v[2] = positions[at], positions[at + 1], 0.0
            _moved(R[i], p[i], v)
        elif kind == 5:
            v[0], v[1], v[2] = positions[at], positions[at + 1], positions[at + 2]
            _moved(R[i], p[i], v)
        if kind == TURN or kind >= 4:
            if kind == TURN:
                _turn(axes[i], positions[at], M)
            elif kind == 4:
                _turn(z, positions[at + 2], M)
            else:
                q = positions[at + 3 : at + 7]
                _from_quaternion(q[0], q[1], q[2], q[3], M)
            _times(R[i], M, S)
            _put(S, R[i])
        _moved(R[i], p[i], b[i])
        _times(R[i], B[i], S)
        _put(S, R[i])


@kernel
def chain_pose(chain, q, R, p, F, o):
    """Write the tip's rotation and position, and the frame of every step before its motion."""
    A, a, kinds, axes, variables = chain.A, chain.a, chain.kinds, chain.axes, chain.variables
    factors, offsets = chain.factors, chain.offsets
    tool_R, tool_p = chain.tool_rotation, chain.tool_m
    M = np.empty((3, 3))
    S = np.empty((3, 3))
    v = np.empty(3)
    R[:] = 0.0
    for i in range(3):
        R[i, i] = 1.0
        p[i] = 0.0
    for i in range(len(kinds)):
        _moved(R, p, a[i])
        _times(R, A[i], S)
        _put(S, R)
        kind = kinds[i]
        if kind == FIXED:
            continue
        for k in range(3):
            o[i, k] = p[k]
            for j in range(3):
                F[i, k, j] = R[k, j]
        at = variables[i]
        if kind == QUATERNION:
            _from_quaternion(q[at], q[at + 1], q[at + 2], q[at + 3], M)
            _times(R, M, S)
            _put(S, R)
            continue
        value = factors[i] * q[at] + offsets[i]
        if kind == TURN:
            _turn(axes[i], value, M)
            _times(R, M, S)
            _put(S, R)
        else:
            for k in range(3):
                v[k] = axes[i, k] * value
            _moved(R, p, v)
    _moved(R, p, tool_p)
    _times(R, tool_R, S)
    _put(S, R)


@kernel
def chain_jacobian(chain, F, o, p, J):
    """Write the Jacobian, linear rows first; a quaternion's columns are turns about x, y, z."""
    kinds, axes, dofs, factors = chain.kinds, chain.axes, chain.dofs, chain.factors
    J[:] = 0.0
    z = np.empty(3)
    for i in range(len(kinds)):
        kind, d = kinds[i], dofs[i]
        x, y, w = p[0] - o[i, 0], p[1] - o[i, 1], p[2] - o[i, 2]
        for k in range(3):
            z[k] = (
                F[i, k, 0] * axes[i, 0] + F[i, k, 1] * axes[i, 1] + F[i, k, 2] * axes[i, 2]
            ) * factors[i]
        if kind == TURN:
            J[0, d] += z[1] * w - z[2] * y
            J[1, d] += z[2] * x - z[0] * w
            J[2, d] += z[0] * y - z[1] * x
            for k in range(3):
                J[3 + k, d] += z[k]
        elif kind == SLIDE:
            for k in range(3):
                J[k, d] += z[k]
        elif kind == QUATERNION:
            J[1, d] -= w
            J[2, d] += y
            J[0, d + 1] += w
            J[2, d + 1] -= x
            J[0, d + 2] -= y
            J[1, d + 2] += x
            for k in range(3):
                J[3 + k, d + k] += 1.0


@kernel
def _error(R, p, target_R, target_p, e):
    """Write what is missing, in the robot's frame: metres and a rotation vector."""
    for k in range(3):
        e[k] = target_p[k] - p[k]
    D = np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            D[i, j] = target_R[i, 0] * R[j, 0] + target_R[i, 1] * R[j, 1] + target_R[i, 2] * R[j, 2]
    x, y, z = D[2, 1] - D[1, 2], D[0, 2] - D[2, 0], D[1, 0] - D[0, 1]
    s = math.sqrt(x * x + y * y + z * z)
    c = D[0, 0] + D[1, 1] + D[2, 2] - 1.0
    angle = math.atan2(s, c)
    if s > 1e-9:
        f = angle / s
        e[3], e[4], e[5] = f * x, f * y, f * z
    elif c > 0.0:
        e[3], e[4], e[5] = 0.5 * x, 0.5 * y, 0.5 * z
    else:
        # Half a turn: the axis is the largest column of D + 1.
        k = 0
        for i in range(1, 3):
            if D[i, i] > D[k, k]:
                k = i
        n = math.sqrt(max(0.5 * (D[k, k] + 1.0), 1e-12))
        for i in range(3):
            e[3 + i] = math.pi * (0.5 * (D[i, k] + (1.0 if i == k else 0.0))) / n


@kernel
def _solved(H, g, n, x):
    """Solve H x = g by Cholesky in place; H is symmetric and positive definite."""
    for j in range(n):
        s = H[j, j]
        for k in range(j):
            s -= H[j, k] * H[j, k]
        s = math.sqrt(max(s, 1e-30))
        H[j, j] = s
        for i in range(j + 1, n):
            t = H[i, j]
            for k in range(j):
                t -= H[i, k] * H[j, k]
            H[i, j] = t / s
    for i in range(n):
        t = g[i]
        for k in range(i):
            t -= H[i, k] * x[k]
        x[i] = t / H[i, i]
    for i in range(n - 1, -1, -1):
        t = x[i]
        for k in range(i + 1, n):
            t -= H[k, i] * x[k]
        x[i] = t / H[i, i]


@kernel
def _turn_quaternion(q, at, dx, d, scale, F):
    """Turn a quaternion by a rotation vector given in the robot's frame."""
    v = np.empty(3)
    for k in range(3):
        # The quaternion stands in its joint's frame.
        v[k] = scale * (F[0, k] * dx[d] + F[1, k] * dx[d + 1] + F[2, k] * dx[d + 2])
    x, y, w = v[0], v[1], v[2]
    h = 0.5 * math.sqrt(x * x + y * y + w * w)
    f = 0.5 * (math.sin(h) / h if h > 1e-9 else 1.0)
    ax, ay, az, aw = f * x, f * y, f * w, math.cos(h)
    bx, by, bz, bw = q[at], q[at + 1], q[at + 2], q[at + 3]
    q[at] = aw * bx + ax * bw + ay * bz - az * by
    q[at + 1] = aw * by - ax * bz + ay * bw + az * bx
    q[at + 2] = aw * bz + ax * by - ay * bx + az * bw
    q[at + 3] = aw * bw - ax * bx - ay * by - az * bz
    n = math.sqrt(q[at] ** 2 + q[at + 1] ** 2 + q[at + 2] ** 2 + q[at + 3] ** 2)
    for k in range(4):
        q[at + k] /= n


@kernel
def solve(chain, goal, lower, upper, seeds, out):
    """Write a solution and return the number of the seed it was found from, -1 without one.

    Args:
        chain: a `Chain`.
        goal: a `Goal`.
        lower: of variables, -∞ where there is no limit.
        upper: likewise, ∞.
        seeds: where to start, (k, n).
        out: the solution, (n,).
    """
    dof_variables, weight = chain.dof_variables, goal.weight
    nv, ns = len(dof_variables), len(chain.kinds)
    R, p = np.empty((3, 3)), np.empty(3)
    F, o = np.zeros((ns, 3, 3)), np.zeros((ns, 3))
    J, e = np.empty((6, nv)), np.empty(6)
    H, g, dx = np.empty((nv, nv)), np.empty(nv), np.zeros(nv)
    H0 = np.empty((nv, nv))
    free = np.ones(nv, dtype=np.bool_)
    best = np.empty(seeds.shape[1])
    for s in range(len(seeds)):
        q = seeds[s].copy()
        mark, since, refined = np.inf, 0, 0
        for _ in range(goal.steps + _REFINE):
            chain_pose(chain, q, R, p, F, o)
            _error(R, p, goal.rotation, goal.position_m, e)
            far = math.sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2])
            turned = math.sqrt(e[3] * e[3] + e[4] * e[4] + e[5] * e[5])
            if far <= goal.near_m and (weight == 0.0 or turned <= goal.near_rad):
                # Close by, two more steps give many more digits.
                refined += 1
                if refined > _REFINE or far + weight * turned < _EXACT:
                    for k in range(len(q)):
                        out[k] = q[k]
                    return s
            elif refined:
                for k in range(len(q)):
                    out[k] = best[k]
                return s
            if refined:
                for k in range(len(q)):
                    best[k] = q[k]
            E = 0.5 * (far * far + weight * weight * turned * turned)
            if _ENOUGH_PROGRESS * mark > E:
                mark, since = E, 0
            else:
                since += 1
                if since > _PATIENCE:
                    break
            chain_jacobian(chain, F, o, p, J)
            for i in range(nv):
                t = 0.0
                for k in range(3):
                    t += J[k, i] * e[k] + weight * weight * J[3 + k, i] * e[3 + k]
                g[i] = t
                for j in range(i + 1):
                    t = 0.0
                    for k in range(3):
                        t += J[k, i] * J[k, j] + weight * weight * J[3 + k, i] * J[3 + k, j]
                    H0[i, j] = t
                    H0[j, i] = t
            free[:] = True
            for _attempt in range(3):
                for i in range(nv):
                    for j in range(nv):
                        H[i, j] = H0[i, j] if free[i] and free[j] else 0.0
                    H[i, i] = (H0[i, i] if free[i] else 1.0) + E + _MIN_DAMPING
                    dx[i] = 0.0
                for i in range(nv):
                    if not free[i]:
                        g[i] = 0.0
                _solved(H, g, nv, dx)
                again = False
                for i in range(nv):
                    v = dof_variables[i]
                    if v < 0 or not free[i]:
                        continue
                    beyond = (q[v] >= upper[v] and dx[i] > 0) or (q[v] <= lower[v] and dx[i] < 0)
                    if beyond:
                        free[i] = False
                        again = True
                if not again:
                    break
            largest = 0.0
            for i in range(nv):
                largest = max(largest, abs(dx[i]))
            scale = _MAX_STEP / largest if largest > _MAX_STEP else 1.0
            for i in range(nv):
                v = dof_variables[i]
                if v >= 0:
                    q[v] = min(max(q[v] + scale * dx[i], lower[v]), upper[v])
            for i in range(ns):
                if chain.kinds[i] == QUATERNION:
                    _turn_quaternion(q, chain.variables[i], dx, chain.dofs[i], scale, F[i])
        if refined:
            for k in range(len(q)):
                out[k] = best[k]
            return s
    return -1
