"""A grid on the ground of films, as Gazebo's window has one: a floor of one colour shows no way."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import CameraSpec
from gazelle.geometry import Pose
from gazelle.sensors.intrinsics import camera_intrinsics

__all__ = ["GroundGrid", "grid_step_m"]

_LINE_PX = 1.1
_EVERY = 5
"""Each fifth line is stronger."""

_WEAK, _STRONG = 0.22, 0.5
# As far as the ray tracer's depth is exact.
_FLAT_M, _FLAT_SHARE = 2e-3, 3e-4
_DARK = 70
_STEPS = (1.0, 2.0, 5.0)

Floats = NDArray[np.float32]


class _Seen(NamedTuple):
    """What a pose of the camera shows of the plane z = 0: weights of the lines, and depth."""

    weight: Floats
    depth_m: Floats


def grid_step_m(distance_m: float) -> float:
    """Return the distance of lines for a subject so far away: 1, 2 or 5 and zeros."""
    wanted = max(distance_m, 1e-3) / 8.0
    power = 10.0 ** math.floor(math.log10(wanted))
    return next((step * power for step in _STEPS if step * power >= wanted), 10.0 * power)


class GroundGrid:
    """Lines in the plane z = 0 of the world, drawn where the plane is what a picture shows."""

    def __init__(self, spec: CameraSpec, step_m: float) -> None:
        """Prepare for a lens.

        Args:
            spec: lens and size.
            step_m: between lines.
        """
        lens = camera_intrinsics(spec)
        columns = np.arange(spec.width_px, dtype=np.float32)
        rows = np.arange(spec.height_px, dtype=np.float32)
        self._across = -(columns - np.float32(lens.cx)) / np.float32(lens.fx)
        self._up = -(rows - np.float32(lens.cy)) / np.float32(lens.fy)
        self._step_m = step_m
        self._last: tuple[Pose, _Seen] | None = None

    def draw(self, rgb: NDArray[np.uint8], depth_m: Floats, T_world_camera: Pose) -> None:
        """Draw into a picture.

        Args:
            rgb: (H, W, 3), changed.
            depth_m: (H, W) along the viewing axis.
            T_world_camera: it looks along +x, z up.
        """
        if self._last is None or self._last[0] != T_world_camera:
            self._last = (T_world_camera, self._look(T_world_camera))
        seen = self._last[1]
        tolerance = _FLAT_M + _FLAT_SHARE * seen.depth_m
        shown = (np.abs(depth_m - seen.depth_m) < tolerance) & (seen.weight > 0.0)
        weight = seen.weight[shown][:, None]
        below = rgb[shown].astype(np.float32)
        is_dark = below.mean(axis=1, keepdims=True) < _DARK
        line = np.where(is_dark, 0.5 * below + 110.0, 0.35 * below)
        rgb[shown] = (below + weight * (line - below) + 0.5).astype(np.uint8)

    def _look(self, T_world_camera: Pose) -> _Seen:
        turn = T_world_camera.matrix()[:3, :3].astype(np.float32)
        eye = np.array(T_world_camera.position_m, np.float32)
        across, up = self._across[None, :], self._up[:, None]
        ways = [turn[axis, 0] + turn[axis, 1] * across + turn[axis, 2] * up for axis in range(3)]
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            depth = -eye[2] / ways[2]
            weight = np.zeros(depth.shape, np.float32)
            for axis in (0, 1):
                place = (eye[axis] + depth * ways[axis]) / np.float32(self._step_m)
                np.maximum(weight, _line_weight(place), out=weight)
        weight[~np.isfinite(depth) | (depth <= 0.0)] = 0.0
        return _Seen(weight, depth)


def _line_weight(place: Floats) -> Floats:
    """Return how much of a line each pixel has; `place` is its coordinate in steps."""
    down, right = np.gradient(place)
    # Steps per pixel: lines that would be closer than some pixels fade.
    size: Floats = np.hypot(down, right).astype(np.float32)
    weak = _WEAK * _covered(place, size)
    every = np.float32(_EVERY)
    strong = _STRONG * _covered(place / every, size / every)
    found: Floats = np.nan_to_num(np.maximum(weak, strong))
    return found


def _covered(place: Floats, size: Floats) -> Floats:
    away = np.abs(place - np.round(place)) / size
    fading = np.clip(1.6 - 8.0 * size, 0.0, 1.0)
    covered: Floats = np.clip(_LINE_PX / 2.0 + 0.5 - away, 0.0, 1.0) * fading
    return covered
