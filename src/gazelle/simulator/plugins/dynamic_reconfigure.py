"""dynamic_reconfigure's server side for plug-ins: requests are answered between two steps."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from gazelle.graph.dynamic_reconfigure import DynamicParameter, ReconfigureServer, Value
from gazelle.simulator.intra_process_node import LocalNode
from gazelle.simulator.plugins.context import Host, Resources

__all__ = ["DynamicParameter", "DynamicParameters"]

_ROS2 = 2


class DynamicParameters(ReconfigureServer):
    """The parameters of one node handle, withdrawn with the resources of their owner."""

    def __init__(
        self,
        resources: Resources,
        host: Host,
        namespace: str,
        parameters: Sequence[DynamicParameter],
        *,
        changed: Callable[[dict[str, Value]], None],
        reads_store: bool = True,
    ) -> None:
        """Offer topics and service, and set the parameters in the store.

        ROS 2 has no dynamic_reconfigure: there the values are kept for their owner and nobody
        sees them.

        Args:
            resources: close them.
            host: has the node, and runs requests in the thread that owns the world.
            namespace: such as ``/depth_camera``.
            parameters: in the order to show them.
            changed: called with all values after a change.
            reads_store: a value that is set in the store already is taken over.
        """
        super().__init__(
            LocalNode() if host.ros_version == _ROS2 else host.node,
            namespace,
            parameters,
            lambda values, level: changed(values),
            reads_store=reads_store,
            run=host.commands.call,
        )
        resources.on_close(self.close)
