"""Magnetometers, altimeters and barometers."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose, Vector3

__all__ = [
    "AltimeterRecord",
    "MagnetometerRecord",
    "PressureRecord",
    "air_pressure_pa",
    "altitude_change_m",
    "magnetic_field",
]


# International standard atmosphere (ISO 2533), as gz-sensors uses it.
_SEA_PRESSURE_PA, _SEA_TEMPERATURE_K = 101325.0, 288.0
_LAPSE_K_M, _EXPONENT = 0.0065, 5.2561


class MagnetometerRecord(NamedTuple):
    """The magnetic field in the sensor's frame, (3,) tesla."""

    field_t: NDArray[np.float64]


class AltimeterRecord(NamedTuple):
    """Height since the start, speed of climbing, and the height in the world at the start."""

    vertical_position_m: float
    vertical_velocity_m_s: float
    vertical_reference_m: float


class PressureRecord(NamedTuple):
    """Air pressure, pascal."""

    pressure_pa: float


def magnetic_field(field_world_t: Vector3, T_world_sensor: Pose) -> NDArray[np.float64]:
    """Return the world's magnetic field in the sensor's frame, (3,) tesla."""
    return np.array(T_world_sensor.inverse().rotate(field_world_t))


def altitude_change_m(T_world_sensor: Pose, T_world_start: Pose) -> float:
    """Return how far an altimeter has risen since it started, metres."""
    return T_world_sensor.position_m[2] - T_world_start.position_m[2]


def air_pressure_pa(altitude_m: float) -> float:
    """Return the pressure of the standard atmosphere below 11 km, pascal.

    ``101325 · ((288 − 0.0065 h) / 288)^5.2561`` (ISO 2533, gz-sensors' AirPressureSensor).
    """
    temperature = _SEA_TEMPERATURE_K - _LAPSE_K_M * altitude_m
    return float(_SEA_PRESSURE_PA * (temperature / _SEA_TEMPERATURE_K) ** _EXPONENT)
