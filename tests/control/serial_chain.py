"""An independent reference: rigid-body dynamics of a serial chain on a resting base, in numpy.

Shares nothing with the engine: the URDF is read with ElementTree, the equations of motion come
from the kinetic energy of the links (mass matrix from Jacobians, Coriolis terms from its numeric
derivatives), integration is Runge-Kutta of fourth order.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
GRAVITY = np.array([0.0, 0.0, -9.8])


@dataclass(frozen=True)
class Body:
    """A rigid body: mass, centre and inertia about it, in the frame of its moving joint."""

    mass_kg: float
    center_m: Array
    inertia_kg_m2: Array


@dataclass(frozen=True)
class Joint:
    """A revolute joint: its frame in the frame of the joint before, its axis, what hangs on it."""

    name: str
    T_parent_joint: Array
    axis: Array
    bodies: tuple[Body, ...]


def read_chain(path: Path, base: str) -> tuple[Joint, ...]:
    """Read the chain of revolute joints above a link; fixed links belong to what carries them."""
    root = ET.parse(path).getroot()
    links = {link.get("name"): link for link in root.findall("link")}
    joints = root.findall("joint")

    def bodies(link: str, T: Array) -> list[Body]:
        found = [_body(links[link], T)]
        for joint in joints:
            if joint.find("parent").get("link") == link and joint.get("type") == "fixed":
                found += bodies(joint.find("child").get("link"), T @ _origin(joint))
        return found

    def next_joint(link: str) -> ET.Element | None:
        moving = [j for j in joints if j.find("parent").get("link") == link]
        return next((j for j in moving if j.get("type") != "fixed"), None)

    chain: list[Joint] = []
    link = base
    while (joint := next_joint(link)) is not None:
        axis = np.array([float(x) for x in joint.find("axis").get("xyz").split()])
        link = joint.find("child").get("link")
        rows = tuple(bodies(link, np.eye(4)))
        chain.append(Joint(joint.get("name"), _origin(joint), axis / np.linalg.norm(axis), rows))
    return tuple(chain)


def mass_matrix(chain: tuple[Joint, ...], q: Array) -> Array:
    """Return the joint-space inertia."""
    M = np.zeros((len(chain), len(chain)))
    for body, T, Jv, Jw in _jacobians(chain, q):
        R = T[:3, :3]
        M += body.mass_kg * Jv.T @ Jv + Jw.T @ (R @ body.inertia_kg_m2 @ R.T) @ Jw
    return M


def gravity_effort(chain: tuple[Joint, ...], q: Array) -> Array:
    """Return what gravity exerts on the joints."""
    total = np.zeros(len(chain))
    for body, _, Jv, _ in _jacobians(chain, q):
        total += body.mass_kg * Jv.T @ GRAVITY
    return total


def acceleration(chain: tuple[Joint, ...], q: Array, v: Array, effort: Array) -> Array:
    """Return the joints' accelerations."""
    M = mass_matrix(chain, q)
    return np.linalg.solve(M, effort + gravity_effort(chain, q) - _coriolis(chain, q, v))


def step(
    chain: tuple[Joint, ...], q: Array, v: Array, effort: Array, dt: float
) -> tuple[Array, Array]:
    """Integrate one step with constant effort."""

    def f(q: Array, v: Array) -> tuple[Array, Array]:
        return v, acceleration(chain, q, v, effort)

    k1 = f(q, v)
    k2 = f(q + dt / 2 * k1[0], v + dt / 2 * k1[1])
    k3 = f(q + dt / 2 * k2[0], v + dt / 2 * k2[1])
    k4 = f(q + dt * k3[0], v + dt * k3[1])
    return (
        q + dt / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]),
        v + dt / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1]),
    )


def _coriolis(chain: tuple[Joint, ...], q: Array, v: Array) -> Array:
    n, h = len(q), 1e-6
    dM = np.empty((n, n, n))
    for k in range(n):
        e = np.zeros(n)
        e[k] = h
        dM[k] = (mass_matrix(chain, q + e) - mass_matrix(chain, q - e)) / (2 * h)
    change = np.einsum("kij,k,j->i", dM, v, v)
    return change - 0.5 * np.einsum("ijk,j,k->i", dM, v, v)


def _jacobians(chain: tuple[Joint, ...], q: Array) -> list[tuple[Body, Array, Array, Array]]:
    T = np.eye(4)
    axes: list[tuple[Array, Array]] = []
    found = []
    for joint, angle in zip(chain, q, strict=True):
        T = T @ joint.T_parent_joint
        axes.append((T[:3, 3].copy(), T[:3, :3] @ joint.axis))
        turn = np.eye(4)
        turn[:3, :3] = _rotation(joint.axis, angle)
        T = T @ turn
        for body in joint.bodies:
            point = T[:3, :3] @ body.center_m + T[:3, 3]
            Jv, Jw = np.zeros((3, len(chain))), np.zeros((3, len(chain)))
            for place, (origin, axis) in enumerate(axes):
                Jv[:, place], Jw[:, place] = np.cross(axis, point - origin), axis
            found.append((body, T, Jv, Jw))
    return found


def _rotation(axis: Array, angle: float) -> Array:
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def _origin(element: ET.Element) -> Array:
    origin = element.find("origin")
    T = np.eye(4)
    if origin is not None:
        r, p, y = (float(x) for x in (origin.get("rpy") or "0 0 0").split())
        z, u, x = np.eye(3)[2], np.eye(3)[1], np.eye(3)[0]
        T[:3, :3] = _rotation(z, y) @ _rotation(u, p) @ _rotation(x, r)
        T[:3, 3] = [float(x) for x in (origin.get("xyz") or "0 0 0").split()]
    return T


def _body(link: ET.Element, T: Array) -> Body:
    inertial = link.find("inertial")
    T = T @ _origin(inertial)
    values = {key: float(x) for key, x in inertial.find("inertia").items()}
    inertia = np.array([[values["i" + "".join(sorted(a + b))] for b in "xyz"] for a in "xyz"])
    R = T[:3, :3]
    return Body(float(inertial.find("mass").get("value")), T[:3, 3], R @ inertia @ R.T)
