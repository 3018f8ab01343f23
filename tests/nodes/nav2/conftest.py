"""A world for behaviour trees that the test moves by hand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import message_type
from gazelle.nodes.nav2.behavior_trees.ros_interface import Pose2
from gazelle.nodes.nav2.behavior_trees.tree_node import Blackboard, TreeNode
from gazelle.nodes.nav2.behavior_trees.xml_parsing import build_tree, parse_trees


class FakeCall:
    """A goal or a request that ends when the test says so."""

    def __init__(self, name: str, content: Any) -> None:
        self.name, self.content = name, content
        self.is_done = self.succeeded = self.cancelled = False
        self.result: Any = None
        self.feedback: Any = None
        self.why = ""

    def end(self, succeeded: bool, result: Any = None) -> None:
        self.is_done, self.succeeded, self.result = True, succeeded, result

    def cancel(self) -> None:
        self.cancelled = True


class FakeWorld:
    """Time, robot and calls, in the test's hands."""

    def __init__(self) -> None:
        self.now = 0
        self.at: Pose2 | None = Pose2(0.0, 0.0, 0.0)
        self.speed = 0.0
        self.calls: list[FakeCall] = []
        self.said: list[str] = []
        self.topics: dict[str, Any] = {}
        self.frames: set[tuple[str, str]] = set()

    def now_ns(self) -> int:
        return self.now

    def pose(self, global_frame: str = "", base_frame: str = "") -> Pose2 | None:
        return self.at

    def can_transform(self, parent: str, child: str) -> bool:
        return (parent, child) in self.frames

    def in_frame(self, pose: Any, frame: str = "") -> Any:
        return pose

    def speed_m_s(self) -> float:
        return self.speed

    def action(self, name: str, kind: str, goal: Any) -> FakeCall:
        return self._call(name, goal)

    def cancel_all(self, name: str, kind: str) -> None:
        self._call(f"cancel {name}", None)

    def service(self, name: str, kind: str, request: Any) -> FakeCall:
        return self._call(name, request)

    def latest(self, topic: str, kind: str, *, latched: bool = False) -> Any:
        return self.topics.get(topic)

    def message(self, kind: str) -> Any:
        from gazelle.interfaces import service_type

        return service_type(kind).Request() if "/srv/" in kind else message_type(kind)()

    def log(self, level: str, text: str) -> None:
        self.said.append(text)

    def _call(self, name: str, content: Any) -> FakeCall:
        self.calls.append(FakeCall(name, content))
        return self.calls[-1]


@pytest.fixture
def world() -> FakeWorld:
    return FakeWorld()


@pytest.fixture
def plant(world: FakeWorld) -> Callable[..., TreeNode]:
    """Builds the tree of the nodes' XML, with a blackboard of these values."""

    def made(nodes: str, version: int = 4, **values: Any) -> TreeNode:
        diagnostics = Diagnostics()
        head = f'<root BTCPP_format="{version}"' if version == 4 else "<root"
        xml = (
            nodes
            if "<root" in nodes
            else (
                f'{head} main_tree_to_execute="T"><BehaviorTree ID="T">{nodes}</BehaviorTree>'
                "</root>"
            )
        )
        file = parse_trees(xml, "tree.xml", diagnostics)
        diagnostics.raise_if_errors()
        assert file is not None
        blackboard = Blackboard()
        for key, value in values.items():
            blackboard.set(key, value)
        return build_tree(file, blackboard, world)

    return made
