"""The running world as the ``gz`` commands reach it: services of ``gazebo_ros``."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from gazelle.cli.gz.options import GzError
from gazelle.cli.ros_tool import join_graph
from gazelle.diagnostics import did_you_mean
from gazelle.graph import Graph, Node
from gazelle.graph.gazebo_names import SHOWN_SPACE, offered_name
from gazelle.interfaces import message_type, service_type

__all__ = ["WorldLink", "pose_line", "world_link"]

_WAIT_S = 2.0
_CALL_S = 60.0


class WorldLink:
    """A node of this command on the graph of a world.

    Attributes:
        graph, node: the graph and this command's node.
        ended: set when somebody shut the node down.
    """

    def __init__(self, graph: Graph) -> None:
        """Join the graph."""
        self.graph = graph
        self.node: Node = graph.create_node("gz", anonymous=True, rosout=False)
        self.ended = threading.Event()
        self.node.on_shutdown(lambda _reason: self.ended.set())

    def call(self, name: str, kind: str, **fields: Any) -> Any:
        """Call ``/gazebo/NAME``, or what it is hidden as.

        Raises:
            GzError: there is no world, or it refuses.
        """
        service = service_type(kind)
        offered = offered_name(self.graph, f"{SHOWN_SPACE}/{name}", _WAIT_S)
        client = self.node.create_client(offered, service)
        if not client.available:
            raise GzError(
                f"no world is running on this graph (/gazebo/{name} is not offered); "
                "start one with gzserver or roslaunch"
            )
        response = client.call(service.Request(**fields), _CALL_S)
        if not getattr(response, "success", True):
            raise GzError(response.status_message)
        return response

    def show_each(
        self, topic: str, kind: type[Any], show: Callable[[Any], None], seconds: float | None
    ) -> None:
        """Print the messages of a topic until the command ends.

        Args:
            topic: its name.
            kind: the class of its messages.
            show: prints one; it may set `ended`.
            seconds: how long at most, None for as long as there is a node.

        Raises:
            OSError: whoever read the output has gone.
        """
        failed: list[OSError] = []

        def take(message: Any) -> None:
            if self.ended.is_set():
                return
            try:
                show(message)
            except OSError as error:
                failed.append(error)
                self.ended.set()

        self.node.create_subscription(topic, kind, take)
        self.ended.wait(seconds)
        if failed:
            raise failed[0]

    def model_names(self) -> list[str]:
        """Return the models of the world.

        Raises:
            GzError: there is no world.
        """
        return list(self.call("get_world_properties", "gazebo_msgs/GetWorldProperties").model_names)

    def check_model(self, name: str) -> None:
        """See that a model is there.

        Raises:
            GzError: it is not, with the names there are.
        """
        names = self.model_names()
        if name not in names:
            hint = did_you_mean(name, names) or f"models: {', '.join(names) or 'none'}"
            raise GzError(f"Unable to get info on model[{name}]: it is not in the world; {hint}")

    def model_pose(self, name: str) -> Any:
        """Return a model's pose as a message.

        Raises:
            GzError: there is no such model.
        """
        self.check_model(name)
        found = self.call("get_model_state", "gazebo_msgs/GetModelState", model_name=name)
        return found.pose

    def control(self, *, pause: bool, steps: int = 0) -> None:
        """Pause or unpause the world and take steps.

        Raises:
            GzError: there is no world.
        """
        control = message_type("ros_gz_interfaces/WorldControl")(pause=pause, multi_step=steps)
        self.call("control_world", "ros_gz_interfaces/ControlWorld", world_control=control)


@contextmanager
def world_link() -> Iterator[WorldLink]:
    """Join the graph for the time of a ``with`` block.

    Raises:
        ToolError: there is no graph.
    """
    with join_graph() as graph:
        yield WorldLink(graph)


def pose_line(xyz_rpy: tuple[float, ...]) -> str:
    """Return a pose as ``gz model -p`` prints it: micrometres, no zeros behind."""
    return " ".join(f"{round(value, 6):g}" for value in xyz_rpy)
