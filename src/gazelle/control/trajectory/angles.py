"""Ways between angles, for many joints at once."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.control.interface_values import Array

__all__ = ["shortest_way", "turns_to_nearest", "wrap_in_place"]

_TURN = 2.0 * math.pi
_SINGULAR_RAD = 1e-9


def shortest_way(start_rad: Array, end_rad: Array) -> Array:
    """Return the ways from angles (N,) to others in (-π, π] (``shortest_angular_distance``)."""
    way: Array = end_rad - start_rad
    wrap_in_place(way, np.ones(way.shape, dtype=np.bool_))
    return way


def wrap_in_place(way: Array, is_angle: NDArray[np.bool_]) -> None:
    """Bring those differences, (N,), rad, that are angles, (N,), into (-π, π]."""
    far = is_angle & (np.abs(way) > math.pi)
    if far.any():
        way[far] = math.pi - np.mod(math.pi - way[far], _TURN)


def turns_to_nearest(from_rad: Array, to_rad: Array, wraps: NDArray[np.bool_]) -> Array:
    """Return what to add to `to_rad` so that joints that wrap take the shorter way; whole turns.

    It and all arguments are (N,).

    A way of half a turn keeps its sign, as ``wraparoundJointOffset`` of
    joint_trajectory_controller has it.
    """
    way = shortest_way(from_rad, to_rad)
    half = np.abs(np.abs(way) - math.pi) < _SINGULAR_RAD
    way[half] = np.where(to_rad > from_rad, np.abs(way), -np.abs(way))[half]
    offsets: Array = np.where(wraps, from_rad + way - to_rad, 0.0)
    return offsets
