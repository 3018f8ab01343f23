"""``dynamic_reconfigure.client.Client``."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

from gazelle.compat.dynamic_reconfigure import (
    DynamicReconfigureCallbackException,
    DynamicReconfigureParameterException,
)
from gazelle.compat.dynamic_reconfigure.encoding import Config, extract_params
from gazelle.compat.rospy.exceptions import ROSException
from gazelle.compat.rospy.state import STATE
from gazelle.errors import GraphError
from gazelle.graph.dynamic_reconfigure import DynamicGroup, ReconfigureClient, ReconfigureError
from gazelle.graph.dynamic_reconfigure.messages import config_tree, description_tree, group_states

__all__ = ["Client"]

_SLICE_S = 0.1
_FIRST_S = 1.0

Callback = Callable[[Any], Any]


class Client:
    """Sees and changes the parameters of one server.

    Attributes:
        name: of the server.
        config: the last values, None until they came.
        param_description, group_description: what the server offers, None until it came.
    """

    def __init__(
        self,
        name: str,
        timeout: float | None = None,
        config_callback: Callback | None = None,
        description_callback: Callback | None = None,
    ) -> None:
        """Wait for the server and listen to it.

        Raises:
            ROSException: the server is not there in time.
            ROSInterruptException: the node was shut down meanwhile.
        """
        self.name = name
        self.config: Config | None = None
        self.param_description: list[dict[str, Any]] | None = None
        self.group_description: Config | None = None
        self._config_callback = config_callback
        self._description_callback = description_callback
        node = STATE.require(f"dynamic_reconfigure.client.Client('{name}')")
        self._impl = ReconfigureClient(
            node,
            STATE.resolved(name),
            on_description=self._take_description,
            on_values=self._take_config,
        )
        service = f"{self._impl.name}/set_parameters"
        if self._until(lambda: self._impl.wait_for_server(0.0), timeout or _FIRST_S):
            return
        STATE.check_running()
        if timeout:
            raise ROSException(f"timeout exceeded while waiting for service {service}")
        sys.stderr.write(f"Waiting for service {service}...\n")
        self._until(lambda: self._impl.wait_for_server(0.0), None)
        STATE.check_running()

    def get_configuration(self, timeout: float | None = None) -> Config | None:
        """Return the values, None if they did not come in time."""
        if not timeout and self.get_configuration(_FIRST_S) is None:
            sys.stderr.write("Waiting for configuration...\n")
        self._until(lambda: self.config is not None, timeout)
        return self.config

    def get_parameter_descriptions(
        self, timeout: float | None = None
    ) -> list[dict[str, Any]] | None:
        """Return the parameters, None if they did not come in time."""
        self._until(lambda: self.param_description is not None, timeout)
        return self.param_description

    def get_group_descriptions(self, timeout: float | None = None) -> Config | None:
        """Return the groups, None if they did not come in time."""
        self._until(lambda: self.group_description is not None, timeout)
        return self.group_description

    def update_configuration(self, changes: dict[str, Any]) -> Config:
        """Change values; ``groups`` holds states by name. Returns all values.

        Raises:
            DynamicReconfigureParameterException: a name is unknown or a value does not fit.
            DynamicReconfigureCallbackException: the server cannot be called.
        """
        self.get_parameter_descriptions()
        group = self._impl.description
        if group is None:
            raise DynamicReconfigureCallbackException("service call failed")
        states = group_states(group, changes.get("groups"))
        values = {key: value for key, value in changes.items() if key != "groups"}
        try:
            self._impl.set(values, states=states or None)
        except ReconfigureError as error:
            raise DynamicReconfigureParameterException(str(error)) from error
        except GraphError as error:
            raise DynamicReconfigureCallbackException("service call failed") from error
        return _tree(self._impl.config, group)

    def update_groups(self, changes: dict[str, bool]) -> Config | None:
        """Return the groups' description with other states."""
        found = self.get_group_descriptions()
        for child in () if found is None else _every_child(found):
            child["state"] = changes.get(child["name"], child["state"])
        return found

    def close(self) -> None:
        """Stop listening."""
        self._impl.close()

    def get_config_callback(self) -> Callback | None:
        """Return who hears new values."""
        return self._config_callback

    def set_config_callback(self, value: Callback | None) -> None:
        """Have somebody hear new values, and the present ones at once."""
        self._config_callback = value
        if value is not None:
            value(self.config)

    config_callback = property(get_config_callback, set_config_callback)

    def get_description_callback(self) -> Callback | None:
        """Return who hears descriptions."""
        return self._description_callback

    def set_description_callback(self, value: Callback | None) -> None:
        """Have somebody hear descriptions, and the present one at once."""
        self._description_callback = value
        if value is not None:
            value(self.param_description)

    description_callback = property(get_description_callback, set_description_callback)

    def _take_description(self, group: DynamicGroup) -> None:
        tree = description_tree(group, Config)
        assert isinstance(tree, Config)
        self.group_description = tree
        self.param_description = extract_params(tree)
        if self._description_callback is not None:
            self._description_callback(self.param_description)

    def _take_config(self, message: Any, group: DynamicGroup) -> None:
        self.config = _tree(message, group)
        if self._config_callback is not None:
            self._config_callback(self.config)

    def _until(self, condition: Callable[[], bool], timeout_s: float | None) -> bool:
        """Wait until a condition holds, the time is over or the node is shut down."""
        end = None if not timeout_s else time.monotonic() + timeout_s
        while not condition():
            if STATE.stopping.is_set() or (end is not None and time.monotonic() >= end):
                return False
            self._impl.wait_for_change(_SLICE_S)
        return True


def _tree(message: Any, group: DynamicGroup) -> Config:
    tree = config_tree(message, group, Config)
    assert isinstance(tree, Config)
    return tree


def _every_child(group: Config) -> list[Config]:
    found: list[Config] = []
    for child in group["groups"].values():
        found += [child, *_every_child(child)]
    return found
