"""Frames, pictures and displays: what the page draws, to the number."""

from __future__ import annotations

import io
import math
import struct
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.patience import eventually, stretched
from tests.studio.conftest import Talk
from tests.studio.page import Binary, Page, RefusedError

from gazelle.geometry import Pose
from gazelle.graph import Graph, Node
from gazelle.graph.tf import StampedPose, StaticTransformBroadcaster, TransformBroadcaster
from gazelle.interfaces import fill, message_type, service_type
from gazelle.studio.displays.points import points_of

Move = Callable[..., None]
_QUARTER = (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))


@pytest.fixture
def move(node: Node) -> Move:
    """Publishes a frame: parent, child, position, quaternion."""
    static, moving = StaticTransformBroadcaster(node), TransformBroadcaster(node)

    def send(
        parent: str, child: str, position: Any, turn: Any = (0, 0, 0, 1), at_s: float = 0
    ) -> None:
        pose = StampedPose(parent, child, int(at_s * 1e9), Pose(position, turn))
        (moving if at_s else static).send(pose)

    return send


def test_tf_gives_poses_in_the_fixed_frame_and_their_names(page: Page, move: Move) -> None:
    move("map", "odom", (1, 2, 0), _QUARTER)
    move("other", "island", (0, 0, 1))
    stream = page.open("tf", fixed_frame="map")
    move("odom", "base", (1, 0, 0), at_s=5)
    names: dict[str, Any] = {}
    while not {"base", "odom", "island"} <= set(names):
        item = stream.next()
        if isinstance(item, dict):
            names = {one["name"]: one for one in item["frames"]}
    frame = stream.until(lambda item: isinstance(item, Binary))
    assert (frame.kind, frame.number) == (2, len(names))
    assert list(names) == sorted(names)
    assert names["base"] == {"name": "base", "parent": "odom", "static": False}
    assert names["odom"] == {"name": "odom", "parent": "map", "static": True}
    assert names["map"] == {"name": "map", "parent": "", "static": False}
    rows = np.frombuffer(frame.payload, "<f4").reshape(-1, 7)
    poses = dict(zip(names, rows, strict=True))
    assert poses["base"] == pytest.approx([1, 3, 0, *_QUARTER], abs=1e-6)
    assert poses["map"].tolist() == [0, 0, 0, 0, 0, 0, 1]
    assert np.isnan(poses["island"]).all()
    assert np.isnan(poses["other"]).all()


def test_tf_in_an_unknown_frame_is_nowhere(page: Page, move: Move) -> None:
    move("map", "odom", (1, 2, 0))
    stream = page.open("tf", fixed_frame="mop")
    frame = stream.until(lambda item: isinstance(item, Binary) and item.number)
    assert np.isnan(np.frombuffer(frame.payload, "<f4")).all()


def test_a_loop_of_frames_is_survived(page: Page, move: Move) -> None:
    move("loop_a", "loop_b", (1, 0, 0))
    move("loop_b", "loop_a", (1, 0, 0))
    stream = page.open("tf", fixed_frame="loop_a")
    assert stream.until(lambda item: isinstance(item, Binary) and item.number >= 2)


def test_tf_tree_tells_who_says_so(page: Page, move: Move) -> None:
    move("map", "tree_odom", (1, 2, 0))
    stream = page.open("tf.tree")
    move("tree_odom", "tree_base", (1, 2, 0), at_s=3)
    rows = stream.until(lambda rows: {"tree_odom", "tree_base"} <= {r["frame"] for r in rows})
    by_name = {row["frame"]: row for row in rows}
    assert by_name["tree_odom"] == {
        "frame": "tree_odom",
        "parent": "map",
        "rate_hz": None,
        "age_s": None,
        "broadcaster": "/test",
        "static": True,
    }
    assert by_name["tree_base"]["age_s"] > 1e6


def test_image_is_a_jpeg_of_the_source(page: Page, talk: Talk) -> None:
    stream = page.open("image", topic="/camera/image")
    pixels = np.zeros((40, 60, 3), np.uint8)
    pixels[:, :30] = (250, 10, 20)
    talk("/camera/image", "sensor_msgs/Image", header={"stamp": {"sec": 4, "nanosec": 0}},
         height=40, width=60, encoding="rgb8", step=180, data=pixels.tobytes())  # fmt: skip
    frame = stream.next()
    assert frame.kind == 10
    assert (frame.number >> 16, frame.number & 0xFFFF) == (60, 40)
    assert frame.stamp_s == 4.0
    shown = _decoded(frame)
    assert shown.shape == (40, 60, 3)
    assert shown[20, 5] == pytest.approx([250, 10, 20], abs=6)
    assert shown[20, 55] == pytest.approx([0, 0, 0], abs=6)


def test_wide_images_are_made_smaller_and_say_their_size(page: Page, talk: Talk) -> None:
    stream = page.open("image", topic="/wide", max_width=100)
    talk("/wide", "sensor_msgs/Image", height=100, width=400, encoding="mono8", step=400,
         data=bytes(40_000))  # fmt: skip
    frame = stream.next()
    assert frame.number >> 16 == 400
    assert _decoded(frame).shape[:2] == (25, 100)


@pytest.mark.parametrize(
    ("encoding", "pixel", "rgb"),
    [
        ("bgr8", b"\x14\x0a\xfa", (250, 10, 20)),
        ("rgba8", b"\xfa\x0a\x14\x00", (250, 10, 20)),
        ("bgra8", b"\x14\x0a\xfa\x00", (250, 10, 20)),
        ("mono8", b"\x64", (100, 100, 100)),
        ("yuv422", b"\x80\x64\x80\x64", (100, 100, 100)),
        ("yuv422_yuy2", b"\x64\x80\x64\x80", (100, 100, 100)),
        ("bayer_rggb8", b"\x64\x64", (100, 100, 100)),
    ],
)
def test_encodings(page: Page, talk: Talk, encoding: str, pixel: bytes, rgb: Any) -> None:
    topic = f"/coded_{encoding}"
    stream = page.open("image", topic=topic)
    width = 16
    row = pixel * (width if len(pixel) != 4 or "yuv" not in encoding else width // 2)
    row = row[: width * {"mono8": 1, "bayer_rggb8": 1}.get(encoding, len(row))]
    talk(topic, "sensor_msgs/Image", height=16, width=width, encoding=encoding, step=len(row) + 3,
         data=(row + b"???") * 16)  # fmt: skip
    assert _decoded(stream.next())[4, 4] == pytest.approx(rgb, abs=4)


def test_depth_goes_through_a_colour_map(page: Page, talk: Talk) -> None:
    depth = np.full((16, 32), np.nan, np.float32)
    depth[:, 8:20], depth[:, 20:] = 1.0, 3.0
    stream = page.open("image", topic="/depth", quality=95)
    colours = page.open("image", topic="/depth", colormap="jet", quality=95)
    limits: dict[str, Any] = {"Normalize Range": False, "Min Value": 0, "Max Value": 6}
    fixed = page.open("image", topic="/depth", quality=95, **limits)
    talk("/depth", "sensor_msgs/Image", height=16, width=32, encoding="32FC1", step=128,
         data=depth.tobytes())  # fmt: skip
    assert _decoded(stream.next())[8, [2, 12, 28], 0] == pytest.approx([0, 0, 255], abs=6)
    assert _decoded(colours.next())[8, 30] == pytest.approx([128, 0, 0], abs=20)
    assert _decoded(fixed.next())[8, [12, 28], 0] == pytest.approx([42, 127], abs=6)


def test_compressed_pictures_pass_as_they_are(page: Page, talk: Talk) -> None:
    out = io.BytesIO()
    Image.new("RGB", (20, 10), (9, 200, 9)).save(out, "JPEG")
    stream = page.open("image", topic="/packed")
    talk("/packed", "sensor_msgs/CompressedImage", format="jpeg", data=out.getvalue())
    frame = stream.next()
    assert frame.payload == out.getvalue()
    assert frame.number == 20 << 16 | 10


@pytest.mark.parametrize(
    ("fields", "text"),
    [
        ({"encoding": "rgb9"}, "pictures of encoding 'rgb9' cannot be shown"),
        ({"data": b"12"}, "the picture says 4×4 of rgb8 with a step of 12 bytes, but brings 2"),
        ({"width": 0}, "the picture is empty"),
        ({"step": 1}, "with a step of 1 bytes"),
    ],
)
def test_broken_pictures_are_a_status(page: Page, talk: Talk, fields: Any, text: str) -> None:
    good = {"encoding": "rgb8", "height": 4, "width": 4, "step": 12, "data": bytes(48)}
    stream = page.open("image", topic="/broken")
    talk("/broken", "sensor_msgs/Image", **(good | fields))
    status = stream.status.get(timeout=stretched())
    assert status["level"] == "error"
    assert text in status["text"]
    talk("/broken", "sensor_msgs/Image", **good)
    assert stream.next().kind == 10
    assert stream.status.get(timeout=stretched())["level"] == "ok"


def test_points_come_with_pose_and_intensity_colours(page: Page, talk: Talk, move: Move) -> None:
    move("map", "laser", (0, 0, 2))
    stream = page.display("PointCloud2", "/cloud", **{"Color Transformer": "Intensity"})
    rows = [(1, 2, 3, 10), (4, 5, 6, 20), (math.nan, 0, 0, 99), (7, 8, 9, 15)]
    talk("/cloud", "sensor_msgs/PointCloud2", **_cloud(rows, "intensity"))
    pose, points, colours = _points(stream.next())
    assert pose.tolist() == [0, 0, 2, 0, 0, 0, 1, 4]
    assert points.tolist() == [[1, 2, 3], [4, 5, 6], [7, 8, 9]]
    # RViz's rainbow: the least is red, the greatest magenta; NaN points do not count.
    assert colours[0].tolist() == [255, 0, 0, 255]
    assert colours[2].tolist()[1] > 200


def test_points_by_axis_rgb_and_flat(page: Page, talk: Talk, move: Move) -> None:
    move("map", "turned", (0, 0, 0), _QUARTER)
    packed = struct.unpack("<f", bytes((3, 2, 1, 0)))[0]
    rows = [(0, 0, 0, packed), (1, 0, 0, packed)]
    axis: dict[str, Any] = {
        "Color Transformer": "AxisColor",
        "Axis": "Y",
        "Autocompute Value Bounds": False,
        "Min Value": 0,
        "Max Value": 1,
        "Invert Rainbow": True,
    }
    by_axis = page.display("PointCloud2", "/cloud2", **axis)
    by_rgb = page.display("PointCloud2", "/cloud2", **{"Color Transformer": "RGB8"})
    flat = page.display(
        "PointCloud2", "/cloud2", **{"Color Transformer": "FlatColor", "Color": "1; 2; 3"}
    )
    talk("/cloud2", "sensor_msgs/PointCloud2", **_cloud(rows, "rgb", frame="turned"))
    # In the fixed frame the point lies on +y.
    assert _points(by_axis.next())[2].tolist() == [[255, 0, 255, 255], [255, 0, 0, 255]]
    assert _points(by_rgb.next())[2].tolist() == [[1, 2, 3, 255]] * 2
    assert _points(flat.next())[2].tolist() == [[1, 2, 3, 255]] * 2


def test_points_are_not_more_than_the_budget(page: Page, talk: Talk, move: Move) -> None:
    move("map", "laser", (0, 0, 0))
    stream = page.display("PointCloud2", "/big", **{"Point Budget": 1000})
    rows = [(number, 0, 0, number) for number in range(2500)]
    talk("/big", "sensor_msgs/PointCloud2", **_cloud(rows, "intensity"))
    frame = stream.next()
    assert frame.number == 834
    assert _points(frame)[1][:, 0].tolist() == list(range(0, 2500, 3))


def test_organised_clouds_with_padded_rows(page: Page, talk: Talk, move: Move) -> None:
    move("map", "laser", (0, 0, 0))
    fields = _cloud([(1, 2, 3, 0), (4, 5, 6, 0)], "intensity")
    row = fields["data"]
    fields |= {"height": 2, "row_step": len(row) + 8, "data": (row + b"?" * 8) * 2}
    stream = page.display("PointCloud2", "/padded")
    talk("/padded", "sensor_msgs/PointCloud2", **fields)
    assert _points(stream.next())[1].tolist() == [[1, 2, 3], [4, 5, 6]] * 2


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"point_step": 0}, "the cloud says 1×1 points of 0 bytes, but brings 16 bytes"),
        ({"width": 9}, "but brings 16 bytes"),
        ({"fields": []}, "the cloud has no field 'x'"),
        ({"point_step": 8, "width": 2}, "a field of the cloud lies outside of its points"),
    ],
)
def test_broken_clouds_are_a_status(
    page: Page, talk: Talk, move: Move, change: Any, text: str
) -> None:
    move("map", "laser", (0, 0, 0))
    stream = page.display("PointCloud2", "/bad_cloud")
    talk("/bad_cloud", "sensor_msgs/PointCloud2",
         **(_cloud([(1, 2, 3, 4)], "intensity") | change))  # fmt: skip
    # Until it has heard of the frames it says so.
    status = {"text": ""}
    while text not in status["text"]:
        status = stream.status.get(timeout=stretched())
    assert status["level"] == "error"


def test_a_cloud_without_points_may_say_anything_of_them() -> None:
    cloud = message_type("sensor_msgs/PointCloud2")()
    fill(cloud, _cloud([], "intensity") | {"height": 5, "point_step": 1 << 31})
    assert len(points_of(cloud, 1000, ("intensity",), with_rgb=True).xyz) == 0


def test_laser_scans_are_points_within_their_range(page: Page, talk: Talk, move: Move) -> None:
    move("map", "laser", (0, 0, 0))
    stream = page.display("LaserScan", "/scan", **{"Color Transformer": "Intensity"})
    talk("/scan", "sensor_msgs/LaserScan", header={"frame_id": "laser"}, angle_min=0.0,
         angle_increment=math.pi / 2, range_min=0.5, range_max=5.0,
         ranges=[1.0, 2.0, 0.1, math.inf, 3.0], intensities=[1.0, 2.0, 3.0, 4.0, 5.0])  # fmt: skip
    _, points, colours = _points(stream.next())
    assert points == pytest.approx(np.array([[1, 0, 0], [0, 2, 0], [3, 0, 0]]), abs=1e-6)
    assert len(colours) == 3


@pytest.mark.parametrize(
    ("display", "field"),
    [
        ("FluidPressure", "fluid_pressure"),
        ("Illuminance", "illuminance"),
        ("RelativeHumidity", "relative_humidity"),
        ("Temperature", "temperature"),
    ],
)
def test_a_sensor_of_one_number_is_a_point_whose_colour_tells_it(
    page: Page, talk: Talk, move: Move, display: str, field: str
) -> None:
    move("map", "sensor", (0, 0, 2))
    bounds = {"Autocompute Intensity Bounds": False, "Min Intensity": 0, "Max Intensity": 4}
    stream = page.display(display, f"/{field}", **{"Channel Name": field}, **bounds)
    talk(f"/{field}", f"sensor_msgs/{display}", header={"frame_id": "sensor"}, **{field: 4.0})
    pose, points, colours = _points(stream.next())
    assert pose[:3].tolist() == [0, 0, 2]
    assert points.tolist() == [[0, 0, 0]]
    assert colours.tolist() == [[255, 0, 255, 255]]


def test_depth_clouds_use_camera_and_colours(page: Page, talk: Talk, move: Move) -> None:
    move("map", "optical", (0, 0, 0))
    stream = page.display("DepthCloud", "/rgbd/depth", **{"Color Image Topic": "/rgbd/image"})
    header = {"frame_id": "optical"}
    pixels = np.zeros((2, 2, 3), np.uint8)
    pixels[1, 1] = (1, 2, 3)
    talk("/rgbd/camera_info", "sensor_msgs/CameraInfo", k=[2.0, 0, 0.5, 0, 2.0, 0.5, 0, 0, 1])
    talk("/rgbd/image", "sensor_msgs/Image", height=2, width=2, encoding="rgb8", step=6,
         data=pixels.tobytes())  # fmt: skip
    depth = np.array([[0, 1000], [0, 2000]], np.uint16)
    talk("/rgbd/depth", "sensor_msgs/Image", header=header, height=2, width=2, encoding="16UC1",
         step=4, data=depth.tobytes())  # fmt: skip
    _, points, colours = _points(stream.next())
    assert points == pytest.approx(np.array([[0.25, -0.25, 1], [0.5, 0.5, 2]]))
    assert colours.tolist() == [[0, 0, 0, 255], [1, 2, 3, 255]]


def test_maps_come_with_updates_and_move_with_their_frame(
    page: Page, talk: Talk, move: Move
) -> None:
    move("world", "map", (1, 0, 0))
    stream = page.display("Map", "/map", "world")
    info = {"resolution": 0.5, "width": 3, "height": 2, "origin": {"position": {"x": 10.0}}}
    talk("/map", "nav_msgs/OccupancyGrid", header={"frame_id": "map"}, info=info,
         data=[0, 100, -1, 1, 2, 3])  # fmt: skip
    frame = stream.next()
    assert (frame.kind, frame.number) == (21, 6)
    head = struct.unpack_from("<8f7I", frame.payload)
    assert head[:8] == (11, 0, 0, 0, 0, 0, 1, 0.5)
    number = head[10]
    assert head[8:] == (3, 2, number, 0, 0, 3, 2)
    assert list(frame.payload[64:]) == [0, 100, 255, 1, 2, 3]
    talk("/map_updates", "map_msgs/OccupancyGridUpdate", x=1, y=1, width=2, height=1,
         data=[7, 8])  # fmt: skip
    assert _part(stream.next()) == (number, (1, 1, 2, 1), [7, 8])
    move("world", "map", (2, 0, 0))
    moved = stream.next()
    assert struct.unpack_from("<f", moved.payload) == (12,)
    assert _part(moved) == (number, (0, 0, 0, 0), [])


def _part(frame: Binary) -> tuple[int, tuple[int, ...], list[int]]:
    assert frame.kind == 30
    _, _, number, *rect = struct.unpack_from("<7I", frame.payload, 32)
    return number, tuple(rect), list(frame.payload[64:])


def test_of_a_map_that_comes_again_only_what_changed_is_sent(
    page: Page, talk: Talk, move: Move
) -> None:
    move("world", "map", (0, 0, 0))
    stream = page.display("Map", "/map", "world")
    cells = np.zeros((400, 400), np.int8)

    def publish() -> None:
        height, width = cells.shape
        info = {"resolution": 0.05, "width": width, "height": height}
        talk("/map", "nav_msgs/OccupancyGrid", header={"frame_id": "map"}, info=info,
             data=cells.ravel().tolist())  # fmt: skip

    publish()
    first = stream.next()
    assert first.kind == 21
    number = struct.unpack_from("<I", first.payload, 40)[0]
    cells[10:12, 20:23] = 100
    cells[11, 20] = 0
    publish()
    assert _part(stream.next()) == (number, (20, 10, 3, 2), [100, 100, 100, 0, 100, 100])
    # An update that came before a whole map is part of it, or of a map that is no more.
    for x, y in ((400, 0), (-1, 0), (0, 399)):
        talk("/map_updates", "map_msgs/OccupancyGridUpdate", x=x, y=y, width=1, height=2,
             data=[1, 1])  # fmt: skip
    cells = np.pad(cells, 1)
    publish()
    grown = stream.until(lambda frame: frame.kind == 21)
    assert struct.unpack_from("<2I", grown.payload, 32) == (402, 402)
    assert struct.unpack_from("<I", grown.payload, 40)[0] != number
    assert np.array_equal(np.frombuffer(grown.payload[64:], np.int8), cells.ravel())


def test_updates_of_a_map_are_kept_while_its_page_asks_for_nothing(
    page: Page, talk: Talk, move: Move
) -> None:
    move("world", "map", (0, 0, 0))
    stream = page.open("display", acks=False, display="Map", topic="/map", fixed_frame="world")
    info = {"resolution": 1.0, "width": 40, "height": 10}
    talk("/map", "nav_msgs/OccupancyGrid", header={"frame_id": "map"}, info=info, data=[0] * 400)
    assert stream.next().kind == 21
    for i in range(400):
        talk("/map_updates", "map_msgs/OccupancyGridUpdate", x=i % 40, y=i // 40, width=1,
             height=1, data=[1 + i % 100])  # fmt: skip
    shown = np.zeros(400, int)
    wanted = np.array([1 + i % 100 for i in range(400)])

    def take(frame: Binary) -> bool:
        _, (x, y, width, height), cells = _part(frame)
        place = shown.reshape(10, 40)[y : y + height, x : x + width]
        place[...] = np.array(cells, int).reshape(height, width)
        stream.ack()
        return np.array_equal(shown, wanted)

    stream.ack()
    stream.until(take)


def test_plain_displays_carry_the_pose_of_their_frame(page: Page, talk: Talk, move: Move) -> None:
    move("map", "odom", (1, 2, 3))
    stream = page.display("Odometry", "/odom")
    talk("/odom", "nav_msgs/Odometry", header={"frame_id": "odom", "stamp": {"sec": 0}},
         pose={"pose": {"position": {"x": 5.0}}})  # fmt: skip
    item = stream.next()
    assert item["pose"] == [1, 2, 3, 0, 0, 0, 1]
    assert item["frame"] == "odom"
    assert item["message"]["pose"]["pose"]["position"]["x"] == 5.0
    assert len(item["message"]["pose"]["covariance"]) == 36


def test_a_display_waits_for_its_transform(page: Page, talk: Talk, move: Move) -> None:
    stream = page.display("PointStamped", "/early")
    talk("/early", "geometry_msgs/PointStamped", header={"frame_id": "late_frame"})
    status = stream.status.get(timeout=stretched())
    assert status["level"] == "error"
    assert status["text"].startswith("No transform from [late_frame] to [map]")
    move("map", "late_frame", (0, 0, 1))
    assert stream.next()["pose"] == [0, 0, 1, 0, 0, 0, 1]
    assert stream.status.get(timeout=stretched()) == {
        "op": "status", "ch": stream.number, "level": "ok", "text": ""
    }  # fmt: skip


def test_camera_tells_where_it_is_before_its_picture(page: Page, talk: Talk, move: Move) -> None:
    move("map", "lens", (0, 0, 1))
    stream = page.display("Camera", "/front/image_raw")
    picture = {"height": 2, "width": 2, "encoding": "mono8", "step": 2, "data": bytes(4)}
    talk("/front/image_raw", "sensor_msgs/Image", header={"frame_id": "lens"}, **picture)
    assert stream.next().kind == 10
    status = stream.status.get(timeout=stretched())
    assert status["text"].startswith("No CameraInfo received on [/front/camera_info].")
    talk("/front/camera_info", "sensor_msgs/CameraInfo", width=2, height=2)
    for expected in (True, False):
        talk("/front/image_raw", "sensor_msgs/Image", header={"frame_id": "lens"}, **picture)
        item = stream.next()
        if expected:
            assert item["pose"] == [0, 0, 1, 0, 0, 0, 1]
            assert item["camera_info"]["width"] == 2
            item = stream.next()
        assert item.kind == 10


def test_no_marker_is_left_out(page: Page, talk: Talk, move: Move) -> None:
    move("map", "arm", (0, 0, 1))
    stream = page.display("MarkerArray", "/markers")
    for number in range(50):
        marker = {"header": {"frame_id": "arm"}, "ns": "a", "id": number, "type": 1}
        talk("/markers", "visualization_msgs/MarkerArray", markers=[marker])
    found: list[int] = []
    while len(found) < 50:
        item = stream.next()
        assert item["poses"][0] == [0, 0, 1, 0, 0, 0, 1]
        assert len(item["poses"]) == len(item["message"]["markers"])
        found += [one["id"] for one in item["message"]["markers"]]
    assert found == list(range(50))


def test_markers_wait_for_their_frames_and_bring_meshes(
    page: Page, talk: Talk, move: Move, tmp_path: Any
) -> None:
    mesh = tmp_path / "cube.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    move("map", "near", (0, 0, 0))
    stream = page.display("Marker", "/marker")
    for number, frame in enumerate(("near", "far")):
        talk("/marker", "visualization_msgs/Marker", header={"frame_id": frame}, id=number,
             type=10, mesh_resource=f"file://{mesh}")  # fmt: skip
    item = stream.next()
    (marker,) = item["message"]["markers"]
    assert marker["id"] == 0
    assert len(marker["mesh"][0]["key"]) == 32
    assert stream.status.get(timeout=stretched())["text"].startswith("No transform from [far]")
    move("map", "far", (3, 0, 0))
    item = stream.next()
    assert [one["id"] for one in item["message"]["markers"]] == [1]
    assert item["poses"] == [[3, 0, 0, 0, 0, 0, 1]]


def test_interactive_markers_of_ros1_and_their_updates(page: Page, talk: Talk, move: Move) -> None:
    move("map", "base", (0, 0, 1))
    marker = {"header": {"frame_id": "base"}, "name": "handle", "controls": [{"name": "c"}]}
    talk("/gripper/update_full", "visualization_msgs/InteractiveMarkerInit", latch=True,
         server_id="s", markers=[marker])  # fmt: skip
    stream = page.display("InteractiveMarkers", "/gripper/update")
    item = stream.next()
    assert item["message"]["server_id"] == "s"
    assert item["message"]["markers"][0]["controls"][0]["name"] == "c"
    assert item["poses"] == [[0, 0, 1, 0, 0, 0, 1]]
    talk("/gripper/update", "visualization_msgs/InteractiveMarkerUpdate", server_id="s",
         poses=[{"name": "handle", "pose": {"position": {"x": 4.0}}}], erases=["old"])  # fmt: skip
    item = stream.next()
    assert item["message"]["poses"][0]["pose"]["position"]["x"] == 4.0
    assert item["message"]["erases"] == ["old"]
    assert item["message"]["markers"] == []


def test_interactive_markers_of_ros2_are_asked_for(page: Page, node: Node, move: Move) -> None:
    move("map", "base", (0, 0, 1))
    kind = service_type("visualization_msgs/srv/GetInteractiveMarkers")
    response = kind.Response()
    marker = message_type("visualization_msgs/msg/InteractiveMarker")(name="cube")
    marker.header.frame_id = "base"
    response.markers = [marker]
    node.create_service("/menu/get_interactive_markers", kind, lambda _request: response)
    stream = page.display("InteractiveMarkers", "/menu/update")
    assert stream.next()["message"]["markers"][0]["name"] == "cube"


def test_the_canvas_of_turtles(page: Page, talk: Talk) -> None:
    stream = page.open("turtles", node="/sim")
    talk("/sim/_canvas", "sensor_msgs/Image", height=8, width=8, encoding="rgb8", step=24,
         data=bytes(192))  # fmt: skip
    frame = stream.next()
    assert (frame.kind, frame.number) == (10, 8 << 16 | 8)


@pytest.mark.parametrize(
    ("params", "text", "known"),
    [
        ({"display": "PointClout2"}, "there is no display 'PointClout2'", "PointCloud2"),
        ({"display": "LaserScan", "Axis": "W"}, "there is no axis 'W'", "X"),
        (
            {"display": "LaserScan", "Color Transformer": "Rgb"},
            "there is no Color Transformer 'Rgb'",
            "RGB8",
        ),
    ],
)
def test_displays_refuse_what_they_do_not_know(
    page: Page, params: dict[str, Any], text: str, known: str
) -> None:
    with pytest.raises(RefusedError) as caught:
        page.open("display", topic="/x", fixed_frame="map", **params)
    assert str(caught.value) == text
    assert known in caught.value.error["known"]


@pytest.mark.parametrize(
    ("display", "text"),
    [
        ("LaserScan", "std_msgs/msg/String has no header, so it has no place"),
        ("Path", "std_msgs/msg/String has no header, so it has no place"),
        ("DepthCloud", "std_msgs/msg/String has no header, so it has no place"),
        ("Map", "std_msgs/msg/String is no map"),
        ("Marker", "std_msgs/msg/String is no marker"),
        ("Image", "std_msgs/msg/String is no picture"),
    ],
)
def test_a_message_of_the_wrong_type_is_a_status(
    page: Page, talk: Talk, display: str, text: str
) -> None:
    stream = page.display(display, "/just_words")
    talk("/just_words", "std_msgs/String", data="x")
    status = stream.status.get(timeout=stretched())
    assert (status["level"], status["text"]) == ("error", text)


@pytest.mark.parametrize("display", ["PointCloud2", "Marker", "Path", "InteractiveMarkers"])
def test_bytes_of_another_definition_are_a_status(page: Page, graph: Graph, display: str) -> None:
    topic = f"/rubbish_{display}/update"
    stream = page.display(display, topic)
    echo = page.open("topic.echo", topic=topic)
    with Graph.open(port=graph.port, role="client", environ={}) as other:
        sender = other.create_node("sender", rosout=False)
        publisher = sender.create_publisher(topic, "visualization_msgs/MarkerArray")
        eventually(lambda: publisher.matched)
        publisher.publish_raw(b"\x00\x01\x00\x00" + b"\xff" * 40)
        for one in (stream, echo):
            status = one.status.get(timeout=stretched())
            assert status["level"] == "error"
            assert "44 bytes are not a visualization_msgs/msg/MarkerArray" in status["text"]


@pytest.mark.parametrize("topic", ["", "/", "  "])
def test_a_topic_needs_a_name(page: Page, topic: str) -> None:
    with pytest.raises(RefusedError, match="a topic needs a name, such as /cmd_vel"):
        page.display("Map", topic)
    with pytest.raises(RefusedError, match="a topic needs a name, such as /cmd_vel"):
        page.call("topic.publish", topic=topic, type="std_msgs/Empty")


def _cloud(rows: list[Any], fourth: str, frame: str = "laser") -> dict[str, Any]:
    fields = [
        {"name": name, "offset": 4 * place, "datatype": 7, "count": 1}
        for place, name in enumerate(("x", "y", "z", fourth))
    ]
    data = np.array(rows, np.float32).tobytes()
    return {"header": {"frame_id": frame}, "height": 1, "width": len(rows), "fields": fields,
            "point_step": 16, "row_step": len(data), "data": data}  # fmt: skip


def _points(frame: Binary) -> tuple[Any, Any, Any]:
    assert frame.kind == 20
    count = frame.number
    assert len(frame.payload) == 32 + 16 * count
    pose = np.frombuffer(frame.payload, "<f4", 8)
    points = np.frombuffer(frame.payload, "<f4", 3 * count, 32).reshape(-1, 3)
    colours = np.frombuffer(frame.payload, np.uint8, 4 * count, 32 + 12 * count).reshape(-1, 4)
    return pose, points, colours


def _decoded(frame: Binary) -> Any:
    return np.asarray(Image.open(io.BytesIO(frame.payload)).convert("RGB")).astype(int)
