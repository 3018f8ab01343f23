"""GPS, magnetometer, barometer and altimeter: sensors, hector's plug-ins and gz-sim's topics."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.description.model import SphericalCoordinates
from gazelle.geometry import Pose
from gazelle.sensors import GeodeticPosition, air_pressure_pa, local_position
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

WORLD = """<sdf version="1.6"><world name="lab">{world_plugins}<gravity>0 0 0</gravity>
  <magnetic_field>2e-5 0 -4e-5</magnetic_field>
  <spherical_coordinates><surface_model>EARTH_WGS84</surface_model>
    <latitude_deg>47.0</latitude_deg><longitude_deg>8.0</longitude_deg>
    <elevation>400</elevation><heading_deg>{heading}</heading_deg></spherical_coordinates>
  <model name="kite"><pose>100 50 20 0 0 0</pose><link name="body">
    <inertial><mass>1</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial>
    {sensor}</link>{plugin}</model></world></sdf>"""
ORIGIN = SphericalCoordinates(47.0, 8.0, 400.0)
GZ = '<plugin filename="gz-sim-navsat-system" name="gz::sim::systems::NavSat"/>'


def world(heading: float = 180.0, **parts: str) -> str:
    values = {"world_plugins": "", "sensor": "", "plugin": "", **parts}
    return WORLD.format(heading=heading, **values)


def place_of(fix: Any, origin: SphericalCoordinates = ORIGIN) -> tuple[float, ...]:
    return local_position(GeodeticPosition(fix.latitude, fix.longitude, fix.altitude), origin)


def xyz(message: Any) -> list[float]:
    return [message.x, message.y, message.z]


def test_the_ros_2_gps_knows_where_east_is_in_classic_worlds(load: Load, listen: Listen) -> None:
    noise = "<gps><position_sensing><vertical><noise type='gaussian'><stddev>0</stddev></noise>"
    noise += "</vertical></position_sensing></gps>"
    sensor = f"""<sensor name="gps" type="gps"><update_rate>10</update_rate>{noise}
      <plugin name="fixes" filename="libgazebo_ros_gps_sensor.so"><ros><namespace>/n</namespace>
      <remapping>~/out:=fix</remapping><remapping>~/vel:=vel</remapping></ros></plugin></sensor>"""
    sim = load(world(sensor=sensor))
    fixes, speeds = listen(sim, "/n/fix"), listen(sim, "/n/vel")
    sim.link("body").handle.set_velocity((2.0, -1.0, 0.5))
    sim.run(seconds=1.0)
    assert len(fixes) == len(speeds) == 10
    assert place_of(fixes[-1]) == pytest.approx((102.0, 49.0, 20.5), abs=1e-3)
    assert xyz(speeds[-1].vector) == pytest.approx([2.0, -1.0, 0.5], abs=1e-6)
    assert fixes[-1].header.frame_id == "body"
    assert (fixes[-1].status.status, fixes[-1].status.service) == (0, 1)
    assert fixes[-1].position_covariance_type == 2


def test_covariance_and_scatter_of_a_gps_agree(load: Load, listen: Listen) -> None:
    noise = "".join(
        f"<{way}><noise type='gaussian'><mean>0</mean><stddev>{sigma}</stddev></noise></{way}>"
        for way, sigma in (("horizontal", 2.0), ("vertical", 4.0))
    )
    sensor = f"""<sensor name="gps" type="gps"><update_rate>1000</update_rate>
      <gps><position_sensing>{noise}</position_sensing></gps>
      <plugin name="p" filename="libgazebo_ros_gps_sensor.so"><ros/></plugin></sensor>"""
    sim = load(world(sensor=sensor))
    fixes = listen(sim, "/p/out")
    sim.run(seconds=2.0)
    places = np.array([place_of(fix) for fix in fixes])
    assert places.std(axis=0) == pytest.approx([2.0, 2.0, 4.0], rel=0.08)
    assert np.diag(np.reshape(fixes[0].position_covariance, (3, 3))) == pytest.approx([4, 4, 16])
    sim.reset()
    again = listen(sim, "/p/out")
    sim.run(seconds=0.01)
    assert again[0].latitude == fixes[0].latitude


def test_a_gz_navsat_takes_the_heading_as_sdf_describes_it(load: Load, listen: Listen) -> None:
    sensor = (
        '<sensor name="s" type="navsat"><update_rate>5</update_rate><topic>gnss</topic></sensor>'
    )
    sim = load(world(heading=0.0, sensor=sensor, world_plugins=GZ))
    fixes = listen(sim, "/gnss")
    sim.run(seconds=1.0)
    assert len(fixes) == 5
    assert place_of(fixes[-1]) == pytest.approx((100.0, 50.0, 20.0), abs=1e-3)
    assert fixes[-1].position_covariance_type == 0


def test_a_gps_without_a_place_on_earth_says_so(load: Load) -> None:
    model = "<sdf version='1.6'><model name='m'><link name='l'><sensor name='g' type='gps'/>"
    sim = load(model + "</link></model></sdf>", world=None)
    (found,) = sim.diagnostics.by_code("simulator.no-place-on-earth")
    assert "the world has no <spherical_coordinates>" in found.message
    assert sim.sensor("g").read().position.latitude_deg == pytest.approx(0.0, abs=1e-9)


def test_hectors_gps_counts_from_its_own_reference(load: Load, listen: Listen) -> None:
    keys = """<updateRate>20</updateRate><referenceLatitude>49.8</referenceLatitude>
      <referenceLongitude>8.6</referenceLongitude><referenceAltitude>120</referenceAltitude>
      <referenceHeading>90</referenceHeading><velocityOffset>0.1 0 0</velocityOffset>
      <gaussianNoise>0 0 0</gaussianNoise><frameId>world</frameId>"""
    sim = load(
        world(plugin=f'<plugin name="p" filename="libhector_gazebo_ros_gps.so">{keys}</plugin>')
    )
    fixes, speeds = listen(sim, "/fix"), listen(sim, "/fix_velocity")
    sim.link("body").handle.set_velocity((2.0, 0.0, 0.0))
    sim.run(seconds=1.0)
    assert len(fixes) == 20
    # Compass heading 90: x points east, y north; the velocity is north, west, up.
    origin = SphericalCoordinates(49.8, 8.6, 120.0)
    assert place_of(fixes[-1], origin) == pytest.approx((102.0, 50.0, 20.0), abs=0.01)
    assert xyz(speeds[-1].vector) == pytest.approx([0.0, -2.1, 0.0], abs=1e-6)
    assert fixes[-1].header.frame_id == "world"
    assert fixes[-1].position_covariance_type == 2


def test_hectors_gps_takes_the_worlds_place_when_told(load: Load, listen: Listen) -> None:
    keys = "<useWorldSphericalCoordinates>true</useWorldSphericalCoordinates>"
    plugin = f'<plugin name="p" filename="libhector_gazebo_ros_gps.so">{keys}</plugin>'
    sim = load(world(heading=0.0, plugin=plugin))
    fixes = listen(sim, "/fix")
    sim.run(seconds=1.0)
    assert len(fixes) == 4
    assert place_of(fixes[-1]) == pytest.approx((100.0, 50.0, 20.0), abs=0.01)


def test_a_magnetometer_feels_the_worlds_field_in_its_axes(load: Load, listen: Listen) -> None:
    sensor = '<sensor name="s" type="magnetometer"><update_rate>10</update_rate></sensor>'
    sim = load(world(sensor=sensor, world_plugins=GZ))
    messages = listen(sim, "/world/lab/model/kite/link/body/sensor/s/magnetometer")
    sim.model("kite").pose = Pose.from_xyz_rpy((0.0, 0.0, 5.0), (0.0, 0.0, math.pi / 2))
    sim.run(seconds=0.5)
    assert len(messages) == 5
    assert xyz(messages[-1].magnetic_field) == pytest.approx([0, -2e-5, -4e-5], abs=1e-9)
    assert sim.sensor("s").read().field_t == pytest.approx([0, -2e-5, -4e-5], abs=1e-9)


@pytest.mark.parametrize("as_field", ["false", "true"])
def test_hectors_magnetometer_points_to_magnetic_north(
    load: Load, listen: Listen, as_field: str
) -> None:
    keys = f"""<updateRate>50</updateRate><referenceHeading>90</referenceHeading>
      <declination>10</declination><inclination>60</inclination><magnitude>2</magnitude>
      <useMagneticFieldMsgs>{as_field}</useMagneticFieldMsgs><offset>0 0 0.5</offset>"""
    plugin = f'<plugin name="p" filename="libhector_gazebo_ros_magnetic.so">{keys}</plugin>'
    sim = load(world(plugin=plugin))
    messages = listen(sim, "/magnetic")
    sim.run(seconds=0.2)
    field = xyz(messages[-1].magnetic_field if as_field == "true" else messages[-1].vector)
    # x points east, y north: magnetic north lies 10 degrees east of it.
    flat = 2 * math.cos(math.radians(60))
    east, north = flat * math.sin(math.radians(10)), flat * math.cos(math.radians(10))
    assert len(messages) == 10
    assert field == pytest.approx([east, north, -2 * math.sin(math.radians(60)) + 0.5])
    assert messages[-1].header.frame_id == "body"


def test_an_altimeter_counts_from_where_its_model_began(load: Load, listen: Listen) -> None:
    sensor = '<sensor name="s" type="altimeter"><update_rate>10</update_rate></sensor>'
    sim = load(world(sensor=sensor, world_plugins=GZ))
    sim.link("body").handle.set_velocity((0.0, 0.0, 1.5))
    messages = listen(sim, "/world/lab/model/kite/link/body/sensor/s/altimeter")
    sim.run(seconds=2.0)
    message = messages[-1]
    assert len(messages) == 20
    assert message.vertical_reference == pytest.approx(20.0)
    assert message.vertical_position == pytest.approx(3.0, abs=1e-6)
    assert message.vertical_velocity == pytest.approx(1.5)


def test_pressure_is_the_standard_atmospheres(load: Load, listen: Listen) -> None:
    sensor = """<sensor name="s" type="air_pressure"><update_rate>10</update_rate><air_pressure>
      <reference_altitude>1000</reference_altitude><pressure><noise type="gaussian">
      <stddev>3</stddev></noise></pressure></air_pressure></sensor>"""
    sim = load(world(sensor=sensor, world_plugins=GZ))
    messages = listen(sim, "/world/lab/model/kite/link/body/sensor/s/air_pressure")
    sim.run(seconds=40.0)
    values = np.array([message.fluid_pressure for message in messages])
    assert values.mean() == pytest.approx(air_pressure_pa(1020.0), abs=4 * 3 / math.sqrt(400))
    assert values.std() == pytest.approx(3.0, rel=0.15)
    assert messages[0].variance == pytest.approx(9.0)


def test_hectors_barometer_is_the_height(load: Load, listen: Listen) -> None:
    keys = "<updateRate>10</updateRate><offset>1.5</offset><qnh>1000</qnh>"
    plugin = f'<plugin name="p" filename="libhector_gazebo_ros_baro.so">{keys}</plugin>'
    sim = load(world(plugin=plugin))
    messages = listen(sim, "/pressure_height")
    sim.run(seconds=0.5)
    assert len(messages) == 5
    assert messages[-1].point.z == pytest.approx(21.5)
    (idle,) = sim.diagnostics.by_code("parameter.idle")
    assert "<qnh> (only hector_uav_msgs/Altimeter has it)" in idle.message
