"""``dynamic_reconfigure.server.Server``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from gazelle.compat.dynamic_reconfigure import DynamicReconfigureCallbackException
from gazelle.compat.dynamic_reconfigure.encoding import Config, group_from_tree
from gazelle.compat.rospy.log import logerr
from gazelle.compat.rospy.state import STATE
from gazelle.graph.dynamic_reconfigure import ReconfigureServer, Value
from gazelle.graph.dynamic_reconfigure.messages import config_message, config_tree

__all__ = ["Server"]

_ALL_LEVELS = 0xFFFFFFFF


class Server:
    """Parameters of this node that others can see and change.

    Attributes:
        config: present values.
    """

    def __init__(
        self, type: Any, callback: Callable[[Config, int], Config | None], namespace: str = ""
    ) -> None:
        """Offer the parameters of a configuration type.

        Args:
            type: a module made of a ``.cfg`` file, such as ``my_package.cfg.TutorialsConfig``.
            callback: takes values and the levels that changed, -1 at the start; returns the
                values that count.
            namespace: below the node's own, or global with a slash.

        Raises:
            DynamicReconfigureCallbackException: the callback returned nothing.
        """
        node = STATE.require("dynamic_reconfigure.server.Server")
        self.type = type
        self.callback = callback
        self.config = Config()
        self._group = group_from_tree(type.config_description)
        name = namespace if namespace.startswith(("/", "~")) else f"~{namespace}"
        self.ns = STATE.resolved(name.rstrip("/") or "/")
        self._impl = ReconfigureServer(
            node, self.ns, self._group, self._changed, calls_at_start=True
        )

    def update_configuration(self, changes: Mapping[str, Any]) -> Config:
        """Change values from inside the node; the callback hears of it."""
        self._impl.set({key: value for key, value in changes.items() if key != "groups"})
        return self.config

    def _changed(self, values: dict[str, Value], level: int) -> Mapping[str, Value]:
        message = config_message(self._group, values)
        config = config_tree(message, self._group, Config)
        assert isinstance(config, Config)
        answer = self.callback(config, -1 if level == _ALL_LEVELS else level)
        if answer is None:
            text = "Reconfigure callback should return a possibly updated configuration."
            logerr(text)
            raise DynamicReconfigureCallbackException(text)
        self.config = answer
        return answer
