"""Bags as recordings."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gazelle.bag import BagError, cdr_connection, create_bag
from gazelle.interfaces import fill, message_type, to_cdr
from gazelle.recording import bag_recording

_CART = """<robot name="cart">
  <link name="base"><visual><geometry><box size="0.4 0.3 0.2"/></geometry></visual></link>
  <link name="mast"><visual><geometry><box size="0.1 0.1 0.5"/></geometry></visual></link>
  <joint name="foot" type="fixed"><parent link="base"/><child link="mast"/>
    <origin xyz="0 0 0.4"/></joint>
</robot>"""
_EPOCH_NS = 1_700_000_000_000_000_000


def _transform(parent: str, child: str, x: float) -> dict[str, Any]:
    turn = {"translation": {"x": x}, "rotation": {"w": 1.0}}
    return {"header": {"frame_id": parent}, "child_frame_id": child, "transform": turn}


@pytest.fixture
def bag_of(tmp_path: Path) -> Callable[..., Path]:
    """Writes a bag of messages: time (s), topic, type and fields."""

    def make(*rows: tuple[float, str, str, dict[str, Any]]) -> Path:
        path = tmp_path / "run"
        writer = create_bag(path, "mcap")
        known: dict[str, Any] = {}
        for time_s, topic, type_name, fields in rows:
            message = message_type(type_name)()
            fill(message, fields)
            if topic not in known:
                known[topic] = writer.add(cdr_connection(topic, message.TYPE_NAME))
            writer.write(known[topic], _EPOCH_NS + round(time_s * 1e9), to_cdr(message))
        writer.close()
        return path

    return make


def _drive(prefix: str = "") -> list[tuple[float, str, str, dict[str, Any]]]:
    tf = "tf2_msgs/TFMessage"
    static = {"transforms": [_transform("map", "odom", 10.0)]}
    rows = [(0.0, "/tf_static", tf, static)]
    for step in range(51):
        moved = {"transforms": [_transform("odom", f"{prefix}base", 0.02 * step)]}
        rows.append((0.02 * step, "/tf", tf, moved))
        rows.append((0.02 * step, "/speed", "std_msgs/Float32", {"data": float(step)}))
    return rows


@pytest.mark.parametrize("prefix", ["", "robot_1/"])
def test_links_stand_where_tf_has_them_in_the_map(bag_of: Callable, prefix: str) -> None:
    description = (0.0, "/robot_description", "std_msgs/String", {"data": _CART})
    recording = bag_recording(bag_of(description, *_drive(prefix)))
    (stretch,) = recording.stretches
    assert stretch.link_names == ("ground::link", "cart::base", "cart::mast")
    assert recording.duration_s == pytest.approx(1.0)
    assert stretch.poses[0, 1, :3] == pytest.approx([10.0, 0.0, 0.0])
    assert stretch.poses[-1, 1, :3] == pytest.approx([11.0, 0.0, 0.0])
    # The mast is not in tf: it stays on its base.
    assert stretch.poses[-1, 2, :3] == pytest.approx([11.0, 0.0, 0.4])
    assert np.diff(stretch.times_ns).min() >= 20_000_000
    assert "/speed" in [one.name for one in recording.topics]


def test_a_robot_may_come_from_a_file(bag_of: Callable, tmp_path: Path) -> None:
    (tmp_path / "cart.urdf").write_text(_CART)
    recording = bag_recording(bag_of(*_drive()), robot=str(tmp_path / "cart.urdf"))
    assert recording.stretches[0].world.models[1].name == "cart"


def test_what_is_missing_is_told_with_what_to_do(bag_of: Callable, tmp_path: Path) -> None:
    with pytest.raises(BagError, match=r"holds no robot_description\n  fix: name the robot's file"):
        bag_recording(bag_of(*_drive()))


def test_a_bag_without_tf_cannot_move_a_robot(bag_of: Callable) -> None:
    description = (0.0, "/robot_description", "std_msgs/String", {"data": _CART})
    with pytest.raises(BagError, match=r"holds no tf, which says where the robot is\n  fix: reco"):
        bag_recording(bag_of(description))
