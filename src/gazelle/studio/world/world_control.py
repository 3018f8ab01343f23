"""The running world: calls to it; its time: playing, pausing, stepping, resetting."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from gazelle.diagnostics import nearest_names
from gazelle.graph import Node
from gazelle.graph.gazebo_names import SHOWN_SPACE, offered_name
from gazelle.interfaces import message_type
from gazelle.studio.errors import StudioError
from gazelle.studio.graph_view.services import request_response
from gazelle.studio.request_params import Params

__all__ = ["WorldLink", "pause", "play", "pose_message", "pose_of", "reset", "set_factor", "step"]

_DO = "/_gazelle/do"
_RESETS = {"world": "reset_world", "poses": "reset_world", "time": "reset_simulation"}


@dataclass(frozen=True)
class WorldLink:
    """The running world, if there is one.

    Attributes:
        node: who calls it.
    """

    node: Node

    def call(self, name: str, type_name: str, **fields: Any) -> Any:
        """Call ``/gazebo/NAME``, or what it is hidden as, and return the response.

        Raises:
            StudioError: there is no world, or it refuses.
        """
        self._check()
        service = offered_name(self.node.graph, f"{SHOWN_SPACE}/{name}")
        response = request_response(self.node, service, type_name, **fields)
        if not getattr(response, "success", True):
            raise StudioError(response.status_message)
        return response

    def ask(self, **request: Any) -> Any:
        """Send a request to ``/_gazelle/do`` and return its value.

        Raises:
            StudioError: there is no world, or it refuses.
        """
        self._check()
        text = json.dumps(request)
        response = request_response(self.node, _DO, "gazelle_msgs/Do", request=text)
        answer = json.loads(response.response)
        if "error" in answer:
            raise StudioError(answer["error"]["message"])
        return answer["value"]

    def _check(self) -> None:
        if not self.node.graph.has_service(_DO):
            raise StudioError(
                "no world is running on this graph",
                hint="start one with roslaunch, gzserver or gazebo",
            )


def pose_of(params: Params, name: str = "pose") -> list[float]:
    """Return a pose parameter: x y z qx qy qz qw; three numbers are a place alone."""
    values = params.numbers(name, [0.0, 0.0, 0.0])
    if len(values) == 3:
        values = [*values, 0.0, 0.0, 0.0, 1.0]
    if len(values) != 7 or not any(values[3:]):
        raise StudioError(f"{params.where}: '{name}' is x, y, z, qx, qy, qz, qw, not {values}")
    return values


def pose_message(values: list[float]) -> Any:
    """Return a ``geometry_msgs/Pose`` of seven numbers."""
    message = message_type("geometry_msgs/Pose")()
    position, orientation = message.position, message.orientation
    position.x, position.y, position.z = values[:3]
    orientation.x, orientation.y, orientation.z, orientation.w = values[3:]
    return message


def pause(world: WorldLink, _params: Params) -> Any:
    """``world.pause``."""
    world.call("pause_physics", "std_srvs/Empty")
    return {}


def play(world: WorldLink, _params: Params) -> Any:
    """``world.play``."""
    world.call("unpause_physics", "std_srvs/Empty")
    return {}


def step(world: WorldLink, params: Params) -> Any:
    """``world.step``: pauses, and takes so many steps."""
    count = params.whole("count", 1, least=1, most=1_000_000)
    control = message_type("ros_gz_interfaces/WorldControl")(pause=True, multi_step=count)
    kind = "ros_gz_interfaces/ControlWorld"
    world.call("control_world", kind, world_control=control)
    return {}


def reset(world: WorldLink, params: Params) -> Any:
    """``world.reset``: poses alone, or time as well."""
    what = params.text("what", "world")
    if what not in _RESETS:
        raise StudioError(f"world.reset: there is no '{what}'", known=nearest_names(what, _RESETS))
    world.call(_RESETS[what], "std_srvs/Empty")
    return {}


def set_factor(world: WorldLink, params: Params) -> Any:
    """``world.factor``: the wanted real-time factor, 0 for as fast as possible."""
    return world.ask(op="factor", wanted_rtf=params.number("wanted_rtf", least=0.0))
