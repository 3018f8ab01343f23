from __future__ import annotations

import re
import threading

import numpy as np
import pytest
from tests.patience import stretched

from gazelle.geometry import Pose
from gazelle.graph.tf import (
    ConnectivityError,
    ExtrapolationError,
    InvalidFrameError,
    StampedPose,
    TransformBuffer,
    UnknownFrameError,
)

S = 1_000_000_000
T_map_odom = Pose.from_xyz_rpy((1.0, 2.0, 0.0), (0.0, 0.0, 0.3))
T_odom_base = Pose.from_xyz_rpy((0.5, 0.0, 0.0), (0.0, 0.0, -0.7))
T_base_laser = Pose.from_xyz_rpy((0.1, 0.0, 0.2), (0.1, 0.2, 0.3))
T_base_wheel = Pose.from_xyz_rpy((0.0, 0.3, 0.0), (1.0, 0.0, 0.0))


@pytest.fixture
def buffer() -> TransformBuffer:
    made = TransformBuffer()
    made.set_transform("base", "laser", 0, T_base_laser, is_static=True, authority="/rsp")
    for second in (1, 2):
        made.set_transform("map", "odom", second * S, T_map_odom, authority="/slam")
        made.set_transform("odom", "base", second * S, T_odom_base, authority="/drive")
        made.set_transform("base", "wheel", second * S, T_base_wheel, authority="/rsp")
    return made


def _same(one: Pose, two: Pose) -> bool:
    return np.allclose(one.matrix(), two.matrix(), atol=1e-12)


@pytest.mark.parametrize(
    ("target", "source", "expected"),
    [
        ("map", "laser", T_map_odom @ T_odom_base @ T_base_laser),
        ("laser", "map", (T_map_odom @ T_odom_base @ T_base_laser).inverse()),
        ("wheel", "laser", T_base_wheel.inverse() @ T_base_laser),
        ("odom", "wheel", T_odom_base @ T_base_wheel),
        ("base", "base", Pose()),
    ],
)
def test_any_two_frames_of_the_tree(
    buffer: TransformBuffer, target: str, source: str, expected: Pose
) -> None:
    for stamp_ns in (0, 2 * S, S + S // 2):
        found = buffer.lookup_transform(target, source, stamp_ns)
        assert (found.frame_id, found.child_frame_id) == (target, source)
        assert _same(found.pose, expected)


def test_latest_common_time_is_that_of_the_slowest_frame(buffer: TransformBuffer) -> None:
    buffer.set_transform("odom", "base", 3 * S, T_odom_base)
    assert buffer.lookup_transform("map", "laser").stamp_ns == 2 * S
    assert buffer.lookup_transform("odom", "laser").stamp_ns == 3 * S
    assert buffer.lookup_transform("base", "laser").stamp_ns == 0
    assert buffer.latest_common_time_ns("wheel", "map") == 2 * S


def test_moving_frame_is_interpolated(buffer: TransformBuffer) -> None:
    buffer.set_transform("odom", "base", 3 * S, Pose((1.5, 0.0, 0.0), T_odom_base.quat_xyzw))
    found = buffer.lookup_transform("odom", "base", 2 * S + S // 4)
    assert found.pose.position_m == pytest.approx((0.75, 0.0, 0.0))


def test_between_two_times_through_a_fixed_frame() -> None:
    buffer = TransformBuffer()
    for second, x_m in ((1, 0.0), (2, 3.0)):
        buffer.set_transform("odom", "base", second * S, Pose((x_m, 0.0, 0.0)))
    found = buffer.lookup_transform_full("base", 2 * S, "base", 1 * S, "odom")
    assert found == StampedPose("base", "base", 2 * S, Pose((-3.0, 0.0, 0.0)))


@pytest.mark.parametrize(
    ("target", "source", "stamp_ns", "kind", "text"),
    [
        ("mop", "base", 0, UnknownFrameError,
         '"mop" passed to lookupTransform argument target_frame does not exist. Did you mean map?'),
        ("map", "zzz", 0, UnknownFrameError,
         '"zzz" passed to lookupTransform argument source_frame does not exist. '),
        ("", "base", 0, InvalidFrameError,
         "Invalid argument passed to lookupTransform argument target_frame in tf2 frame_ids "
         "cannot be empty"),
        ("map", "/base", 0, InvalidFrameError,
         'Invalid argument "/base" passed to lookupTransform argument source_frame in tf2 '
         "frame_ids cannot start with a '/' like: "),
        ("map", "island", 0, ConnectivityError,
         "Could not find a connection between 'map' and 'island' because they are not part of the "
         "same tree.Tf has two or more unconnected trees.\n  nobody publishes a transform from the "
         "tree of 'map' to 'sea'; that is the job of robot_state_publisher, which wants every "
         "joint in /joint_states, or a static_transform_publisher"),
        ("map", "laser", 5 * S, ExtrapolationError,
         "Lookup would require extrapolation 3.000000000s into the future.  Requested time "
         "5.000000000 but the latest data is at time 2.000000000, when looking up transform from "
         "frame [laser] to frame [map]"),
        ("laser", "map", S // 2, ExtrapolationError,
         "Lookup would require extrapolation 0.500000000s into the past.  Requested time "
         "0.500000000 but the earliest data is at time 1.000000000, when looking up transform "
         "from frame [map] to frame [laser]"),
    ],
)  # fmt: skip
def test_refusals_have_tf2_words(
    buffer: TransformBuffer, target: str, source: str, stamp_ns: int, kind: type, text: str
) -> None:
    buffer.set_transform("sea", "island", S, Pose())
    with pytest.raises(kind, match=f"^{re.escape(text)}$"):
        buffer.lookup_transform(target, source, stamp_ns)
    assert not buffer.can_transform(target, source, stamp_ns)
    assert buffer.why_not(target, source, stamp_ns) == text


def test_loop_is_found() -> None:
    buffer = TransformBuffer()
    for parent, child in (("a", "b"), ("b", "c"), ("c", "a")):
        buffer.set_transform(parent, child, S, Pose())
    buffer.set_transform("d", "e", S, Pose())
    for stamp_ns in (0, S):
        with pytest.raises(UnknownFrameError, match="The tf tree is invalid because it contains a"):
            buffer.lookup_transform("a", "e", stamp_ns)


@pytest.mark.parametrize(
    ("frame", "child", "pose", "text"),
    [
        ("a", "a", Pose(), 'TF_SELF_TRANSFORM: Ignoring transform from authority "/n"'),
        ("a", "", Pose(), "TF_NO_CHILD_FRAME_ID"),
        ("", "a", Pose(), 'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "a"'),
        ("a", "b", Pose((float("nan"), 0.0, 0.0)), "TF_NAN_INPUT"),
        ("a", "b", Pose((0, 0, 0), (0, 0, 0, 0)), "TF_DENORMALIZED_QUATERNION"),
    ],
)
def test_bad_transforms_are_refused_and_told_once(
    frame: str, child: str, pose: Pose, text: str
) -> None:
    warnings: list[str] = []
    buffer = TransformBuffer(on_warning=warnings.append)
    for _ in range(2):
        assert not buffer.set_transform(frame, child, S, pose, authority="/n")
    assert len(warnings) == 1
    assert text in warnings[0]


def test_old_data_is_told_repeated_data_is_not() -> None:
    warnings: list[str] = []
    buffer = TransformBuffer(on_warning=warnings.append)
    assert buffer.set_transform("a", "b", 20 * S, Pose())
    assert not buffer.set_transform("a", "b", 20 * S, Pose())
    assert not warnings
    assert not buffer.set_transform("a", "b", 5 * S, Pose())
    assert warnings[0].startswith("TF_OLD_DATA ignoring data from the past for frame b (parent a)")


def test_two_publishers_of_a_frame_are_told_once_a_successor_is_not() -> None:
    warnings: list[str] = []
    buffer = TransformBuffer(on_warning=warnings.append)
    for stamp_s, authority in enumerate(("/old", "/old", "/new", "/new"), 1):
        buffer.set_transform("odom", "base", stamp_s * S, Pose(), authority=authority)
    assert not warnings
    for stamp_s, authority in enumerate(("/old", "/new", "/old"), 5):
        buffer.set_transform("odom", "base", stamp_s * S, Pose(), authority=authority)
    assert len(warnings) == 1
    assert "frame 'base' is published by /new and by /old" in warnings[0]
    assert "graph.tf-two-authorities" in warnings[0]


def test_waiting_ends_when_the_transform_comes() -> None:
    buffer, found = TransformBuffer(), []
    waiter = threading.Thread(
        target=lambda: found.append(buffer.lookup_transform("a", "b", S, timeout_s=stretched(30)))
    )
    waiter.start()
    buffer.set_transform("a", "b", S, Pose((1.0, 0.0, 0.0)))
    waiter.join(stretched(30))
    assert found[0].pose.position_m == (1.0, 0.0, 0.0)
    with pytest.raises(UnknownFrameError):
        buffer.lookup_transform("a", "c", timeout_s=0.01)


def test_leading_slashes_of_publishers_are_removed() -> None:
    buffer = TransformBuffer()
    buffer.set_transform("/odom", "/base", S, Pose())
    assert buffer.frame_names() == ("base", "odom")
    assert buffer.can_transform("odom", "base")


def test_clear_keeps_what_never_moves(buffer: TransformBuffer) -> None:
    buffer.clear()
    assert [one.name for one in buffer.frames()] == ["laser"]
    assert buffer.can_transform("base", "laser")
    assert not buffer.can_transform("map", "odom")


def test_chain_names_the_frames_in_between(buffer: TransformBuffer) -> None:
    assert buffer.chain("map", "laser") == ["laser", "base", "odom", "map"]
    assert buffer.chain("wheel", "laser") == ["laser", "base", "wheel"]
    assert buffer.chain("laser", "map") == ["map", "odom", "base", "laser"]
