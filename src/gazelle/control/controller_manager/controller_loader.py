"""Makes a controller from its type's name and its parameters."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.control.controller_manager.controller_spec import ControllerRecord, OwnedPorts
from gazelle.control.controller_parameters import controller_parameters
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.registry import controller_class, known_types
from gazelle.control.errors import ControllerError
from gazelle.control.parameter_sources.ros1_parameter_server import ParameterSource
from gazelle.control.resource_manager import Robot
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.parameters.reader import ParameterReader
from gazelle.parameters.trees import flattened

if TYPE_CHECKING:
    from gazelle.workspace import Workspace

__all__ = ["CompiledFinder", "ControllerMaker"]

CompiledFinder = Callable[[str], "type[Controller] | None"]
"""Gives the class of C++ that a type's name means, None where there is none."""


class ControllerMaker:
    """Knows where types and parameters come from.

    Attributes:
        source: the parameters.
    """

    def __init__(
        self,
        robot: Robot,
        source: ParameterSource,
        make_ports: Callable[[str], OwnedPorts],
        diagnostics: Diagnostics,
        workspace: Workspace | None,
        namespace: str,
        find_compiled: CompiledFinder | None = None,
    ) -> None:
        self.source = source
        self._find_compiled = find_compiled or (lambda _type_name: None)
        self._namespace = namespace.strip("/")
        self._robot = robot
        self._make_ports = make_ports
        self._diagnostics = diagnostics
        self._workspace = workspace

    def type_of(self, name: str) -> str:
        """Return the type a controller is configured with.

        Raises:
            ControllerError: there is none; the message names what is configured.
        """
        found = self.source.controller_type(name)
        if found is not None:
            return found
        configured = self.source.controllers()
        hint = did_you_mean(name, configured) or (
            f"configured are: {', '.join(configured)}" if configured else "none is configured"
        )
        if self._robot.ros_version == 2:
            raise ControllerError(f"The 'type' param was not defined for '{name}'; {hint}")
        namespace = self.source.full_name(name, "").rstrip("/")
        raise ControllerError(
            f"Could not load controller '{name}' because the type was not specified. Did you load "
            f"the controller configuration on the parameter server (namespace: '{namespace}')? "
            f"{hint}"
        )

    def class_of(self, name: str, type_name: str) -> type[Controller]:
        """Return the class of a type: a built-in one, the user's, or an installed one.

        Raises:
            ControllerError: there is none.
        """
        found = controller_class(type_name) or self._class_elsewhere(type_name)
        if found is not None:
            return found
        hint = did_you_mean(type_name, known_types()) or "see docs/controllers.md for what there is"
        where = "" if self._workspace is None else self._searched(type_name)
        if self._robot.ros_version == 2:
            text = f"Loader for controller '{name}' (type '{type_name}') not found"
        else:
            text = f"Could not load class '{type_name}': Could not load controller '{name}' "
            text += f"because controller type '{type_name}' does not exist"
        raise ControllerError(f"{text}{where}; {hint}")

    def _class_elsewhere(self, type_name: str) -> type[Controller] | None:
        from gazelle.control.python_controllers import (
            find_installed_controller,
            find_python_controller,
        )

        workspace = self._workspace
        own = None if workspace is None else find_python_controller(type_name, workspace)
        # A class in Python may stand in for one of C++ that is there as well.
        return own or self._find_compiled(type_name) or find_installed_controller(type_name)

    def make(self, record: ControllerRecord) -> None:
        """Make a record's controller and open its ports.

        Raises:
            ControllerError: it cannot be made.
        """
        name = record.name
        found = self.class_of(name, record.type)
        ports = self._make_ports(name)
        try:
            record.controller = self._initialized(found, record, ports)
        except BaseException:
            ports.close()
            raise
        record.ports = ports

    def _initialized(
        self, found: type[Controller], record: ControllerRecord, ports: OwnedPorts
    ) -> Controller:
        parameters = self.parameters(record.name, found)
        context = ControllerContext(
            record.name,
            record.type,
            self._robot,
            parameters,
            ports,
            record.update_rate_hz,
            self._namespace,
        )
        try:
            controller = found(context)
        except ControllerError:
            raise
        except Exception as error:
            text = f"Exception thrown while initializing controller '{record.name}' of type "
            text += f"'{record.type}': {type(error).__name__}: {error}"
            raise ControllerError(text) from error
        if found.has_table:
            parameters.report_unknown()
        values = dict(flattened(parameters.tree))
        ports.offer_parameters(values, _setter(controller, parameters))
        return controller

    def parameters(self, name: str, found: type[Controller]) -> ParameterReader:
        """Return the parameters of a controller, to be read by its class's table."""
        source = self.source
        return controller_parameters(
            name,
            source.tree(name),
            found.TABLE.parameters,
            self._diagnostics,
            full_name=lambda key: source.full_name(name, key),
            span=lambda key: source.span(name, key),
        )

    def _searched(self, type_name: str) -> str:
        word = type_name.replace("::", "/").rpartition("/")[2]
        return (
            f", and no Python file of the workspace has a class '{word}' (nor does a plug-in "
            "description declare one for pr2_controller_interface; other controllers of C++ do not "
            "run here; one of your own is a Python class with init, starting, update, stopping)"
        )


def _setter(controller: Controller, parameters: ParameterReader) -> Callable[[dict[str, Any]], str]:
    """Return what takes new values of parameters: live rows only."""

    def take(values: dict[str, Any]) -> str:
        for key in values:
            row = parameters.table.row_for(key)
            if row is None or not row.live:
                return f"parameter '{key}' cannot be changed while the controller is configured"
        return controller.changed(values)

    return take
