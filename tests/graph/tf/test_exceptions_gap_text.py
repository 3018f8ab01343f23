"""Pain 13 while everything runs: a missing transform comes with whose job it is."""

from __future__ import annotations

import pytest

from gazelle.geometry import Pose
from gazelle.graph.tf import ConnectivityError, TransformBuffer

_HERE = Pose((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))


def _buffer(*edges: tuple[str, str]) -> TransformBuffer:
    buffer = TransformBuffer()
    for parent, child in edges:
        buffer.set_transform(parent, child, 1, _HERE, authority="/somebody")
    return buffer


@pytest.mark.parametrize(
    ("edges", "words"),
    [
        (
            [("map", "room"), ("odom", "base_link")],
            "from the tree of 'map' to 'odom'; that is the job of localisation or SLAM (amcl",
        ),
        (
            [("odom", "base_footprint"), ("base_link", "laser")],
            "from the tree of 'odom' to 'base_link'; that is the job of the drive (plug-in: "
            "<publishOdomTF>",
        ),
        (
            [("base_link", "arm"), ("gripper", "finger")],
            "from the tree of 'base_link' to 'gripper'; that is the job of robot_state_publisher",
        ),
        (
            [("robot1/odom", "robot1/base_link"), ("map", "room")],
            "from the tree of 'map' to 'robot1/odom'; that is the job of localisation",
        ),
    ],
)
def test_two_trees_are_told_with_who_joins_them(edges: list[tuple[str, str]], words: str) -> None:
    buffer = _buffer(*edges)
    for target, source in ((edges[0][1], edges[1][1]), (edges[1][1], edges[0][1])):
        with pytest.raises(ConnectivityError, match="two or more unconnected trees") as caught:
            buffer.lookup_transform(target, source)
        assert words in str(caught.value)


def test_one_tree_has_no_gap() -> None:
    buffer = _buffer(("map", "odom"), ("odom", "base_link"))
    assert buffer.why_not("map", "base_link") == ""
