"""dynamic_reconfigure's server side: two latched topics and ``set_parameters``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle.simulator.messages import message_class
from gazelle.simulator.plugins.context import Resources, join_names
from gazelle.simulator.ports import ParameterPort

__all__ = ["DynamicParameter", "DynamicParameters"]

Value = bool | int | float | str

_KINDS = {"bool": "bools", "int": "ints", "double": "doubles", "str": "strs"}
_MESSAGES = {"bool": "Bool", "int": "Int", "double": "Double", "str": "Str"}
_LIMITS: dict[str, Value] = {"bool": False, "int": 0, "double": 0.0, "str": ""}


@dataclass(frozen=True, slots=True)
class DynamicParameter:
    """One parameter as a ``.cfg`` file describes it; `type` is bool, int, double or str."""

    name: str
    type: str
    default: Value
    description: str
    lowest: Value | None = None
    highest: Value | None = None
    edit_method: str = ""
    level: int = 1

    def clamped(self, value: Value) -> Value:
        """Return a value within the limits."""
        if isinstance(value, bool | str) or self.lowest is None or self.highest is None:
            return value
        low, high = float(self.lowest), float(self.highest)
        kept = max(low, min(float(value), high))
        return int(kept) if self.type == "int" else kept


class DynamicParameters:
    """The parameters of one node handle.

    Attributes:
        values: present values by name.
    """

    def __init__(
        self,
        resources: Resources,
        store: ParameterPort,
        namespace: str,
        parameters: Sequence[DynamicParameter],
        *,
        changed: Callable[[dict[str, Value]], None],
    ) -> None:
        """Offer topics and service, and set the parameters in the store.

        Args:
            resources: owns topics and service.
            store: a value that is set there already is taken over.
            namespace: such as ``/depth_camera``.
            parameters: in the order to show them.
            changed: called with all values after a change.
        """
        self._parameters = tuple(parameters)
        self._store = store
        self._namespace = namespace
        self._changed = changed
        self.values: dict[str, Value] = {
            row.name: row.clamped(store.get(join_names(namespace, row.name), row.default))
            for row in self._parameters
        }
        self._updates = self._publisher(resources, "parameter_updates", "Config")
        descriptions = self._publisher(resources, "parameter_descriptions", "ConfigDescription")
        resources.service(
            join_names(namespace, "set_parameters"), "dynamic_reconfigure/Reconfigure", self._set
        )
        descriptions.publish(self._description())
        self.announce()

    def announce(self) -> None:
        """Publish the present values and put them into the parameter store."""
        for name, value in self.values.items():
            self._store.set(join_names(self._namespace, name), value)
        self._updates.publish(self._config(self.values))

    def _publisher(self, resources: Resources, topic: str, kind: str) -> Any:
        name = join_names(self._namespace, topic)
        return resources.publisher(name, f"dynamic_reconfigure/{kind}", latch=True)

    def _set(self, request: Any, response: Any) -> None:
        rows = {row.name: row for row in self._parameters}
        for field in _KINDS.values():
            for item in getattr(request.config, field):
                if item.name in rows:
                    self.values[item.name] = rows[item.name].clamped(item.value)
        self._changed(self.values)
        self.announce()
        response.config = self._config(self.values)

    def _config(self, values: dict[str, Value]) -> Any:
        config = message_class("dynamic_reconfigure/Config")()
        for row in self._parameters:
            item = message_class(f"dynamic_reconfigure/{_MESSAGES[row.type]}Parameter")
            getattr(config, _KINDS[row.type]).append(item(name=row.name, value=values[row.name]))
        config.groups.append(
            message_class("dynamic_reconfigure/GroupState")(
                name="Default", state=True, id=0, parent=0
            )
        )
        return config

    def _description(self) -> Any:
        parameter = message_class("dynamic_reconfigure/ParamDescription")
        group = message_class("dynamic_reconfigure/Group")(
            name="Default",
            type="",
            parameters=[
                parameter(
                    name=row.name,
                    type=row.type,
                    level=row.level,
                    description=row.description,
                    edit_method=row.edit_method,
                )
                for row in self._parameters
            ],
            parent=0,
            id=0,
        )

        def limits(pick: Callable[[DynamicParameter], Value | None]) -> Any:
            found = {row.name: pick(row) for row in self._parameters}
            kinds = {row.name: row.type for row in self._parameters}
            return self._config(
                {name: _LIMITS[kinds[name]] if v is None else v for name, v in found.items()}
            )

        return message_class("dynamic_reconfigure/ConfigDescription")(
            groups=[group],
            max=limits(lambda row: row.highest),
            min=limits(lambda row: row.lowest),
            dflt=limits(lambda row: row.default),
        )
