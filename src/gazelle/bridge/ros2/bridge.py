"""The bridge: starts ROS's half, and starts it again when it ends."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

from gazelle.bridge.ros2.bridge_session import Session
from gazelle.bridge.ros2.interpreters import Interpreter
from gazelle.bridge.ros2.mirror_plan import BRIDGE_NAME
from gazelle.bridge.ros2.rclpy_process import About, start_rclpy
from gazelle.bridge.sync_thread import SyncThread
from gazelle.errors import GraphError
from gazelle.graph.errors import coded

if TYPE_CHECKING:
    from gazelle.graph import Graph

__all__ = ["Bridge"]

_POLL_S = 5.0
_FIRST_PAUSE_S = 0.5
_MAX_PAUSE_S = 10.0


class Bridge:
    """Joins a graph and ROS 2."""

    def __init__(
        self, graph: Graph, interpreters: Iterable[Interpreter], environ: Mapping[str, str]
    ) -> None:
        """Start ROS's half with the first Python that has ``rclpy``; bring over what there is.

        Args:
            graph: the graph.
            interpreters: to try.
            environ: for ROS's half.

        Raises:
            GraphError: another bridge runs on the graph, or no Python has ``rclpy``.
        """
        _refuse_second(graph)
        self._graph = graph
        self._environ = environ
        self._sync_thread = SyncThread("ros2 bridge", self._settle, self._notice)
        process = start_rclpy(interpreters, environ)
        self._interpreter = Interpreter(process.about.python, "as before")
        self._node = graph.create_node(BRIDGE_NAME.strip("/"), namespace="/")
        # A clock of a thousand ticks a second is of no use to a bridge.
        graph.clock.use(False)
        self._session = Session(graph, self._node, process, self._notice, self._sync_thread.touch)
        graph.discovery.listen(lambda entity, is_there: self._sync_thread.touch())
        self._sync_thread.start(_POLL_S)

    @property
    def about(self) -> About:
        """ROS's half."""
        return self._session.about

    @property
    def nodes(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Names of the graph's nodes in ROS, and of ROS's nodes on the graph."""
        return self._session.nodes

    def on_end(self, listener: Callable[[], None]) -> None:
        """Call back when somebody ends the bridge's node (``rosnode kill``)."""
        self._node.on_shutdown(lambda reason: listener())

    def close(self) -> None:
        """Take everything that is of the other side off both; calling it twice does nothing."""
        if not self._sync_thread.close():
            return
        self._session.close()
        self._node.shutdown()

    def _settle(self) -> None:
        if self._session.is_over:
            self._start_again()
        if not self._sync_thread.ended:
            self._session.settle()

    def _start_again(self) -> None:
        self._session.close()
        self._notice(
            f"the bridge's half in ROS 2 has ended ({self._session.exit_text}); it is started again"
        )
        ghosts = frozenset({*self._session.nodes[0], BRIDGE_NAME})
        pause_s = _FIRST_PAUSE_S
        while not self._sync_thread.wait(pause_s):
            try:
                process = start_rclpy([self._interpreter], self._environ)
            except GraphError as error:
                self._notice(str(error))
                pause_s = min(2 * pause_s, _MAX_PAUSE_S)
                continue
            self._session = Session(
                self._graph, self._node, process, self._notice, self._sync_thread.touch, ghosts
            )
            return

    def _notice(self, text: str) -> None:
        if not self._node.closed:
            self._node.log("warn", text)


def _refuse_second(graph: Graph) -> None:
    if BRIDGE_NAME in graph.node_names():
        text = "a bridge to ROS 2 already runs on this graph; a second one would double messages"
        fix = "end the other one (gazelle rosnode kill /ros2_bridge), or use it"
        raise GraphError(coded("bridge.second", text, fix=fix))
