"""Frames over time in C++ are those of Python: the same transforms, failures and words."""

from __future__ import annotations

import math
from collections.abc import Iterator
from random import Random

import pytest
from tests.cpp.geometry.geometry_probe import CppTree, GeometryProbe

from gazelle.geometry import Pose
from gazelle.graph.tf import (
    ConnectivityError,
    ExtrapolationError,
    InvalidFrameError,
    TransformBuffer,
    TransformError,
    UnknownFrameError,
    frames_as_string,
    frames_as_yaml,
)

_KINDS = {
    UnknownFrameError: "lookup",
    ConnectivityError: "connectivity",
    ExtrapolationError: "extrapolation",
    InvalidFrameError: "invalid",
}
_S = 1_000_000_000
_FRAMES = ("map", "odom", "base_link", "laser", "arm", "wrist", "camera")


@pytest.fixture
def tree(geometry: GeometryProbe) -> Iterator[CppTree]:
    """An empty tree."""
    one = CppTree(geometry)
    yield one
    one.close()


@pytest.mark.parametrize("seed", range(25))
def test_any_tree_gives_the_same_answers(tree: CppTree, seed: int) -> None:
    random = Random(seed)
    cpp, python = tree, TransformBuffer()
    parents = {child: random.choice(_FRAMES[:at]) for at, child in enumerate(_FRAMES) if at}
    static = {child for child in parents if random.random() < 0.3}
    for _ in range(random.randrange(40)):
        child = random.choice(_FRAMES[1:])
        stamp, pose = random.randrange(1, 25 * _S), _pose(random)
        taken = cpp.set(parents[child], child, stamp, pose, is_static=child in static)
        assert taken == python.set_transform(
            parents[child], child, stamp, pose, authority="me", is_static=child in static
        )
    for _ in range(20):
        target, source, fixed = (random.choice((*_FRAMES, "nowhere", "/map")) for _ in range(3))
        stamp, later = (random.choice((0, random.randrange(25 * _S))) for _ in range(2))
        _same(cpp.look_up(target, source, stamp), python, target, source, stamp)
        between = cpp.look_up_between(target, stamp, source, later, fixed)
        _same_between(between, python, (target, stamp, source, later, fixed))
    assert sorted(cpp.text(0).splitlines()) == sorted(frames_as_string(python).splitlines())
    assert sorted(cpp.text(1).splitlines()) == sorted(frames_as_yaml(python).splitlines())


def test_a_misspelt_frame_is_told_with_its_likely_name(tree: CppTree) -> None:
    tree.set("odom", "base_link", _S, Pose())
    kind, text = tree.look_up("odom", "base_lnik")
    assert kind == "lookup"
    assert text == (
        '"base_lnik" passed to lookupTransform argument source_frame does not exist. '
        "Did you mean base_link?"
    )


def test_two_trees_are_told_with_whose_job_it_is_to_join_them(tree: CppTree) -> None:
    tree.set("map", "goal", _S, Pose())
    tree.set("odom", "base_link", _S, Pose())
    kind, text = tree.look_up("goal", "base_link")
    assert kind == "connectivity"
    assert text.startswith("Could not find a connection between 'goal' and 'base_link' because")
    assert "from the tree of 'map' to 'odom'; that is the job of localisation or SLAM" in text


def test_a_loop_is_told(tree: CppTree) -> None:
    tree.set("a", "b", _S, Pose())
    tree.set("b", "a", _S, Pose())
    tree.set("x", "y", _S, Pose())
    kind, text = tree.look_up("a", "y")
    assert kind == "lookup"
    assert text.startswith("The tf tree is invalid because it contains a loop.\nFrame b exists")


def test_wrong_transforms_are_left_out_and_told(tree: CppTree) -> None:
    nan = Pose((math.nan, 0.0, 0.0))
    assert not tree.set("a", "a", _S, Pose())
    assert not tree.set("a", "", _S, Pose())
    assert not tree.set("", "b", _S, Pose())
    assert not tree.set("a", "b", _S, nan)
    told = [line.partition(":")[0] for line in tree.text(3).splitlines()]
    assert told == [
        "TF_SELF_TRANSFORM",
        "TF_NO_CHILD_FRAME_ID",
        "TF_NO_FRAME_ID",
        "TF_NAN_INPUT",
    ]


def test_frames_that_move_are_forgotten_when_time_jumps(tree: CppTree) -> None:
    tree.set("a", "b", _S, Pose())
    tree.set("b", "c", _S, Pose(), is_static=True)
    tree.clear()
    assert tree.look_up("b", "c")[0] == ""
    assert tree.look_up("a", "b")[0] == "connectivity"


def test_a_chain_goes_up_and_down(tree: CppTree) -> None:
    tree.set("map", "a", _S, Pose())
    tree.set("a", "b", _S, Pose())
    tree.set("map", "c", _S, Pose())
    assert tree.chain("c", "b") == ["b", "a", "map", "c"]


def test_who_waits_is_told_once_when_it_comes_or_is_out_of_reach(tree: CppTree) -> None:
    tree.set("a", "b", 5 * _S, Pose())
    waits, late = tree.request("a", "b", 6 * _S), tree.request("a", "c", 2 * _S)
    assert tree.request("a", "b", 5 * _S) == 0
    assert waits
    assert late
    tree.set("a", "b", 7 * _S, Pose())
    assert tree.text(4) == f"{waits}+"
    tree.set("a", "c", 20 * _S, Pose())
    assert tree.text(4) == f"{waits}+{late}-"
    assert tree.request("a", "c", 2 * _S) == 2**64 - 1


def test_what_cannot_be_had_is_told_for_both_frames(tree: CppTree) -> None:
    assert tree.why_not("a", "b") == (
        "canTransform: target_frame a does not exist. canTransform: source_frame b does not exist."
    )


def _pose(random: Random) -> Pose:
    values = [random.gauss(0.0, 1.0) for _ in range(4)]
    norm = math.sqrt(sum(value * value for value in values))
    x, y, z, w = (value / norm for value in values)
    position = (random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9))
    return Pose(position, (x, y, z, w))


def _same(
    found: tuple[str, object], python: TransformBuffer, target: str, source: str, stamp: int
) -> None:
    try:
        wanted = python.lookup_transform(target, source, stamp)
    except TransformError as error:
        assert found == (_KINDS[type(error)], str(error))
        return
    _close(found, wanted.stamp_ns, wanted.pose)


def _same_between(
    found: tuple[str, object], python: TransformBuffer, asked: tuple[str, int, str, int, str]
) -> None:
    target, target_ns, source, source_ns, fixed = asked
    try:
        wanted = python.lookup_transform_full(target, target_ns, source, source_ns, fixed)
    except TransformError:
        # Of several things wrong, C++ tells that of the target first, as tf2 does.
        assert found[0]
        return
    _close(found, wanted.stamp_ns, wanted.pose)


def _close(found: tuple[str, object], stamp_ns: int, pose: Pose) -> None:
    kind, value = found
    assert not kind, value
    assert isinstance(value, tuple)
    assert value[0] == stamp_ns
    assert value[1][:3] == pytest.approx(pose.position_m, abs=1e-9)
    sign = math.copysign(1.0, sum(p * q for p, q in zip(value[1][3:], pose.quat_xyzw, strict=True)))
    assert [sign * one for one in value[1][3:]] == pytest.approx(pose.quat_xyzw, abs=1e-9)
