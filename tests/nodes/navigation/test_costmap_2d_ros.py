"""A costmap's own thread."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from tests.patience import eventually, stretched

from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.graph import Graph
from gazelle.graph.tf import StampedPose, TransformBroadcaster
from gazelle.interfaces.stamps import set_header
from gazelle.nodes.navigation.costmap_2d_ros import Costmap2DRos
from gazelle.nodes.navigation.costmap_from_parameters import assemble
from gazelle.nodes.navigation.costmap_publisher import CostmapPublisher
from gazelle.nodes.navigation.robot_pose import Frames


class Slow(Costmap2DRos):
    """Its update takes as long as the test wants."""

    def __init__(self, graph: Graph, said: list[str]) -> None:
        costmap = SimpleNamespace(options=SimpleNamespace(update_frequency=5.0), layers=())
        assembly = SimpleNamespace(
            settings=SimpleNamespace(name="local_costmap"),
            costmap=costmap,
            sources={},
        )
        publisher = SimpleNamespace(close=lambda: said.append("closed"))
        made: tuple[Any, ...] = (graph.create_node("mapper"), None, assembly, publisher)
        super().__init__(*cast(Any, made))
        self.said = said
        self.begun, self.goes_on = threading.Event(), threading.Event()

    def update(self) -> bool:
        self.begun.set()
        self.goes_on.wait(stretched())
        self.said.append("updated")
        return True


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """A graph of its own."""
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        yield graph


def test_update_at_work_is_published_before_its_topics_close(graph: Graph) -> None:
    said: list[str] = []
    costmap = Slow(graph, said)
    costmap.start()
    assert costmap.begun.wait(stretched())
    closing = threading.Thread(target=costmap.close)
    closing.start()
    eventually(costmap._stop.is_set)
    costmap.goes_on.set()
    closing.join(stretched())
    assert said == ["updated", "closed"]


def test_scan_ahead_of_tf_waits_for_it_and_nothing_is_said(graph: Graph) -> None:
    tree = {
        "global_frame": "odom", "robot_base_frame": "base", "static_map": False,
        "rolling_window": True, "width": 4, "height": 4, "resolution": 0.05,
        "transform_tolerance": 0.0, "observation_sources": "scan",
        "scan": {"data_type": "LaserScan", "topic": "scan", "marking": True},
    }  # fmt: skip
    node, outside = graph.create_node("mapper"), graph.create_node("robot")
    said: list[str] = []
    node.console = lambda record, **_: said.append(record.text)
    made = assemble(tree, "/mapper/local_costmap", Diagnostics())
    costmap = Costmap2DRos(
        node, Frames(node), made, CostmapPublisher(node, "~/local_costmap", "odom")
    )
    tf = TransformBroadcaster(outside)
    scans = outside.create_publisher("/scan", "sensor_msgs/msg/LaserScan")
    scan: Any = scans.message_class(
        ranges=[1.0], angle_increment=math.tau, range_min=0.1, range_max=3.0
    )
    now_ns = node.clock.now_ns()
    # Ahead of this node's clock, too.
    ahead_ns = now_ns + 1_000_000_000
    set_header(scan, ahead_ns, "base")

    def reach(stamp_ns: int) -> None:
        tf.send(StampedPose("odom", "base", stamp_ns, Pose((0.0, 0.0, 0.0))))

    def lethal() -> int:
        assert costmap.update()
        return int(np.count_nonzero(costmap.snapshot().costs == 254))

    def known(stamp_ns: int) -> bool:
        return not isinstance(costmap.frames.between("odom", "base", stamp_ns), str)

    for ago_ns in (2_000_000_000, 100_000_000):
        reach(now_ns - ago_ns)
    eventually(lambda: known(now_ns - 100_000_000))
    scans.publish(scan)
    eventually(lambda: costmap._waiting["obstacle_layer", "scan"].oldest)
    assert lethal() == 0
    reach(ahead_ns + 100_000_000)
    eventually(lambda: known(ahead_ns))
    assert lethal() == 1
    assert not [text for text in said if "cannot be used" in text]
    costmap.close()
