"""Places on Earth: WGS 84, and the flat piece of it that a world is (ECEF and ENU)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from gazelle.description.model import SphericalCoordinates
from gazelle.geometry import Vector3

__all__ = [
    "GeodeticPosition",
    "classic_origin",
    "curvature_radii_m",
    "enu_vector",
    "geodetic_position",
    "local_position",
]


_WGS84_A_M = 6378137.0

_WGS84_F = 1.0 / 298.257223563

_WGS84_E2 = _WGS84_F * (2.0 - _WGS84_F)


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


def local_position(place: GeodeticPosition, origin: SphericalCoordinates) -> Vector3:
    """Return where in the world a place on Earth lies, metres; the inverse of the above.

    Args:
        place: degrees and metres on WGS 84.
        origin: where the world's origin lies.
    """
    latitude, longitude = math.radians(origin.latitude_deg), math.radians(origin.longitude_deg)
    there = _ecef(
        math.radians(place.latitude_deg), math.radians(place.longitude_deg), place.altitude_m
    )
    here = _ecef(latitude, longitude, origin.elevation_m)
    x, y, z = (a - b for a, b in zip(there, here, strict=True))
    sin_lat, cos_lat = math.sin(latitude), math.cos(latitude)
    sin_lon, cos_lon = math.sin(longitude), math.cos(longitude)
    outward = cos_lon * x + sin_lon * y
    enu = (
        cos_lon * y - sin_lon * x,
        cos_lat * z - sin_lat * outward,
        cos_lat * outward + sin_lat * z,
    )
    return enu_vector(enu, replace(origin, heading_deg=-origin.heading_deg))


def classic_origin(origin: SphericalCoordinates) -> SphericalCoordinates:
    """Return the origin as Gazebo Classic reads ``<heading_deg>``.

    There x points to 180° − heading, counted from east to north: a world without a heading has
    west along x, and files that want east write 180 (SphericalCoordinates::PositionTransform,
    LOCAL; gz-sim took the right way with LOCAL2).
    """
    return replace(origin, heading_deg=180.0 - origin.heading_deg)


def curvature_radii_m(latitude_rad: float) -> tuple[float, float]:
    """Return the WGS 84 radii of curvature at a latitude: meridian, prime vertical."""
    shrink = 1.0 - _WGS84_E2 * math.sin(latitude_rad) ** 2
    prime_vertical = _WGS84_A_M / math.sqrt(shrink)
    return prime_vertical * (1.0 - _WGS84_E2) / shrink, prime_vertical


def enu_vector(vector: Vector3, origin: SphericalCoordinates) -> Vector3:
    """Return a vector of the world as east, north, up; the heading turns from east to x."""
    heading = math.radians(origin.heading_deg)
    x, y, z = vector
    cos_h, sin_h = math.cos(heading), math.sin(heading)
    return (x * cos_h - y * sin_h, x * sin_h + y * cos_h, z)


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
