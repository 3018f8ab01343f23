"""The HTML file that replays a recording: what is in it, how large it is, what it cannot do."""

from __future__ import annotations

import base64
import json
import math
import re
import struct
import zlib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.recorded import messages, rolling

from gazelle.description.model import Box, Link, Material, Model, Visual
from gazelle.geometry import Pose
from gazelle.recording import Recording, Stretch
from gazelle.studio.replay import render_html, write_html
from gazelle.studio.replay.packing import Pack

_EVIL = "</script><img src=x onerror=alert(1)>"


class _Read:
    """What a page holds, read as its program reads it."""

    def __init__(self, html: str) -> None:
        text = re.search(r'id="recording">([^<]*)<', html)
        assert text is not None
        data = zlib.decompress(base64.b64decode(text[1]))
        (length,) = struct.unpack_from("<I", data)
        self.head = json.loads(data[4 : 4 + length])
        self._data = data[4 + length :]

    def integers(self, place: list[int]) -> np.ndarray:
        offset, length, rows, columns, order = place
        values, value, shift = [], 0, 0
        for byte in self._data[offset : offset + length]:
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                values.append((value >> 1) ^ -(value & 1))
                value = shift = 0
        table = np.array(values, np.int64).reshape(columns, rows)
        for _ in range(order):
            table = np.cumsum(table, axis=1)
        return table.T

    def raw(self, place: list[int]) -> bytes:
        return self._data[place[0] : place[0] + place[1]]

    def track(self, body: str) -> Any:
        names = [one["name"] for one in self.head["scene"]["bodies"]]
        return self.head["tracks"][names.index(body)]


def _odom(t: float) -> dict[str, Any]:
    noise = math.sin(1000 * t)
    return {
        "header": {"frame_id": "odom", "stamp": {"sec": int(t), "nanosec": int(t % 1 * 1e9)}},
        "pose": {"pose": {"position": {"x": t, "y": 0.01 * noise}}},
        "twist": {"twist": {"linear": {"x": 1.0 + 1e-3 * noise}}},
    }


def _scan(t: float) -> dict[str, Any]:
    beams = [2.0 + 0.3 * math.sin(0.1 * i + t) + 0.01 * math.sin(997 * i * t) for i in range(360)]
    return {
        "header": {"frame_id": "body"},
        "angle_min": -3.0,
        "angle_increment": 6.0 / 360,
        "range_min": 0.1,
        "range_max": 6.0,
        "ranges": [math.inf, *beams[1:]],
    }


def test_arrays_come_back_as_they_were() -> None:
    values = np.array([[0, 5], [-3, 2**40], [2**31, -(2**40)], [7, 7]])
    pack = Pack()
    places = [pack.integers(values, order) for order in (1, 2)]
    pack.raw(b"as it is")
    data = pack.bytes({})
    read = _Read(f'<script id="recording">{base64.b64encode(zlib.compress(data)).decode()}<')
    for place in places:
        assert read.integers(place).tolist() == values.tolist()


def test_poses_are_told_25_times_a_second_within_a_tenth_of_a_millimetre() -> None:
    read = _Read(render_html(rolling(2.0)))
    frames, track = read.head["frames"], read.track("cart::ball")
    assert (frames["count"], frames["period_s"], frames["duration_s"]) == (51, 0.04, 2.0)
    places = read.integers(track["places"]) * track["steps"][0]
    turns = read.integers(track["turns"]) * track["steps"][1]
    times = np.arange(51) * 0.04
    assert places[:, 0] == pytest.approx(times, abs=1e-4)
    assert turns[:, 2] == pytest.approx(np.sin(times / 2), abs=1e-4)
    assert read.track("ground::link") == {"pose": [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]}


def test_a_minute_of_driving_takes_less_than_half_a_megabyte() -> None:
    topics = (
        messages("/odom", "nav_msgs/Odometry", 60.0, 25.0, _odom),
        messages("/scan", "sensor_msgs/LaserScan", 60.0, 5.0, _scan),
    )
    empty, full = (len(render_html(rolling(60.0, topics=one))) for one in ((), topics))
    # The viewer is most of the first; the law is on what a minute adds.
    assert empty < 260_000
    assert full - empty < 250_000


def test_values_of_topics_come_back_and_long_arrays_by_their_length() -> None:
    topics = (
        messages("/odom", "nav_msgs/Odometry", 2.0, 25.0, _odom),
        messages("/scan", "sensor_msgs/LaserScan", 2.0, 5.0, _scan),
        messages("/word", "std_msgs/String", 2.0, 1.0, lambda t: {"data": f"word {t:g}"}),
    )
    read = _Read(render_html(rolling(2.0, topics=topics)))
    odom, scan, word = read.head["topics"]
    columns = {one["name"]: one for one in odom["columns"]}
    x = columns["pose.pose.position.x"]
    times = read.integers(odom["times"])[:, 0] * 1e-6
    assert (read.integers(x["at"])[:, 0] * x["step"] + x["low"]) == pytest.approx(times, abs=1e-4)
    assert columns["header.frame_id"]["text"] == "odom"
    assert columns["pose.pose.position.z"]["number"] == 0.0
    assert (odom["type"], odom["count"]) == ("nav_msgs/Odometry", 50)
    assert {one["name"]: one for one in scan["columns"]}["ranges.length"]["number"] == 360.0
    (data,) = word["columns"]
    assert data["words"] == ["word 0", "word 1"]


def test_scans_maps_and_paths_are_drawn_where_they_are() -> None:
    grid = {
        "header": {"frame_id": "map"},
        "info": {"width": 3, "height": 2, "resolution": 0.5, "origin": {"position": {"x": -1.0},
                                                                        "orientation": {"w": 1.0}}},
        "data": [0, 100, -1, 0, 0, 50],
    }  # fmt: skip
    way = {"header": {"frame_id": "map"},
           "poses": [{"pose": {"position": {"x": 0.1 * i}}} for i in range(20)]}  # fmt: skip
    tf = {
        "transforms": [
            {"header": {"frame_id": "map"}, "child_frame_id": "body",
             "transform": {"translation": {"x": -3.0}, "rotation": {"w": 1.0}}},
        ]
    }  # fmt: skip
    topics = (
        messages("/map", "nav_msgs/OccupancyGrid", 1.0, 1.0, lambda _t: grid),
        messages("/plan", "nav_msgs/Path", 1.0, 1.0, lambda _t: way),
        messages("/scan", "sensor_msgs/LaserScan", 1.0, 5.0, _scan),
        messages("/tf_static", "tf2_msgs/TFMessage", 1.0, 1.0, lambda _t: tf),
    )
    read = _Read(render_html(rolling(1.0, speed_m_s=0.0, topics=topics)))
    drawings = read.head["drawings"]
    (shown,) = drawings["maps"][0]["versions"]
    # The body stands at x = 0, z = 0.15, and tf has it at x = -3 of the map.
    assert shown["pose"][:3] == pytest.approx([2.0, 0.0, 0.15], abs=1e-5)
    assert read.raw(shown["cells"]) == bytes([0, 100, 255, 0, 0, 50])
    (path,) = drawings["paths"][0]["versions"]
    assert (read.integers(path["points"])[:, 0] * path["step"])[-1] == pytest.approx(1.9, abs=0.005)
    (scan,) = drawings["scans"]
    ranges = read.integers(scan["ranges"]).reshape(-1, scan["beams"]) * scan["range_step"]
    assert scan["body"] == "cart::body"
    assert ranges[0, 0] == 0.0
    assert ranges[0, 10] == pytest.approx(_scan(0.0)["ranges"][10], abs=0.006)


def test_a_model_that_goes_is_there_for_its_time_only() -> None:
    whole = rolling(1.0)
    old = whole.stretches[0]
    bare = replace(old.world, models=old.world.models[:1])
    later = Stretch(bare, ("ground::link",), old.times_ns + 1_020_000_000, old.poses[:, :1])
    read = _Read(render_html(Recording((old, later))))
    count = read.head["frames"]["count"]
    assert read.track("cart::body")["there"] == [[0, 26]]
    assert count == 52
    assert "there" not in read.track("ground::link")


def test_textures_become_small(tmp_path: Path) -> None:
    picture = tmp_path / "wood.png"
    Image.effect_noise((800, 480), 60).convert("RGB").save(picture)
    box = Visual("b", Box((1.0, 1.0, 1.0)), material=Material(texture=picture))
    whole = rolling(0.1)
    old = whole.stretches[0]
    model = Model(
        "crate", Pose((2.0, 0.0, 0.5)), static=True, links=(Link("link", visuals=(box,)),)
    )
    world = replace(old.world, models=(*old.world.models, model))
    read = _Read(render_html(Recording((replace(old, world=world),))))
    ((key, place),) = read.head["textures"].items()
    (tmp_path / "small.webp").write_bytes(read.raw(place))
    with Image.open(tmp_path / "small.webp") as small:
        assert small.size == (512, 307)
    bodies = {one["name"]: one for one in read.head["scene"]["bodies"]}
    assert bodies["crate::link"]["visuals"][0]["material"]["texture"] == key


def test_names_of_the_users_files_never_become_markup() -> None:
    topics = (messages("/word", "std_msgs/String", 0.1, 10.0, lambda _t: {"data": _EVIL}),)
    topics = (replace(topics[0], name=f"/{_EVIL}"),)
    html = render_html(rolling(0.1, name=f"cart{_EVIL}", topics=topics), title=_EVIL)
    assert "<img" not in html
    assert "onerror" not in html.replace("&lt;img src=x onerror=alert(1)&gt;", "")
    assert html.count("<script") == html.count("</script>") == 3
    assert "<title>&lt;/script&gt;&lt;img src=x onerror=alert(1)&gt;</title>" in html
    assert _Read(html).head["title"] == _EVIL


def test_the_page_may_ask_nobody_for_anything() -> None:
    html = render_html(rolling(0.1))
    assert "default-src &#x27;none&#x27;; script-src &#x27;unsafe-inline&#x27;" in html
    for word in ("http://", "https://", "src=", "href=", "@import"):
        assert word not in html


def test_equal_recordings_give_equal_pages_and_a_file_is_written_in_one_go(tmp_path: Path) -> None:
    path = write_html(rolling(0.5), tmp_path / "run.html")
    assert path.read_text(encoding="utf-8") == render_html(rolling(0.5))
    assert [one.name for one in tmp_path.iterdir()] == ["run.html"]
    with pytest.raises(FileNotFoundError):
        write_html(rolling(0.1), tmp_path / "nowhere" / "run.html")


def test_numbers_that_are_none_leave_out_what_they_are_of() -> None:
    def broken(_t: float) -> dict[str, Any]:
        return {**_scan(0.0), "angle_min": math.nan}

    bad_map = {"header": {"frame_id": "map"}, "data": [0],
               "info": {"width": 1, "height": 1, "resolution": math.nan}}  # fmt: skip
    far = {"header": {"frame_id": "map"}, "poses": [{"pose": {"position": {"x": math.inf}}}] * 2}
    topics = (
        messages("/map", "nav_msgs/OccupancyGrid", 1.0, 1.0, lambda _t: bad_map),
        messages("/number", "std_msgs/Float32", 1.0, 5.0,
                 lambda t: {"data": math.nan if t == 0.2 else t}),
        messages("/plan", "nav_msgs/Path", 1.0, 1.0, lambda _t: far),
        messages("/scan", "sensor_msgs/LaserScan", 1.0, 5.0, broken),
    )  # fmt: skip
    whole = rolling(1.0, topics=topics)
    whole.stretches[0].poses[10:20, 1] = np.nan
    read = _Read(render_html(whole))
    assert read.head["drawings"]["maps"] == read.head["drawings"]["scans"] == []
    assert read.head["topics"][1]["columns"][0]["gaps"] == [1]
    assert read.track("cart::body")["there"] == [[0, 5], [10, 26]]


def test_large_maps_are_thinned_and_the_same_map_is_told_once() -> None:
    grid = {
        "header": {"frame_id": "map"},
        "info": {"width": 2000, "height": 1500, "resolution": 0.05},
    }
    topic = messages("/map", "nav_msgs/OccupancyGrid", 3.0, 1.0, lambda _t: grid)
    costs = messages("/local_costmap/costmap", "nav_msgs/OccupancyGrid", 1.0, 1.0, lambda _t: grid)
    for message in (*topic.messages, *costs.messages):
        message.data = np.zeros(3_000_000, np.int8)
    read = _Read(render_html(rolling(3.0, topics=(costs, topic))))
    (shown,) = read.head["drawings"]["maps"]
    (version,) = shown["versions"]
    assert (version["size"], version["resolution"]) == ([1000, 750], pytest.approx(0.1))
