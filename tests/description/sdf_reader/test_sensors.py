from __future__ import annotations

import pytest

from gazelle.description.model import (
    AltimeterSpec,
    ContactSpec,
    GpsSpec,
    ImuSpec,
    LidarSpec,
    LogicalCameraSpec,
    OtherSensorSpec,
    SonarSpec,
)
from gazelle.description.sdf_reader.sensors import SENSOR_TYPES, read_sensor
from gazelle.diagnostics import Severity
from gazelle.geometry import Pose

GAUSSIAN = "<noise type='gaussian'><stddev>{}</stddev></noise>"


@pytest.fixture
def sensor(tag, context):
    def read(kind, body="", **words):
        return read_sensor(tag(f"<sensor name='s' type='{kind}'>{body}</sensor>"), context, **words)

    return read


def test_words_that_every_sensor_has(sensor):
    found = sensor(
        "imu",
        "<pose>0 0 1 0 0 0</pose><update_rate>50</update_rate><always_on>1</always_on>"
        "<visualize>true</visualize><topic>imu</topic><gz_frame_id>imu_link</gz_frame_id>"
        "<plugin name='p' filename='libp.so'><a>1</a></plugin>",
    )
    assert (found.name, found.type, found.update_rate_hz) == ("s", "imu", 50)
    assert (found.always_on, found.visualize, found.topic) == (True, True, "imu")
    assert found.frame_id == "imu_link"
    assert found.T_link_sensor.position_m == (0, 0, 1)
    plugin = found.plugins[0]
    assert (plugin.name, plugin.filename, plugin.reference) == ("p", "libp.so", "s")
    assert plugin.parameters.text_of("a") == "1"


def test_pose_starts_from_the_frame_given(sensor):
    found = sensor("imu", "<pose>0 0 1 0 0 0</pose>", T_link_sensor=Pose((1, 0, 0)))
    assert found.T_link_sensor.position_m == (1, 0, 1)


def test_older_word_for_the_frame(sensor):
    assert sensor("imu", "<ignition_frame_id>f</ignition_frame_id>").frame_id == "f"


def test_gazebos_word_for_no_topic(sensor):
    assert sensor("imu", "<topic>__default__</topic>").topic == ""


SCAN = (
    "<{0}><scan><horizontal><samples>360</samples><resolution>1</resolution><min_angle>-3"
    "</min_angle><max_angle>3</max_angle></horizontal><vertical><samples>16</samples><min_angle>"
    "-0.2</min_angle><max_angle>0.3</max_angle></vertical></scan><range><min>0.1</min><max>6"
    "</max><resolution>0.01</resolution></range><noise><type>gaussian</type><mean>0.5</mean>"
    "<stddev>0.01</stddev></noise></{0}>"
)


@pytest.mark.parametrize(
    ("kind", "element", "on_collisions"),
    [
        ("ray", "ray", True),
        ("gpu_ray", "ray", False),
        ("lidar", "lidar", True),
        ("gpu_lidar", "lidar", False),
    ],
)
def test_lidars(sensor, kind, element, on_collisions):
    spec = sensor(kind, SCAN.format(element)).spec
    assert isinstance(spec, LidarSpec)
    assert (spec.samples, spec.min_angle_rad, spec.max_angle_rad) == (360, -3, 3)
    assert (spec.vertical_samples, spec.vertical_min_angle_rad) == (16, -0.2)
    assert (spec.range_min_m, spec.range_max_m, spec.range_resolution_m) == (0.1, 6, 0.01)
    assert (spec.noise.type, spec.noise.mean, spec.noise.stddev) == ("gaussian", 0.5, 0.01)
    assert spec.on_collisions is on_collisions


def test_infinite_range_is_legal(sensor, diagnostics):
    spec = sensor("ray", "<ray><range><max>inf</max></range></ray>").spec
    assert spec.range_max_m == float("inf")
    assert not len(diagnostics)


def test_scan_without_samples_gets_one(sensor, diagnostics):
    spec = sensor(
        "ray", "<ray><scan><horizontal><samples>0</samples></horizontal></scan></ray>"
    ).spec
    assert spec.samples == 1
    assert "needs at least 1" in diagnostics.by_code("sdf.bad-value")[0].message


CAMERA = (
    "<camera name='c'><pose>1 0 0 0 0 0</pose><horizontal_fov>1.2</horizontal_fov><image><width>640"
    "</width><height>480</height><format>L8</format></image><clip><near>0.02</near><far>300</far>"
    "</clip><depth_camera><clip><near>0.4</near><far>5</far></clip></depth_camera>"
    "<noise><type>gaussian</type><stddev>0.007</stddev></noise><distortion><k1>1</k1><k2>2</k2>"
    "<k3>3</k3><p1>4</p1><p2>5</p2><center>0.4 0.6</center></distortion><lens><intrinsics>"
    "<fx>500</fx><fy>501</fy><cx>320</cx><cy>240</cy></intrinsics></lens>"
    "<optical_frame_id>o</optical_frame_id><camera_info_topic>ci</camera_info_topic>"
    "<visibility_mask>0x0e</visibility_mask></camera>"
)


@pytest.mark.parametrize(
    ("kind", "word"),
    [
        ("camera", "rgb"),
        ("depth", "depth"),
        ("depth_camera", "depth"),
        ("rgbd_camera", "rgbd"),
        ("wideanglecamera", "wideangle"),
    ],
)
def test_cameras(sensor, kind, word):
    spec = sensor(kind, CAMERA).spec
    assert (spec.name, spec.kind, spec.horizontal_fov_rad) == ("c", word, 1.2)
    assert (spec.width_px, spec.height_px, spec.pixel_format) == (640, 480, "L8")
    assert (spec.near_m, spec.far_m, spec.depth_near_m, spec.depth_far_m) == (0.02, 300, 0.4, 5)
    assert spec.noise.stddev == 0.007
    assert (spec.distortion.k1, spec.distortion.p2, spec.distortion.center) == (1, 5, (0.4, 0.6))
    assert spec.intrinsics == (500, 501, 320, 240, 0)
    assert (spec.optical_frame_id, spec.camera_info_topic) == ("o", "ci")
    assert spec.visibility_mask == 14
    assert spec.T_sensor_camera.position_m == (1, 0, 0)


def test_multicamera_keeps_every_camera(sensor):
    spec = sensor("multicamera", CAMERA + "<camera name='right'/>").spec
    assert [item.name for item in spec.members] == ["c", "right"]
    assert spec.width_px == 640


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("<camera><image><width>0</width></image></camera>", "<width> is 0"),
        ("<camera><horizontal_fov>60</horizontal_fov></camera>", "<horizontal_fov> is 60 rad"),
        ("<camera><horizontal_fov>0</horizontal_fov></camera>", "<horizontal_fov> is 0 rad"),
    ],
)
def test_impossible_camera_is_reported(sensor, diagnostics, body, words):
    sensor("camera", body)
    assert words in diagnostics.by_code("sdf.bad-value")[0].message


def test_imu_noise_per_axis(sensor):
    spec = sensor(
        "imu",
        f"<imu><angular_velocity><x>{GAUSSIAN.format(1)}</x><z>{GAUSSIAN.format(3)}</z>"
        f"</angular_velocity><linear_acceleration><y>{GAUSSIAN.format(5)}</y>"
        "</linear_acceleration><orientation_reference_frame><localization>ENU</localization>"
        "</orientation_reference_frame><enable_orientation>0</enable_orientation></imu>",
    ).spec
    assert isinstance(spec, ImuSpec)
    assert [noise.stddev for noise in spec.angular_velocity_noise] == [1, 0, 3]
    assert [noise.stddev for noise in spec.linear_acceleration_noise] == [0, 5, 0]
    assert (spec.localization, spec.enable_orientation) == ("ENU", False)


def test_imu_noise_of_sdf_1_4(sensor):
    spec = sensor(
        "imu",
        "<imu><topic>t</topic><noise><type>gaussian</type><rate><mean>1</mean><stddev>2</stddev>"
        "<bias_mean>3</bias_mean><bias_stddev>4</bias_stddev></rate><accel><stddev>5</stddev>"
        "</accel></noise></imu>",
    ).spec
    rate, accel = spec.angular_velocity_noise[2], spec.linear_acceleration_noise[0]
    assert (rate.type, rate.mean, rate.stddev, rate.bias_mean, rate.bias_stddev) == (
        "gaussian", 1, 2, 3, 4,
    )  # fmt: skip
    assert (accel.type, accel.stddev) == ("gaussian", 5)


def test_noise_with_drifting_bias(sensor):
    body = (
        "<altimeter><vertical_position><noise type='gaussian_quantized'><mean>1</mean><stddev>2"
        "</stddev><bias_mean>3</bias_mean><bias_stddev>4</bias_stddev><dynamic_bias_stddev>5"
        "</dynamic_bias_stddev><dynamic_bias_correlation_time>6</dynamic_bias_correlation_time>"
        "<precision>7</precision></noise></vertical_position></altimeter>"
    )
    spec = sensor("altimeter", body).spec
    assert isinstance(spec, AltimeterSpec)
    noise = spec.position_noise
    assert (noise.type, noise.bias_mean, noise.bias_stddev) == ("gaussian_quantized", 3, 4)
    assert (noise.dynamic_bias_stddev, noise.dynamic_bias_correlation_time_s) == (5, 6)
    assert noise.precision == 7


def test_unknown_noise_is_reported(sensor, diagnostics):
    sensor("ray", "<ray><noise><type>gausian</type></noise></ray>")
    (found,) = diagnostics.by_code("sdf.bad-value")
    assert "'gausian'" in found.message
    assert "'gaussian'" in found.fix


def test_negative_deviation_is_reported(sensor, diagnostics):
    spec = sensor("ray", "<ray><noise><type>gaussian</type><stddev>-1</stddev></noise></ray>").spec
    assert spec.noise.stddev == 1
    assert "<stddev> is negative" in diagnostics.by_code("sdf.bad-value")[0].message


def test_contact_sensor(sensor):
    body = (
        "<contact><collision>a</collision><collision>b</collision>"
        "<topic>__default_topic__</topic></contact>"
    )
    assert sensor("contact", body).spec == ContactSpec(("a", "b"), "")


def test_force_torque_sensor(sensor):
    spec = sensor(
        "force_torque",
        "<force_torque><frame>sensor</frame><measure_direction>parent_to_child</measure_direction>"
        f"<force><x>{GAUSSIAN.format(2)}</x></force></force_torque>",
    ).spec
    assert (spec.frame, spec.measure_direction) == ("sensor", "parent_to_child")
    assert spec.force_noise[0].stddev == 2


@pytest.mark.parametrize(
    ("kind", "element"), [("gps", "gps"), ("navsat", "navsat"), ("gps", "navsat")]
)
def test_satellite_navigation(sensor, kind, element):
    body = (
        f"<{element}><position_sensing><horizontal>{GAUSSIAN.format(1)}</horizontal><vertical>"
        f"{GAUSSIAN.format(2)}</vertical></position_sensing><velocity_sensing><horizontal>"
        f"{GAUSSIAN.format(3)}</horizontal></velocity_sensing></{element}>"
    )
    spec = sensor(kind, body).spec
    assert isinstance(spec, GpsSpec)
    assert spec.horizontal_position_noise.stddev == 1
    assert spec.vertical_position_noise.stddev == 2
    assert spec.horizontal_velocity_noise.stddev == 3


def test_remaining_kinds(sensor):
    magnetometer = sensor(
        "magnetometer", f"<magnetometer><y>{GAUSSIAN.format(1)}</y></magnetometer>"
    )
    assert magnetometer.spec.noise[1].stddev == 1
    pressure = sensor(
        "air_pressure",
        "<air_pressure><reference_altitude>9</reference_altitude><pressure>"
        f"{GAUSSIAN.format(2)}</pressure></air_pressure>",
    ).spec
    assert (pressure.reference_altitude_m, pressure.noise.stddev) == (9, 2)
    body = "<sonar><geometry>sphere</geometry><min>1</min><max>2</max><radius>3</radius></sonar>"
    assert sensor("sonar", body).spec == SonarSpec("sphere", 1, 2, 3)
    body = (
        "<logical_camera><near>1</near><far>2</far><horizontal_fov>3</horizontal_fov>"
        "<aspect_ratio>4</aspect_ratio></logical_camera>"
    )
    assert sensor("logical_camera", body).spec == LogicalCameraSpec(1, 2, 3, 4)


@pytest.mark.parametrize("kind", ["rfid", "thermal", "segmentation", "wireless_receiver"])
def test_kinds_known_by_name_only_are_told_of(sensor, diagnostics, kind):
    assert sensor(kind).spec == OtherSensorSpec(kind)
    (found,) = diagnostics.by_code("sdf.sensor-not-simulated")
    assert found.severity is Severity.INFO
    assert f"'{kind}'" in found.message


@pytest.mark.parametrize("kind", SENSOR_TYPES)
def test_every_kind_can_be_empty(sensor, diagnostics, kind):
    assert sensor(kind).type == kind
    assert not diagnostics.errors


def test_unknown_kind_is_reported_with_the_nearest(sensor, diagnostics):
    assert sensor("gpu_rays") is None
    (found,) = diagnostics.by_code("sdf.unknown-sensor-type")
    assert "sensor type 'gpu_rays' is not known" in found.message
    assert "'gpu_ray'" in found.fix


def test_sensor_without_type_is_reported(tag, context, diagnostics):
    assert read_sensor(tag("<sensor name='s'/>"), context) is None
    assert "sensor name='s'> has no type" in diagnostics.errors[0].message


def test_sensor_without_name_is_reported(tag, context, diagnostics):
    assert read_sensor(tag("<sensor type='imu'/>"), context) is None
    assert "<sensor> has no name" in diagnostics.errors[0].message
