"""Satellite navigation: SDF's ``gps`` and ``navsat`` sensors, and hector's flat-earth one."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import GpsSpec, SphericalCoordinates
from gazelle.geometry import Vector3
from gazelle.sensors.geodesy import (
    GeodeticPosition,
    curvature_radii_m,
    enu_vector,
    geodetic_position,
)
from gazelle.sensors.noise_streams import VectorNoise

__all__ = ["GpsRecord", "flat_earth_position", "gps_noise", "gps_reading", "north_west_up"]

Array = NDArray[np.float64]


class GpsRecord(NamedTuple):
    """One fix.

    Attributes:
        position: degrees on WGS 84, metres above the ellipsoid.
        velocity_enu_m_s: (3,) float64, east, north, up.
    """

    position: GeodeticPosition
    velocity_enu_m_s: Array


def gps_noise(spec: GpsSpec, seed: int, name: str) -> VectorNoise:
    """Return the six noises of a receiver: position, then velocity, metres and m/s."""
    across, up = spec.horizontal_position_noise, spec.vertical_position_noise
    along, climb = spec.horizontal_velocity_noise, spec.vertical_velocity_noise
    return VectorNoise((across, across, up, along, along, climb), seed, name)


def gps_reading(
    position_m: Vector3,
    velocity_m_s: Array,
    origin: SphericalCoordinates,
    *,
    noise: VectorNoise | None = None,
    dt_s: float = 0.0,
) -> GpsRecord:
    """Return a fix.

    Noise is in metres and is added before the position becomes degrees (SDF; Gazebo Classic's
    GpsSensor). That of the velocity is added to east, north, up.

    Args:
        position_m: the antenna in the world.
        velocity_m_s: of the antenna, (3,), world frame.
        origin: where the world lies on Earth.
        noise: from `gps_noise`, None for none.
        dt_s: simulated time since the last reading.
    """
    x, y, z = velocity_m_s.tolist()
    values = np.array((*position_m, *enu_vector((x, y, z), origin)))
    if noise is not None:
        values = noise.apply(values, dt_s=dt_s)
    x, y, z = values[:3].tolist()
    return GpsRecord(geodetic_position((x, y, z), origin), values[3:])


def north_west_up(vector: Vector3, heading_rad: float) -> Vector3:
    """Return a vector of the world as north, west, up; x points to a compass heading."""
    x, y, z = vector
    cosine, sine = math.cos(heading_rad), math.sin(heading_rad)
    return (x * cosine + y * sine, y * cosine - x * sine, z)


def flat_earth_position(
    position_m: Vector3, reference: GeodeticPosition, heading_rad: float
) -> GeodeticPosition:
    """Return a place by the radii of curvature at a reference: exact to 1 m within 10 km.

    Source: hector_gazebo_plugins' GazeboRosGps.

    Args:
        position_m: in the world.
        reference: where the world's origin lies.
        heading_rad: compass heading of the world's x axis.
    """
    north, west, up = north_west_up(position_m, heading_rad)
    latitude = math.radians(reference.latitude_deg)
    meridian, prime_vertical = curvature_radii_m(latitude)
    return GeodeticPosition(
        reference.latitude_deg + math.degrees(north / meridian),
        reference.longitude_deg - math.degrees(west / (prime_vertical * math.cos(latitude))),
        reference.altitude_m + up,
    )
