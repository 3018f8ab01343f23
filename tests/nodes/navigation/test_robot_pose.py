"""What nodes that move a robot say of tf."""

from __future__ import annotations

from typing import Any

from gazelle.nodes.navigation.robot_pose import Frames


def test_nothing_is_said_of_a_node_that_is_closed(bench: Any, capfd: Any) -> None:
    node = bench.graph.create_node("amcl")
    frames = Frames(node)
    frames.say("warn", "the scan's place is not known")
    node.shutdown()
    frames.say("warn", "nor is that of the next one")

    said = capfd.readouterr().err
    assert "the scan's place is not known" in said
    assert "nor is" not in said
