"""Every parameter of the SLAM nodes: it arrives under its name, and it does what it says."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.mapping.slam import SlamParameters, save_graph
from gazelle.nodes.parameters import node_reader
from gazelle.nodes.slam.cartographer.configuration import flags_of, read_configuration
from gazelle.nodes.slam.docs import page
from gazelle.nodes.slam.parameters import SLAM_NODES, SlamOptions
from gazelle.parameters.trees import nested

ROOT = Path(__file__).parents[3]


def _bench() -> Any:
    """The module beside this one; tests are imported without packages."""
    name = "slam_bench"
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(name, Path(__file__).parent / f"{name}.py")
        assert spec
        assert spec.loader
        sys.modules[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules[name])
    return sys.modules[name]


b = _bench()
USED = [(family, key) for family, one in SLAM_NODES.items() for key in one.uses]
IDLE = [
    (family, row)
    for family, one in SLAM_NODES.items()
    for row in one.table.rows
    if row.kind == "refused"
]
_ENGINE = {one.name for one in fields(SlamParameters)}


def _value(options: SlamOptions, name: str) -> Any:
    return getattr(options.slam if name in _ENGINE else options, name)


def _other(value: Any) -> Any:
    """Another value of the same kind."""
    match value:
        case bool():
            return not value
        case int():
            return value + 3
        case float():
            return min(value, 20.0) * 0.5
        case str():
            return "other"
        case _:
            return [1.0, 2.0, 0.5]


def test_the_page_is_generated_from_the_tables() -> None:
    command = "python -m gazelle.nodes.slam.docs > docs/slam.md"
    assert (ROOT / "docs" / "slam.md").read_text(encoding="utf-8") == page(), f"run: {command}"


@pytest.mark.parametrize(("family", "key"), USED)
def test_a_parameter_arrives_under_its_name(family: str, key: str) -> None:
    slam_node = SLAM_NODES[family]
    option, default = slam_node.uses[key], slam_node.table.row(key).default
    other = _other(default)
    expected = tuple(other) if isinstance(other, list) else other
    assert _value(b.told(family, {key: other}), option) == expected
    if option not in ("max_range_m", "start_pose"):
        assert _value(b.told(family, {}), option) == default


@pytest.mark.parametrize(("family", "row"), IDLE, ids=lambda one: getattr(one, "key", one))
def test_a_parameter_without_effect_is_refused_with_its_reason(family: str, row: Any) -> None:
    found = Diagnostics()
    settings = node_reader(SLAM_NODES[family].table, nested({row.key: 1}), "/slam", found)
    settings.report_unknown()
    assert [row.meaning in str(one) and row.key in str(one) for one in found] == [True]


def _drive(**options: Any) -> Any:
    engine = {key: options.pop(key) for key in list(options) if key in _ENGINE}
    slam = replace(SlamParameters(keyframe_m=0.2), **engine)
    frames = {key: options[f"{key}_frame"] for key in ("odom", "base") if f"{key}_frame" in options}
    return b.Drive(replace(SlamOptions(), slam=slam, **options), **frames)


def _frame(name: str) -> None:
    assert _drive(**{f"{name}_frame": "own"}).drive().kept > 3
    named: dict[str, Any] = {f"{name}_frame": "own"}
    assert not b.Drive(replace(SlamOptions(), **named)).drive().kept


def base_frame() -> None:
    _frame("base")


def odom_frame() -> None:
    _frame("odom")


def map_frame() -> None:
    drive = _drive(map_frame="world").drive()
    drive.mapper.publish_map()
    drive.mapper.publish_transform(0)
    assert drive.node.sent["map"][-1].header.frame_id == "world"
    assert drive.node.sent["/tf"][-1].transforms[0].header.frame_id == "world"


def scan_topic() -> None:
    assert not _drive(scan_topic="front_scan").drive().used
    drive = _drive(scan_topic="front_scan")
    deliver = drive.node.deliver
    drive.node.deliver = lambda topic, message: deliver(
        topic.replace("scan", "front_scan"), message
    )
    assert drive.drive().used


def map_period_s() -> None:
    each = _drive(map_period_s=0.0).drive()
    assert len(each.node.sent["map"]) == each.kept
    assert "map" not in _drive(map_period_s=5.0).drive().node.sent


def tf_ahead_s() -> None:
    drive = _drive(tf_ahead_s=0.3)
    drive.mapper.publish_transform(1_000_000_000)
    stamp = drive.node.sent["/tf"][0].transforms[0].header.stamp
    assert (stamp.sec, stamp.nanosec) == (1, 300_000_000)


def throttle() -> None:
    assert _drive(throttle=3).drive().used == 7


def least_interval_s() -> None:
    assert _drive(least_interval_s=0.12).drive().used == 7


def resolution_m() -> None:
    drive = _drive(resolution_m=0.1).drive()
    drive.mapper.publish_map()
    info = drive.node.sent["map"][-1].info
    assert info.resolution == pytest.approx(0.1)
    assert info.width == pytest.approx(60, abs=4)


def occupied_share() -> None:
    walls = [
        (_drive(occupied_share=share).drive().mapper.grid().cells == 100).sum()
        for share in (0.05, 0.9)
    ]
    assert walls[0] > 1.2 * walls[1]


def range_limit_m() -> None:
    engine = _drive(range_limit_m=2.5).drive().mapper.engine
    assert max(engine.keyframes[k].reach_m for k in range(len(engine.keyframes))) < 2.5


def max_range_m() -> None:
    engine = _drive(max_range_m=2.0).drive().mapper.engine
    assert max(engine.keyframes[k].reach_m for k in range(len(engine.keyframes))) <= 2.0


def keyframe_m() -> None:
    few, many = (_drive(keyframe_m=way, keyframe_rad=9.0).drive().kept for way in (1.0, 0.1))
    assert (few, many) == (3, 20)


def keyframe_rad() -> None:
    few, many = (_drive(keyframe_m=9.0, keyframe_rad=turn).drive().kept for turn in (0.49, 0.11))
    assert few < many


def submap_scans() -> None:
    one, many = (_drive(submap_scans=count).drive().mapper.engine for count in (1, 25))
    assert not np.array_equal(one.trajectory(), many.trajectory())


def loop_closing() -> None:
    rounds = [(2 * np.cos(a), np.sin(a), a + np.pi / 2) for a in np.arange(0, 13, 0.1)]
    told = {"loop_gap_m": 3.0, "max_range_m": 3.0}
    open_, closed = (
        _drive(loop_closing=on, **told).drive(rounds).mapper.engine for on in (False, True)
    )
    assert open_.loops == 0 < closed.loops


def _known_of_odometry(**options: float) -> Any:
    """What edges say when scans say nothing."""
    drive = _drive(**options).drive(ranges=[float("nan")] * 180)
    return drive.mapper.engine.edges.information


def odometry_m_per_m() -> None:
    sure, unsure = (_known_of_odometry(odometry_m_per_m=share) for share in (0.01, 1.0))
    assert (unsure[:, 0, 0] < 0.5 * sure[:, 0, 0]).all()


def odometry_rad_per_rad() -> None:
    sure, unsure = (_known_of_odometry(odometry_rad_per_rad=share) for share in (0.01, 2.0))
    assert (unsure[:, 2, 2] < 0.5 * sure[:, 2, 2]).all()


def odometry_rad_per_m() -> None:
    sure, unsure = (_known_of_odometry(odometry_rad_per_m=share) for share in (0.01, 2.0))
    assert (unsure[:, 2, 2] < 0.5 * sure[:, 2, 2]).all()


BEHAVIOUR: dict[str, Callable[[], None]] = {
    one.__name__: one
    for one in (
        base_frame, odom_frame, map_frame, scan_topic, map_period_s, tf_ahead_s, throttle,
        least_interval_s, resolution_m, occupied_share, range_limit_m, max_range_m, keyframe_m,
        keyframe_rad, submap_scans, loop_closing, odometry_m_per_m, odometry_rad_per_rad,
        odometry_rad_per_m,
    )
}  # fmt: skip
# Of these a running node is needed, below.
RUNNING = {"tf_period_s", "publishes_tf", "mode", "map_file", "start_pose"}


@pytest.mark.parametrize("option", BEHAVIOUR)
def test_an_option_does_what_it_says(option: str) -> None:
    BEHAVIOUR[option]()


def test_every_option_has_its_behaviour_tested() -> None:
    used = {option for one in SLAM_NODES.values() for option in one.uses.values()}
    assert used == set(BEHAVIOUR) | RUNNING


@pytest.mark.parametrize(
    ("node", "word", "period"),
    [
        ("gmapping/slam_gmapping", "_transform_publish_period:=0", None),
        ("hector_mapping/hector_mapping", "_pub_map_odom_transform:=false", None),
        ("slam_karto/slam_karto", "_transform_publish_period:=0.5", 0.5),
    ],
)
def test_transforms_are_sent_as_often_as_wanted(
    bench: Any, node: str, word: str, period: float | None
) -> None:
    sent = bench.listen("/tf", "tf2_msgs/msg/TFMessage")
    bench.start(node, word, "_map_frame:=sparse")
    bench.start(
        node,
        "__name:=plain",
        "_map_frame:=plain",
        *(("_transform_publish_period:=0.5",) if period else ()),
    )

    def stamps_s(frame: str) -> list[float]:
        headers = [one.transforms[0].header for one in list(sent)]
        return [h.stamp.sec + 1e-9 * h.stamp.nanosec for h in headers if h.frame_id == frame]

    bench.eventually(lambda: len(stamps_s("plain")) > 4)
    if period is None:
        assert not stamps_s("sparse")
    else:
        # A first one may come late; those after it keep to their times.
        assert np.median(np.diff(stamps_s("plain"))) > 0.3


def test_a_saved_graph_is_localised_in_from_the_pose_that_is_given(
    bench: Any, tmp_path: Path
) -> None:
    engine = _drive().drive().mapper.engine
    save_graph(engine, tmp_path / "room.posegraph")
    maps = bench.listen("/map", "nav_msgs/msg/OccupancyGrid")
    bench.start(
        "slam_toolbox/async_slam_toolbox_node", "_mode:=localization",
        f"_map_file_name:={tmp_path / 'room'}", "_map_start_pose:=[1.0, 0.5, 0.2]",
    )  # fmt: skip
    bench.eventually(lambda: maps)
    assert maps[-1].info.width * maps[-1].info.resolution == pytest.approx(6.0, abs=0.4)


def test_cartographers_file_is_read_and_what_has_no_effect_is_told(tmp_path: Path) -> None:
    (tmp_path / "robot.lua").write_text(
        'options = {\n  tracking_frame = "imu_link", -- "base"\n  num_laser_scans = 1,\n'
        "  publish_to_tf = false,\n}\ninclude 'trajectory_builder.lua' include 'map_builder.lua'\n"
        "TRAJECTORY_BUILDER_2D.max_range = 3.5\n"
        "POSE_GRAPH.constraint_builder.min_score = 0.65\nreturn options"
    )
    words = ("-configuration_directory", str(tmp_path), "-configuration_basename", "robot.lua")
    given = read_configuration(flags_of(words))
    found = Diagnostics()
    settings = node_reader(SLAM_NODES["cartographer"].table, nested(given), "/cartographer", found)
    settings.report_unknown()
    assert given["tracking_frame"] == "imu_link"
    assert given["max_range"] == 3.5
    assert given["publish_to_tf"] is False
    text = " ".join(map(str, found))
    assert "num_laser_scans" in text
    assert "constraint_builder.min_score" in text
