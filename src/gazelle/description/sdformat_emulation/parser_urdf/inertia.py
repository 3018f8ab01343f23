"""Masses added up as parser_urdf does it, with the rotations ODE's mass functions know.

A tensor is turned out of its own frame by roll, pitch and yaw one after the other; the sum is
turned back into the parent's inertial frame by all three at once. Operations stay in the library's
order, so that the last of the sixteen printed digits agrees.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.description.sdformat_emulation.parser_urdf.robot import Inertial, Link
from gazelle.description.urdfdom_emulation.poses import Origin
from gazelle.description.urdfdom_emulation.values import rpy_from_quaternion

__all__ = ["lump_inertia"]

Matrix = list[list[float]]
Vector3 = tuple[float, float, float]


@dataclass(slots=True)
class _Mass:
    """A mass in kg, its centre in m and the inertia in kg m² about the frame's origin."""

    mass: float
    centre: list[float]
    inertia: Matrix


def lump_inertia(link: Link, parent: Link, T_parent_link: Origin) -> None:
    """Add a link's mass and inertia to its parent's, which may have none yet."""
    if link.inertial is None:
        return
    if parent.inertial is None:
        parent.inertial = Inertial()
    total = _in_link_frame(parent.inertial)
    other = _in_link_frame(link.inertial)
    _turn_out(other, T_parent_link)
    _translate(other, T_parent_link.xyz_m)
    _add(total, other)
    _store(total, parent.inertial)


def _in_link_frame(inertial: Inertial) -> _Mass:
    ixx, ixy, ixz, iyy, iyz, izz = inertial.tensor
    matrix = [[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]]
    mass = _Mass(inertial.mass_kg, [0.0, 0.0, 0.0], matrix)
    _turn_out(mass, inertial.origin)
    _translate(mass, inertial.origin.xyz_m)
    return mass


def _store(total: _Mass, inertial: Inertial) -> None:
    x, y, z = total.centre
    inertial.mass_kg = total.mass
    inertial.origin = inertial.origin._replace(xyz_m=(x, y, z))
    _translate(total, (-x, -y, -z))
    _rotate(total, _rotation(*rpy_from_quaternion(inertial.origin.quat_xyzw)))
    matrix = total.inertia
    upper = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))
    inertial.tensor = tuple(matrix[row][column] for row, column in upper)


def _turn_out(mass: _Mass, pose: Origin) -> None:
    roll, pitch, yaw = rpy_from_quaternion(pose.quat_xyzw)
    _rotate(mass, _rotation(-roll, 0.0, 0.0))
    _rotate(mass, _rotation(0.0, -pitch, 0.0))
    _rotate(mass, _rotation(0.0, 0.0, -yaw))


def _rotation(phi: float, theta: float, psi: float) -> Matrix:
    """Return ODE's matrix of Euler angles, the transpose of the usual one."""
    sphi, cphi = math.sin(phi), math.cos(phi)
    stheta, ctheta = math.sin(theta), math.cos(theta)
    spsi, cpsi = math.sin(psi), math.cos(psi)
    return [
        [cpsi * ctheta, spsi * ctheta, -stheta],
        [cpsi * stheta * sphi - spsi * cphi, spsi * stheta * sphi + cpsi * cphi, ctheta * sphi],
        [cpsi * stheta * cphi + spsi * sphi, spsi * stheta * cphi - cpsi * sphi, ctheta * cphi],
    ]


def _rotate(mass: _Mass, turn: Matrix) -> None:
    half = [[_dot(turn[j], mass.inertia[i]) for j in range(3)] for i in range(3)]
    mass.inertia = _product(turn, half)
    _make_symmetric(mass.inertia)
    mass.centre = [_dot(row, mass.centre) for row in turn]


def _translate(mass: _Mass, by_m: Vector3) -> None:
    old = _crossing(mass.centre)
    centre = [by + at for by, at in zip(by_m, mass.centre, strict=True)]
    new = _crossing(centre)
    after, before = _product(new, new), _product(old, old)
    for i in range(3):
        for j in range(3):
            mass.inertia[i][j] += mass.mass * (before[i][j] - after[i][j])
    _make_symmetric(mass.inertia)
    mass.centre = [at + by for at, by in zip(mass.centre, by_m, strict=True)]


def _add(total: _Mass, other: _Mass) -> None:
    whole = total.mass + other.mass
    # Without any mass the centre is no number, and neither is the inertia then.
    share = 1.0 / whole if whole else math.copysign(math.inf, whole)
    total.centre = [
        (ours * total.mass + theirs * other.mass) * share
        for ours, theirs in zip(total.centre, other.centre, strict=True)
    ]
    total.mass += other.mass
    for i in range(3):
        for j in range(3):
            total.inertia[i][j] += other.inertia[i][j]


def _crossing(a: list[float]) -> Matrix:
    return [[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]]


def _product(left: Matrix, right: Matrix) -> Matrix:
    columns = [[row[j] for row in right] for j in range(3)]
    return [[_dot(column, row) for column in columns] for row in left]


def _dot(a: list[float], b: list[float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _make_symmetric(matrix: Matrix) -> None:
    matrix[1][0] = matrix[0][1]
    matrix[2][0] = matrix[0][2]
    matrix[2][1] = matrix[1][2]
