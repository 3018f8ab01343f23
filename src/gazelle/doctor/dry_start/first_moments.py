"""What a simulation says in its first quarter of a second: transforms and joint states."""

from __future__ import annotations

import math
from typing import Any

from gazelle.doctor.dry_start.node import DryNode
from gazelle.errors import SimulationDivergedError
from gazelle.simulator.world_server import WorldServer

__all__ = ["FirstMoments"]

_SECONDS = 0.25
_MAX_STEPS = 500


class FirstMoments:
    """Listens to tf and joint states.

    Plug-ins and controllers publish with a rate of their own, most at 10 Hz or more, and what
    they will publish stands nowhere but in what they do.

    Attributes:
        transforms: parent and child frame → whether it is static.
        joint_states: names of joints by topic.
        diverged: why the time ended early, empty when it did not.
    """

    def __init__(self) -> None:
        self.transforms: dict[tuple[str, str], bool] = {}
        self.joint_states: dict[str, set[str]] = {}
        self.diverged = ""

    def listen(self, server: WorldServer, node: DryNode) -> None:
        """Let a little time pass; the world is of no use for anything else afterwards."""
        own = dict(node.heard)
        for topic in ("/tf", "/tf_static"):
            node.create_subscription(topic, None, self._take_transforms(topic == "/tf_static"))
        for topic, kind in tuple(node.offered.items()):
            if kind.endswith("/JointState"):
                self.joint_states[topic] = set()
                node.create_subscription(topic, None, self._take_joints(topic))
        node.heard = own
        step_s = server.engine.step_ns * 1e-9
        try:
            server.step(min(_MAX_STEPS, math.ceil(_SECONDS / step_s)))
        except SimulationDivergedError as error:
            self.diverged = str(error)

    def _take_transforms(self, is_static: bool) -> Any:
        def take(message: Any) -> None:
            for item in message.transforms:
                edge = (item.header.frame_id.lstrip("/"), item.child_frame_id.lstrip("/"))
                self.transforms.setdefault(edge, is_static)

        return take

    def _take_joints(self, topic: str) -> Any:
        return lambda message: self.joint_states[topic].update(message.name)
