"""GPS: places, velocities, noise."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.description.model import GpsSpec, Noise, SphericalCoordinates
from gazelle.sensors import (
    GeodeticPosition,
    classic_origin,
    flat_earth_position,
    geodetic_position,
    gps_noise,
    gps_reading,
    local_position,
    north_west_up,
)

ZURICH = SphericalCoordinates(47.3667, 8.55, 500.0, heading_deg=30.0)


@pytest.mark.parametrize("origin", [ZURICH, SphericalCoordinates(-33.0, -179.9, 20.0, -120.0)])
def test_places_and_points_of_the_world_are_a_round_trip(origin: SphericalCoordinates) -> None:
    for point in ((0.0, 0.0, 0.0), (1234.5, -678.9, 42.0), (-9e3, 2e4, -10.0)):
        there = geodetic_position(point, origin)
        assert local_position(there, origin) == pytest.approx(point, abs=1e-5)


def test_gz_maths_own_figures_are_met() -> None:
    # What gz-math 7 gives for LOCAL2 to SPHERICAL at 31.230416, 121.473701, 10 m.
    origin = SphericalCoordinates(31.230416, 121.473701, 10.0)
    for point, wanted in (
        ((100.0, 0.0, 0.0), (31.230415995716708, 121.474750604266632, 10.0007832209)),
        ((-60.0, 40.0, 5.0), (31.230776769324081, 121.473071235540587, 15.0004078904)),
    ):
        found = geodetic_position(point, origin)
        assert found.latitude_deg == pytest.approx(wanted[0], abs=2e-11)
        assert found.longitude_deg == pytest.approx(wanted[1], abs=2e-11)
        assert found.altitude_m == pytest.approx(wanted[2], abs=1e-7)


def test_gazebo_classic_has_east_along_x_at_180_degrees() -> None:
    origin = classic_origin(SphericalCoordinates(0.0, 10.0, 0.0, heading_deg=180.0))
    assert geodetic_position((111.31949, 0.0, 0.0), origin).longitude_deg > 10.0
    straight = classic_origin(SphericalCoordinates(0.0, 10.0))
    found = geodetic_position((111.31949, 0.0, 0.0), straight)
    assert found.longitude_deg == pytest.approx(10.0 - 0.001, abs=1e-9)
    # East is -x cos h - y sin h: with 90 degrees y points west and x north.
    turned = classic_origin(SphericalCoordinates(0.0, 10.0, heading_deg=90.0))
    assert geodetic_position((0.0, 111.31949, 0.0), turned).longitude_deg < 10.0
    assert geodetic_position((110.57427, 0.0, 0.0), turned).latitude_deg > 0.0


def test_velocity_is_east_north_up() -> None:
    origin = SphericalCoordinates(47.0, 8.0, heading_deg=90.0)
    record = gps_reading((0.0, 0.0, 0.0), np.array([2.0, 0.0, 0.5]), origin)
    assert record.velocity_enu_m_s == pytest.approx([0.0, 2.0, 0.5], abs=1e-12)


def test_noise_is_in_metres() -> None:
    horizontal, vertical = Noise("gaussian", 0.0, 2.0), Noise("gaussian", 0.0, 5.0)
    speed = Noise("gaussian", 0.0, 0.1)
    noise = gps_noise(GpsSpec(horizontal, vertical, speed, speed), 3, "gps")
    origin = SphericalCoordinates(0.0, 0.0)
    found = [gps_reading((0.0, 0.0, 0.0), np.zeros(3), origin, noise=noise) for _ in range(3000)]
    places = np.array([local_position(item.position, origin) for item in found])
    assert places.std(axis=0) == pytest.approx([2.0, 2.0, 5.0], rel=0.06)
    assert np.abs(places.mean(axis=0)).max() < 4 * 5.0 / math.sqrt(3000)
    speeds = np.array([item.velocity_enu_m_s for item in found])
    assert speeds.std(axis=0) == pytest.approx([0.1] * 3, rel=0.06)


def test_hectors_flat_earth_agrees_with_the_ellipsoid_nearby() -> None:
    reference = GeodeticPosition(49.9, 8.9, 120.0)
    # Compass heading 0: x is north; SDF's heading of that is 90.
    origin = SphericalCoordinates(49.9, 8.9, 120.0, heading_deg=90.0)
    for point in ((100.0, 0.0, 2.0), (0.0, 100.0, 0.0), (-80.0, 60.0, 1.0)):
        flat = flat_earth_position(point, reference, 0.0)
        there = local_position(flat, origin)
        assert there == pytest.approx(point, abs=0.01)


def test_hectors_axes_are_north_west_up() -> None:
    assert north_west_up((1.0, 0.0, 3.0), 0.0) == (1.0, 0.0, 3.0)
    # x to the east (compass 90): it is -west.
    assert north_west_up((1.0, 0.0, 0.0), math.pi / 2) == pytest.approx((0.0, -1.0, 0.0))
