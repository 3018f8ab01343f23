from __future__ import annotations

import io
import math
import struct
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from PIL import Image

from gazelle.geometry import Pose
from gazelle.interfaces import message_type, service_type
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]
WIDTH, HEIGHT, FOV = 64, 48, 1.0
FOCAL = WIDTH / (2 * math.tan(FOV / 2))

WALL = """<sdf version="1.6"><model name="wall"><static>true</static><link name="link">
  <visual name="v"><geometry><box><size>0.2 20 20</size></box></geometry>
  <material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse><lighting>0</lighting></material>
  </visual></link></model></sdf>"""


def camera(plugin: str, keys: str, *, kind: str = "camera", rate: float = 20.0, extra: str = "",
           pixels: str = "R8G8B8") -> str:  # fmt: skip
    return f"""<robot name="eye"><link name="base"><inertial><mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
      <gazebo><static>true</static></gazebo>
      <gazebo reference="base"><sensor name="camera" type="{kind}">
      <update_rate>{rate}</update_rate><camera><horizontal_fov>{FOV}</horizontal_fov>
      <image><width>{WIDTH}</width><height>{HEIGHT}</height><format>{pixels}</format></image>
      <clip><near>0.05</near><far>30</far></clip>{extra}</camera>
      <plugin name="eye" filename="{plugin}">{keys}</plugin></sensor></gazebo></robot>"""


KEYS = "<cameraName>eye</cameraName><frameName>eye_optical</frameName>"


def test_pictures_have_the_sensors_rate_size_and_frame(load: Load, listen: Listen) -> None:
    sim = load(camera("libgazebo_ros_camera.so", KEYS), world=None)
    sim.spawn(WALL, pose=Pose((3.1, 0.0, 0.0)))
    pictures, infos = listen(sim, "/eye/image_raw"), listen(sim, "/eye/camera_info")
    sim.run(seconds=1.0)
    assert len(pictures) == len(infos) == 20
    picture = pictures[0]
    assert picture.header.stamp.nanosec == 50_000_000
    assert picture.header == infos[0].header
    assert picture.header.frame_id == "eye_optical"
    assert (picture.width, picture.height, picture.step) == (WIDTH, HEIGHT, 3 * WIDTH)
    assert picture.encoding == "rgb8"
    pixels = np.asarray(picture.data).reshape(HEIGHT, WIDTH, 3)
    assert pixels[HEIGHT // 2, WIDTH // 2].tolist() == [255, 0, 0]


def test_a_rate_that_is_no_whole_number_of_steps_is_met_on_average(
    load: Load, listen: Listen
) -> None:
    sim = load(camera("libgazebo_ros_camera.so", KEYS, rate=30.0), world=None)
    infos = listen(sim, "/eye/camera_info")
    sim.run(seconds=1.0)
    assert [info.header.stamp.nanosec // 1_000_000 for info in infos[:4]] == [34, 67, 100, 134]
    assert len(infos) == 30


def test_camera_info_is_what_gazebo_publishes(load: Load, listen: Listen) -> None:
    keys = KEYS + "<hackBaseline>0.07</hackBaseline><distortionK1>0.1</distortionK1>"
    keys += "<distortionK2>0.2</distortionK2><distortionT1>0.3</distortionT1>"
    keys += "<distortionT2>0.4</distortionT2><distortionK3>0.5</distortionK3>"
    sim = load(camera("libgazebo_ros_camera.so", keys), world=None)
    infos = listen(sim, "/eye/camera_info")
    sim.run(seconds=0.1)
    info = infos[0]
    # Nobody looks at the pictures: none is rendered.
    assert sim.server.sensors.computed == 0
    cx, cy = (WIDTH + 1) / 2, (HEIGHT + 1) / 2
    assert info.distortion_model == "plumb_bob"
    assert info.d == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5])
    assert info.k == pytest.approx([FOCAL, 0, cx, 0, FOCAL, cy, 0, 0, 1])
    assert info.p == pytest.approx([FOCAL, 0, cx, -FOCAL * 0.07, 0, FOCAL, cy, 0, 0, 0, 1, 0])
    assert np.asarray(info.r).tolist() == np.eye(3).ravel().tolist()


def test_a_focal_length_that_does_not_fit_is_reported(load: Load) -> None:
    sim = load(
        camera("libgazebo_ros_camera.so", KEYS + "<focalLength>99</focalLength>"), world=None
    )
    (found,) = sim.diagnostics.by_code("parameter.bad-value")
    assert "<focalLength> 99 does not fit the image's width and field of view" in found.message


def test_the_plug_ins_rate_can_only_lower_the_sensors(load: Load, listen: Listen) -> None:
    keys = KEYS + "<updateRate>9</updateRate>"
    sim = load(camera("libgazebo_ros_camera.so", keys), world=None)
    infos = listen(sim, "/eye/camera_info")
    sim.run(seconds=1.0)
    # 9 Hz are 111 ms: the third of the sensor's 50 ms frames.
    assert [info.header.stamp.nanosec // 10**6 for info in infos] == [150, 300, 450, 600, 750, 900]


@pytest.mark.parametrize(
    ("pixels", "encoding", "value"),
    [
        ("L8", "mono8", 76),
        ("B8G8R8", "bgr8", [0, 0, 255]),
        ("L16", "mono16", 76 * 257),
        ("BAYER_RGGB8", "bayer_rggb8", 255),
    ],
)
def test_pixel_formats_have_their_ros_encodings(
    load: Load, listen: Listen, pixels: str, encoding: str, value: Any
) -> None:
    sim = load(camera("libgazebo_ros_camera.so", KEYS, pixels=pixels), world=None)
    sim.spawn(WALL, pose=Pose((3.1, 0.0, 0.0)))
    pictures = listen(sim, "/eye/image_raw")
    sim.run(seconds=0.1)
    picture = pictures[0]
    assert picture.encoding == encoding
    dtype = np.uint16 if encoding == "mono16" else np.uint8
    data = np.asarray(picture.data).view(dtype).reshape(HEIGHT, WIDTH, -1)
    expected = [value] if isinstance(value, int) else value
    assert np.abs(data[0, 0].astype(int) - expected).max() <= 257 * (encoding == "mono16")


def test_compressed_pictures_decode_to_the_raw_ones(load: Load, listen: Listen) -> None:
    sim = load(camera("libgazebo_ros_camera.so", KEYS), world=None)
    sim.spawn(WALL, pose=Pose((3.1, 0.0, 0.0)))
    raw, packed = listen(sim, "/eye/image_raw"), listen(sim, "/eye/image_raw/compressed")
    sim.run(seconds=0.1)
    assert packed[0].format == "rgb8; jpeg compressed bgr8"
    decoded = np.asarray(Image.open(io.BytesIO(np.asarray(packed[0].data).tobytes())))
    pixels = np.asarray(raw[0].data).reshape(HEIGHT, WIDTH, 3)
    assert np.abs(decoded.astype(int) - pixels).max() < 8


def test_compression_is_reconfigured_while_running(load: Load, listen: Listen) -> None:
    sim = load(camera("libgazebo_ros_camera.so", KEYS), world=None)
    packed = listen(sim, "/eye/image_raw/compressed")
    request = service_type("dynamic_reconfigure/Reconfigure").Request()
    text = message_type("dynamic_reconfigure/StrParameter")(name="format", value="png")
    request.config.strs = [text]
    sim.server.node.call("/eye/image_raw/compressed/set_parameters", request)  # type: ignore[attr-defined]
    sim.run(seconds=0.1)
    assert packed[0].format == "rgb8; png compressed bgr8"
    assert np.asarray(packed[0].data).tobytes().startswith(b"\x89PNG")
    assert sim.server.node.parameters.get("/eye/image_raw/compressed/format") == "png"


def test_image_transports_are_listed_as_in_ros(load: Load) -> None:
    sim = load(camera("libgazebo_ros_camera.so", KEYS), world=None)
    topics = sim.server.node.topics  # type: ignore[attr-defined]
    for transport in ("compressed", "compressedDepth", "theora"):
        assert f"/eye/image_raw/{transport}" in topics
        for name in ("parameter_descriptions", "parameter_updates"):
            assert f"/eye/image_raw/{transport}/{name}" in topics
    assert topics["/eye/image_raw/theora"] == "theora_image_transport/msg/Packet"
    (found,) = sim.diagnostics.by_code("plugin.no-encoder")
    assert "compressedDepth and theora send nothing" in found.message


def test_imager_rate_changes_the_rate(load: Load, listen: Listen) -> None:
    sim = load(camera("libgazebo_ros_camera.so", KEYS), world=None)
    infos = listen(sim, "/eye/camera_info")
    request = service_type("dynamic_reconfigure/Reconfigure").Request()
    rate = message_type("dynamic_reconfigure/DoubleParameter")(name="imager_rate", value=40.0)
    request.config.doubles = [rate]
    response = sim.server.node.call("/eye/set_parameters", request)  # type: ignore[attr-defined]
    assert response.config.doubles[0].value == 40.0
    sim.run(seconds=1.0)
    assert len(infos) == 40
    request.config.doubles[0].value = 500.0
    response = sim.server.node.call("/eye/set_parameters", request)  # type: ignore[attr-defined]
    assert response.config.doubles[0].value == 50.0


def test_set_camera_info_replaces_what_is_published(load: Load, listen: Listen) -> None:
    sim = load(camera("libgazebo_ros_camera.so", KEYS), world=None)
    infos = listen(sim, "/eye/camera_info")
    request = service_type("sensor_msgs/SetCameraInfo").Request()
    request.camera_info.distortion_model = "mine"
    response = sim.server.node.call("/eye/set_camera_info", request)  # type: ignore[attr-defined]
    assert response.success
    sim.run(seconds=0.1)
    assert infos[0].distortion_model == "mine"
    assert infos[0].header.stamp.nanosec == 50_000_000


DEPTH_KEYS = """<cameraName>d</cameraName><imageTopicName>rgb/image_raw</imageTopicName>
  <cameraInfoTopicName>rgb/camera_info</cameraInfoTopicName>
  <depthImageTopicName>depth/image_raw</depthImageTopicName>
  <depthImageCameraInfoTopicName>depth/camera_info</depthImageCameraInfoTopicName>
  <pointCloudTopicName>depth/points</pointCloudTopicName><frameName>eye_optical</frameName>"""


def points_of(cloud: Any) -> np.ndarray[Any, Any]:
    dtype = np.dtype(
        {
            "names": ["x", "y", "z", "b", "g", "r"],
            "formats": ["<f4"] * 3 + ["u1"] * 3,
            "offsets": [0, 4, 8, 16, 17, 18],
            "itemsize": 32,
        }
    )
    return np.frombuffer(np.asarray(cloud.data).tobytes(), dtype).reshape(cloud.height, cloud.width)


def test_depth_and_cloud_of_a_wall_are_analytic(load: Load, listen: Listen) -> None:
    text = camera("libgazebo_ros_openni_kinect.so", DEPTH_KEYS, kind="depth")
    sim = load(text, world=None)
    sim.spawn(WALL, pose=Pose((3.1, 0.0, 0.0)))
    depths, clouds = listen(sim, "/d/depth/image_raw"), listen(sim, "/d/depth/points")
    sim.run(seconds=0.1)
    depth = np.asarray(depths[0].data).view(np.float32).reshape(HEIGHT, WIDTH)
    assert (depths[0].encoding, depths[0].step) == ("32FC1", 4 * WIDTH)
    assert np.abs(depth - 3.0).max() < 1e-3
    cloud = clouds[0]
    assert (cloud.point_step, cloud.row_step) == (32, 32 * WIDTH)
    assert [(f.name, f.offset, f.datatype) for f in cloud.fields] == [
        ("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("rgb", 16, 7),
    ]  # fmt: skip
    points = points_of(cloud)
    u, v = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    assert np.abs(points["x"] - (u - (WIDTH - 1) / 2) * 3.0 / FOCAL).max() < 1e-3
    assert np.abs(points["y"] - (v - (HEIGHT - 1) / 2) * 3.0 / FOCAL).max() < 1e-3
    middle = points[HEIGHT // 2, WIDTH // 2]
    assert (middle["r"], middle["g"], middle["b"]) == (255, 0, 0)
    assert cloud.is_dense


@pytest.mark.parametrize(
    ("filename", "distance_m", "seen"),
    [
        ("libgazebo_ros_openni_kinect.so", 0.3, False),
        ("libgazebo_ros_openni_kinect.so", 4.9, True),
        ("libgazebo_ros_openni_kinect.so", 5.1, False),
        ("libgazebo_ros_depth_camera.so", 5.1, True),
    ],
)
def test_depth_outside_the_cutoffs_is_nan(
    load: Load, listen: Listen, filename: str, distance_m: float, seen: bool
) -> None:
    sim = load(camera(filename, DEPTH_KEYS, kind="depth"), world=None)
    sim.spawn(WALL, pose=Pose((distance_m + 0.1, 0.0, 0.0)))
    depths, clouds = listen(sim, "/d/depth/image_raw"), listen(sim, "/d/depth/points")
    sim.run(seconds=0.1)
    depth = np.asarray(depths[0].data).view(np.float32)
    assert np.isfinite(depth).all() if seen else np.isnan(depth).all()
    assert clouds[0].is_dense is seen


def test_depth_as_16_bit_millimetres(load: Load, listen: Listen) -> None:
    keys = DEPTH_KEYS + "<useDepth16UC1Format>true</useDepth16UC1Format>"
    sim = load(camera("libgazebo_ros_openni_kinect.so", keys, kind="depth"), world=None)
    sim.spawn(WALL, pose=Pose((2.1, 0.0, 0.0)))
    depths = listen(sim, "/d/depth/image_raw")
    sim.run(seconds=0.1)
    assert depths[0].encoding == "16UC1"
    values = np.asarray(depths[0].data).view(np.uint16)
    assert np.abs(values.astype(int) - 2000).max() <= 1


def test_depth_camera_info_alone_is_published(load: Load, listen: Listen) -> None:
    text = camera("libgazebo_ros_openni_kinect.so", DEPTH_KEYS, kind="depth")
    sim = load(text, world=None)
    infos = listen(sim, "/d/depth/camera_info")
    sim.run(seconds=0.2)
    assert len(infos) == 4


ROS2_KEYS = """<ros><namespace>/demo</namespace>
  <remapping>eye/image_raw:=eye/picture</remapping></ros>
  <camera_name>eye</camera_name><frame_name>optical</frame_name>
  <min_depth>0.2</min_depth><max_depth>9</max_depth>"""


def test_the_ros_2_camera_plug_in_serves_depth_cameras_too(load: Load, listen: Listen) -> None:
    sim = load(camera("libgazebo_ros_camera.so", ROS2_KEYS, kind="depth"), world=None)
    sim.spawn(WALL, pose=Pose((8.1, 0.0, 0.0)))
    pictures, depths = listen(sim, "/demo/eye/picture"), listen(sim, "/demo/eye/depth/image_raw")
    packed, clouds = (
        listen(sim, "/demo/eye/depth/image_raw/compressedDepth"),
        listen(sim, "/demo/eye/points"),
    )
    infos = listen(sim, "/demo/eye/depth/camera_info")
    sim.run(seconds=0.1)
    assert len(pictures) == len(depths) == len(packed) == len(clouds) == len(infos) == 2
    assert pictures[0].header.frame_id == "optical"
    depth = np.asarray(depths[0].data).view(np.float32)
    assert np.abs(depth - 8.0).max() < 2e-3
    data = np.asarray(packed[0].data).tobytes()
    kind, a, b = struct.unpack("<iff", data[:12])
    inverse = np.asarray(Image.open(io.BytesIO(data[12:])), np.float64)
    assert (kind, packed[0].format) == (0, "32FC1; compressedDepth png")
    # The format keeps 1/depth in steps of 1/A: 8 m to within 0.7 %.
    assert a / (inverse - b) == pytest.approx(np.full(inverse.shape, 8.0), rel=0.01)


def test_a_frame_without_optical_axes_is_reported(load: Load) -> None:
    keys = DEPTH_KEYS.replace("eye_optical", "base")
    sim = load(camera("libgazebo_ros_openni_kinect.so", keys, kind="depth"), world=None)
    (found,) = sim.diagnostics.by_code("plugin.camera-frame")
    assert "frame 'base' of camera 'camera' is a link with x forward" in found.message
    assert "rpy -1.5708 0 -1.5708" in found.fix
