"""What a transmission does to positions, velocities and efforts.

All three kinds of ros_control are linear: ``v_actuator = G v_joint`` with a constant matrix G of
reductions. An ideal transmission loses no power, τ_a · v_a = τ_j · v_j for every velocity, hence
``τ_joint = Gᵀ τ_actuator``. Positions map as velocities do, about the joints' offsets.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.control.interface_values import Array

__all__ = [
    "Transmission",
    "differential_transmission",
    "four_bar_linkage_transmission",
    "simple_transmission",
]


@dataclass(frozen=True, slots=True, eq=False)
class Transmission:
    """A transmission of as many actuators as joints.

    Attributes:
        ratios: G (N, N): actuator velocities from joint velocities.
        offsets: joint positions (N,) at which the actuators read 0, rad or m.
    """

    ratios: Array
    offsets: Array

    def joint_positions(self, actuators: Array) -> Array:
        """Return joint positions (N,) from actuator positions."""
        return self.joint_velocities(actuators) + self.offsets

    def joint_velocities(self, actuators: Array) -> Array:
        """Return joint velocities (N,) from actuator velocities."""
        result: Array = np.linalg.solve(self.ratios, actuators).astype(np.float64)
        return result

    def joint_efforts(self, actuators: Array) -> Array:
        """Return joint efforts (N,) from actuator efforts."""
        result: Array = self.ratios.T @ actuators
        return result

    def actuator_positions(self, joints: Array) -> Array:
        """Return actuator positions (N,) from joint positions."""
        result: Array = self.ratios @ (joints - self.offsets)
        return result

    def actuator_velocities(self, joints: Array) -> Array:
        """Return actuator velocities (N,) from joint velocities."""
        result: Array = self.ratios @ joints
        return result

    def actuator_efforts(self, joints: Array) -> Array:
        """Return actuator efforts (N,) from joint efforts."""
        result: Array = np.linalg.solve(self.ratios.T, joints).astype(np.float64)
        return result


def simple_transmission(reduction: float, offset: float = 0.0) -> Transmission:
    """Return a reducer: one actuator turns `reduction` times as fast as its joint.

    Raises:
        ValueError: the reduction is 0.
    """
    _check(reduction)
    return Transmission(np.array([[reduction]], dtype=np.float64), np.array([offset], dtype=float))


def differential_transmission(
    actuator_reductions: Sequence[float],
    joint_reductions: Sequence[float] = (1.0, 1.0),
    offsets: Sequence[float] = (0.0, 0.0),
) -> Transmission:
    """Return a differential: the actuators' sum moves joint 1, their difference joint 2.

    ``v_a1 = n_a1 (n_j1 v_j1 + n_j2 v_j2)``, ``v_a2 = n_a2 (n_j1 v_j1 - n_j2 v_j2)``
    (transmission_interface, ``differential_transmission.h``).

    Raises:
        ValueError: a reduction is 0.
    """
    _check(*actuator_reductions, *joint_reductions)
    (a1, a2), (j1, j2) = actuator_reductions, joint_reductions
    ratios = np.array([[a1 * j1, a1 * j2], [a2 * j1, -a2 * j2]])
    return Transmission(ratios, np.array(offsets, dtype=np.float64))


def four_bar_linkage_transmission(
    actuator_reductions: Sequence[float],
    joint_reductions: Sequence[float] = (1.0, 1.0),
    offsets: Sequence[float] = (0.0, 0.0),
) -> Transmission:
    """Return a four-bar linkage: actuator 2 moves joint 2 relative to joint 1's link.

    ``v_a1 = n_a1 n_j1 v_j1``, ``v_a2 = n_a2 (v_j1 + n_j2 v_j2)`` (transmission_interface,
    ``four_bar_linkage_transmission.h``). The efforts there do not fit these velocities: power
    would come from nowhere. Here they follow from them.

    Raises:
        ValueError: a reduction is 0.
    """
    _check(*actuator_reductions, *joint_reductions)
    (a1, a2), (j1, j2) = actuator_reductions, joint_reductions
    ratios = np.array([[a1 * j1, 0.0], [a2, a2 * j2]])
    return Transmission(ratios, np.array(offsets, dtype=np.float64))


def _check(*reductions: float) -> None:
    if 0.0 in reductions:
        raise ValueError("a reduction of 0 transmits nothing")
