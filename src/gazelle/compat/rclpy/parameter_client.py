"""Parameters of other nodes (rclpy.parameter_client)."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.compat.rclpy.callback_groups import CallbackGroup
from gazelle.compat.rclpy.parameter import Parameter, parameter_dict_from_yaml_file
from gazelle.compat.rclpy.qos import QoSProfile, qos_profile_services_default
from gazelle.compat.rclpy.task import Future
from gazelle.interfaces import service_type

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = ["AsyncParameterClient"]

_SERVICES = {
    "list_parameters": "ListParameters",
    "set_parameters": "SetParameters",
    "get_parameters": "GetParameters",
    "get_parameter_types": "GetParameterTypes",
    "describe_parameters": "DescribeParameters",
    "set_parameters_atomically": "SetParametersAtomically",
}
_PAUSE_S = 0.02

Callback = Callable[[Future], Any]


class AsyncParameterClient:
    """Gets and sets parameters of another node; answers are futures.

    Args:
        node: asks; it has to spin for answers to come.
        remote_node_name: the other node.
    """

    def __init__(
        self,
        node: Node,
        remote_node_name: str,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> None:
        self.node = node
        self.remote_node_name = remote_node_name
        self._clients = {
            name: node.create_client(
                service_type(f"rcl_interfaces/srv/{kind}"),
                f"{remote_node_name}/{name}",
                qos_profile=qos_profile,
                callback_group=callback_group,
            )
            for name, kind in _SERVICES.items()
        }

    def services_are_ready(self) -> bool:
        """Tell whether the other node offers its parameters."""
        return all(client.service_is_ready() for client in self._clients.values())

    def wait_for_services(self, timeout_sec: float | None = None) -> bool:
        """Wait until the other node offers its parameters; False when time is up first."""
        deadline = None if timeout_sec is None else time.monotonic() + timeout_sec
        while not self.services_are_ready() and self.node.context.ok():
            if deadline is not None and time.monotonic() >= deadline:
                return False
            time.sleep(_PAUSE_S)
        return self.services_are_ready()

    def list_parameters(
        self,
        prefixes: list[str] | None = None,
        depth: int | None = None,
        callback: Callback | None = None,
    ) -> Future:
        """Ask for names, all or those below prefixes."""
        return self._ask("list_parameters", callback, prefixes=prefixes or [], depth=depth or 0)

    def get_parameters(self, names: list[str], callback: Callback | None = None) -> Future:
        """Ask for values."""
        return self._ask("get_parameters", callback, names=list(names))

    def set_parameters(self, parameters: Sequence[Any], callback: Callback | None = None) -> Future:
        """Set parameters one by one: `Parameter` or its message."""
        return self._ask("set_parameters", callback, parameters=_messages(parameters))

    def set_parameters_atomically(
        self, parameters: Sequence[Any], callback: Callback | None = None
    ) -> Future:
        """Set all parameters or none."""
        return self._ask("set_parameters_atomically", callback, parameters=_messages(parameters))

    def describe_parameters(self, names: list[str], callback: Callback | None = None) -> Future:
        """Ask for descriptors."""
        return self._ask("describe_parameters", callback, names=list(names))

    def get_parameter_types(self, names: list[str], callback: Callback | None = None) -> Future:
        """Ask for types."""
        return self._ask("get_parameter_types", callback, names=list(names))

    def delete_parameters(self, names: list[str], callback: Callback | None = None) -> Future:
        """Unset parameters, which only those of dynamic type allow."""
        return self.set_parameters([Parameter(name) for name in names], callback)

    def load_parameter_file(
        self,
        parameter_file: str | Path,
        use_wildcard: bool = False,
        callback: Callback | None = None,
    ) -> Future:
        """Set what a parameter file says about the node.

        Raises:
            RuntimeError: the file says nothing about it.
        """
        return self.set_parameters(self._of_file(parameter_file, use_wildcard), callback)

    def load_parameter_file_atomically(
        self,
        parameter_file: str | Path,
        use_wildcard: bool = False,
        callback: Callback | None = None,
    ) -> Future:
        """Set all that a parameter file says about the node, or nothing.

        Raises:
            RuntimeError: the file says nothing about it.
        """
        return self.set_parameters_atomically(self._of_file(parameter_file, use_wildcard), callback)

    def _of_file(self, file: str | Path, use_wildcard: bool) -> list[Any]:
        found = parameter_dict_from_yaml_file(
            str(file), use_wildcard, target_nodes=[self.remote_node_name]
        )
        return list(found.values())

    def _ask(self, name: str, callback: Callback | None, **fields: Any) -> Future:
        client = self._clients[name]
        future = client.call_async(client.srv_type.Request(**fields))
        if callback is not None:
            future.add_done_callback(callback)
        return future


def _messages(parameters: Sequence[Any]) -> list[Any]:
    return [one.to_parameter_msg() if isinstance(one, Parameter) else one for one in parameters]
