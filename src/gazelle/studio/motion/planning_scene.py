"""``motion.scene``: the planning scene that a move_group keeps, followed from when a page looks."""

from __future__ import annotations

import threading
from typing import Any, NotRequired, TypedDict

from gazelle.errors import GazelleError
from gazelle.studio.errors import StudioError
from gazelle.studio.graph_view.services import request_response
from gazelle.studio.json_text import message_value
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream
from gazelle.studio.subscriptions import Sample, Subscriptions

__all__ = ["PlanningScene", "open_scene"]

_GET = "moveit_msgs/srv/GetPlanningScene"
_REMOVE = 1
_MOVE = 3
_MAX_WAITING = 1000


class PlanningScene(TypedDict):
    """A planning scene; its objects are there at first and after every change of them.

    Attributes:
        objects: `moveit_msgs/CollisionObject` each.
        attached: `moveit_msgs/AttachedCollisionObject` each.
    """

    positions: dict[str, float]
    objects: NotRequired[list[Any]]
    attached: NotRequired[list[Any]]


def open_scene(subscriptions: Subscriptions, channel: Channel, params: Params) -> OpenStream:
    """Ask the ``service`` for the whole scene, then follow its changes on the ``topic``."""
    scene = _Scene(channel)
    leave = subscriptions.listen(params.text("topic"), scene.take)
    try:
        name = subscriptions.node.resolve_name(params.text("service"))
        scene.begin(request_response(subscriptions.node, name, _GET).scene)
    except GazelleError:
        leave()
        raise
    return OpenStream(leave)


class _Scene:
    """What is known of a scene; objects are sent again only when they changed."""

    def __init__(self, channel: Channel) -> None:
        self._channel = channel
        self._lock = threading.Lock()
        self._samples: list[Sample] = []
        self._positions: dict[str, float] = {}
        self._objects: dict[str, Any] = {}
        self._attached: dict[str, Any] = {}
        self._is_new = True

    def begin(self, scene: Any) -> None:
        """Take the scene that the service told; what came on the topic meanwhile is newer."""
        self._merge(scene)
        self._channel.offer(self._value)

    def take(self, sample: Sample) -> None:
        """Runs in the transport's thread."""
        with self._lock:
            self._samples.append(sample)
            del self._samples[:-_MAX_WAITING]
        self._channel.offer(self._value)

    def _value(self) -> PlanningScene:
        with self._lock:
            samples, self._samples = self._samples, []
        for sample in samples:
            message: Any = sample.message()
            if not hasattr(message, "robot_state"):
                raise StudioError(f"{message.TYPE_NAME} is no moveit_msgs/PlanningScene")
            self._merge(message)
        value: PlanningScene = {"positions": dict(self._positions)}
        if self._is_new:
            value["objects"] = [message_value(item, None) for item in self._objects.values()]
            value["attached"] = [message_value(item, None) for item in self._attached.values()]
            self._is_new = False
        return value

    def _merge(self, scene: Any) -> None:
        joints = scene.robot_state.joint_state
        self._positions.update(zip(joints.name, map(float, joints.position), strict=False))
        if not scene.is_diff:
            self._objects, self._attached, self._is_new = {}, {}, True
        for item in scene.world.collision_objects:
            self._is_new = True
            self._take_object(item)
        attached = scene.robot_state.attached_collision_objects
        if len(attached) and not scene.robot_state.is_diff:
            self._attached = {}
        for body in attached:
            self._is_new = True
            self._take_attached(body)

    def _take_object(self, item: Any) -> None:
        operation = _number(item.operation)
        known = self._objects.get(item.id)
        if operation == _REMOVE:
            if item.id:
                self._objects.pop(item.id, None)
            else:
                self._objects = {}
        elif operation == _MOVE and known is not None:
            known.header, known.pose = item.header, item.pose
        else:
            self._objects[item.id] = item
            self._attached.pop(item.id, None)

    def _take_attached(self, body: Any) -> None:
        if _number(body.object.operation) == _REMOVE:
            self._attached.pop(body.object.id, None)
        else:
            self._attached[body.object.id] = body
            self._objects.pop(body.object.id, None)


def _number(value: Any) -> int:
    """A ``byte`` of a message is one number or one byte."""
    return value[0] if isinstance(value, bytes | bytearray) else int(value)
