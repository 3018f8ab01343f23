"""Places on Earth, fields and pressures against published values."""

from __future__ import annotations

import math

import pytest

from gazelle.description.model import SphericalCoordinates
from gazelle.geometry import Pose
from gazelle.sensors.geodesy import enu_vector, geodetic_position
from gazelle.sensors.magnetometer_altimeter_barometer import (
    air_pressure_pa,
    altitude_change_m,
    magnetic_field,
)

ZURICH = SphericalCoordinates(47.3667, 8.55, 500.0)
EQUATOR = SphericalCoordinates(0.0, 0.0, 0.0)


@pytest.mark.parametrize("origin", [ZURICH, EQUATOR, SphericalCoordinates(-78.0, -170.0, 3000.0)])
def test_origin_of_the_world_lies_where_the_file_says(origin) -> None:
    found = geodetic_position((0.0, 0.0, 0.0), origin)
    assert found.latitude_deg == pytest.approx(origin.latitude_deg, abs=1e-11)
    assert found.longitude_deg == pytest.approx(origin.longitude_deg, abs=1e-11)
    assert found.altitude_m == pytest.approx(origin.elevation_m, abs=1e-6)


def test_going_up_changes_the_altitude_alone() -> None:
    found = geodetic_position((0.0, 0.0, 120.0), ZURICH)
    assert found.altitude_m == pytest.approx(620.0, abs=1e-6)
    assert found.latitude_deg == pytest.approx(47.3667, abs=1e-11)


def test_a_degree_has_its_published_length() -> None:
    # WGS 84: at the equator a degree of longitude is 111,319.49 m, of latitude 110,574.27 m.
    east = geodetic_position((111.31949, 0.0, 0.0), EQUATOR)
    assert east.longitude_deg == pytest.approx(0.001, abs=1e-9)
    north = geodetic_position((0.0, 110.57427, 0.0), EQUATOR)
    assert north.latitude_deg == pytest.approx(0.001, abs=1e-8)


def test_tangent_plane_leaves_the_ellipsoid() -> None:
    # d² / 2R above a sphere of the equator's radius.
    found = geodetic_position((10_000.0, 0.0, 0.0), EQUATOR)
    assert found.altitude_m == pytest.approx(10_000.0**2 / (2 * 6378137.0), abs=1e-3)


def test_heading_turns_x_from_east_to_north() -> None:
    turned = SphericalCoordinates(0.0, 0.0, 0.0, heading_deg=90.0)
    assert enu_vector((2.0, 0.0, 1.0), turned) == pytest.approx((0.0, 2.0, 1.0))
    assert geodetic_position((110.57427, 0.0, 0.0), turned).latitude_deg == pytest.approx(
        0.001, abs=1e-8
    )


def test_magnetometer_reads_the_field_in_its_own_frame() -> None:
    turned = Pose.from_xyz_rpy((1, 2, 3), (0, 0, math.pi / 2))
    assert magnetic_field((1e-5, 2e-5, -4e-5), turned) == pytest.approx([2e-5, -1e-5, -4e-5])


def test_altimeter_counts_from_its_start() -> None:
    assert altitude_change_m(Pose((9.0, 9.0, 3.5)), Pose((0.0, 0.0, 1.0))) == 2.5


def test_pressure_follows_the_standard_atmosphere() -> None:
    assert air_pressure_pa(0.0) == 101325.0
    # ISO 2533 gives 89,875 Pa at 1000 m and 54,020 Pa at 5000 m.
    assert air_pressure_pa(1000.0) == pytest.approx(89_875, rel=2e-4)
    assert air_pressure_pa(5000.0) == pytest.approx(54_020, rel=2e-3)
