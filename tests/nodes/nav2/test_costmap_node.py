"""The costmap nodes that Nav2's servers make."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.nav2.costmap_node import CostmapNode


def test_a_costmap_logs_as_its_server_does(bench: Any, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = NodeArguments("planner_server", has_ros_args=True)
    costmap = CostmapNode("global_costmap", arguments, bench.node.graph, Diagnostics())
    costmap.node.log("info", "Received a map")
    costmap.close()
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.startswith("[INFO] [")
    assert told.err.endswith("] [global_costmap.global_costmap]: Received a map\n")
