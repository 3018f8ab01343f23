"""Sensors of where on Earth they are: GPS, magnetometer, altimeter, barometer."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import SphericalCoordinates
from gazelle.geometry import Pose

__all__ = [
    "GeodeticPosition",
    "air_pressure_pa",
    "altitude_change_m",
    "enu_vector",
    "geodetic_position",
    "magnetic_field",
]

Vector3 = tuple[float, float, float]

_WGS84_A_M = 6378137.0
_WGS84_F = 1.0 / 298.257223563
_WGS84_E2 = _WGS84_F * (2.0 - _WGS84_F)

# International standard atmosphere (ISO 2533), as gz-sensors uses it.
_SEA_PRESSURE_PA, _SEA_TEMPERATURE_K = 101325.0, 288.0
_LAPSE_K_M, _EXPONENT = 0.0065, 5.2561


@dataclass(frozen=True, slots=True)
class GeodeticPosition:
    """A place on the WGS 84 ellipsoid, degrees and metres above it."""

    latitude_deg: float
    longitude_deg: float
    altitude_m: float


def geodetic_position(position_m: Vector3, origin: SphericalCoordinates) -> GeodeticPosition:
    """Return where a point of the world lies on Earth (WGS 84).

    The world is the tangent plane at the origin, x east, y north, z up, turned by the heading.

    Args:
        position_m: in the world.
        origin: where the world's origin lies.
    """
    latitude, longitude = math.radians(origin.latitude_deg), math.radians(origin.longitude_deg)
    east, north, up = enu_vector(position_m, origin)
    x, y, z = _ecef(latitude, longitude, origin.elevation_m)
    sin_lat, cos_lat = math.sin(latitude), math.cos(latitude)
    sin_lon, cos_lon = math.sin(longitude), math.cos(longitude)
    outward = cos_lat * up - sin_lat * north
    x += cos_lon * outward - sin_lon * east
    y += sin_lon * outward + cos_lon * east
    z += sin_lat * up + cos_lat * north
    return _geodetic(x, y, z)


def enu_vector(vector: Vector3, origin: SphericalCoordinates) -> Vector3:
    """Return a vector of the world as east, north, up; the heading turns from east to x."""
    heading = math.radians(origin.heading_deg)
    x, y, z = vector
    cos_h, sin_h = math.cos(heading), math.sin(heading)
    return (x * cos_h - y * sin_h, x * sin_h + y * cos_h, z)


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


def _ecef(latitude: float, longitude: float, altitude_m: float) -> Vector3:
    radius = _WGS84_A_M / math.sqrt(1.0 - _WGS84_E2 * math.sin(latitude) ** 2)
    across = (radius + altitude_m) * math.cos(latitude)
    return (
        across * math.cos(longitude),
        across * math.sin(longitude),
        (radius * (1.0 - _WGS84_E2) + altitude_m) * math.sin(latitude),
    )


def _geodetic(x: float, y: float, z: float) -> GeodeticPosition:
    """Invert `_ecef` by fixed-point iteration; below a micrometre after a few rounds."""
    across = math.hypot(x, y)
    latitude = math.atan2(z, across * (1.0 - _WGS84_E2))
    altitude = 0.0
    for _ in range(6):
        sine, cosine = math.sin(latitude), math.cos(latitude)
        radius = _WGS84_A_M / math.sqrt(1.0 - _WGS84_E2 * sine * sine)
        altitude = across * cosine + (z + _WGS84_E2 * radius * sine) * sine - radius
        latitude = math.atan2(z + _WGS84_E2 * radius * sine, across)
    return GeodeticPosition(math.degrees(latitude), math.degrees(math.atan2(y, x)), altitude)
