"""launch_ros.descriptions: parameters, and nodes that live in containers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, List  # noqa: UP035

from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.condition import Condition
from gazelle.launch.ros2.frontend import Entity, Parser
from gazelle.launch.ros2.launch_ros.actions.node_keywords import newer_names
from gazelle.launch.ros2.launch_ros.actions.node_markup import parameters_of, remaps_of
from gazelle.launch.ros2.launch_ros.parameter_descriptions import (
    Parameter,
    ParameterFile,
    ParameterValue,
)
from gazelle.launch.ros2.launch_ros.utilities import normalize_parameters, normalize_remap_rules
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.utilities import normalize_to_list_of_substitutions

__all__ = ["ComposableNode", "Parameter", "ParameterFile", "ParameterValue"]

_OLD_NAMES = {"node_plugin": "plugin", "node_name": "name", "node_namespace": "namespace"}
_ENTITIES: Any = List[Entity]  # noqa: UP006


class ComposableNode:
    """A node to load into a container.

    Attributes:
        package: that its plug-in is in.
        node_plugin: such as ``demo_nodes_cpp::Talker``.
        node_name, node_namespace: None for its own.
        parameters, remappings, extra_arguments: None without any.
    """

    def __init__(
        self,
        *,
        package: SomeSubstitutionsType,
        plugin: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        parameters: Any = None,
        remappings: Iterable[Any] | None = None,
        extra_arguments: Any = None,
        condition: Condition | None = None,
        **kwargs: Any,
    ) -> None:
        given = {"plugin": plugin, "name": name, "namespace": namespace}
        given, rest = newer_names("ComposableNode", given, kwargs, _OLD_NAMES)
        if rest:
            raise TypeError(
                f"ComposableNode() got an unexpected keyword argument '{next(iter(rest))}'"
            )
        if given["plugin"] is None:
            raise TypeError("ComposableNode() missing 1 required keyword-only argument: 'plugin'")
        self.package = normalize_to_list_of_substitutions(package)
        self.node_plugin = normalize_to_list_of_substitutions(given["plugin"])
        self.node_name = _subs(given["name"])
        self.node_namespace = _subs(given["namespace"])
        self.parameters = None if parameters is None else normalize_parameters(parameters)
        self.remappings = list(normalize_remap_rules(remappings)) if remappings else None
        self.extra_arguments = normalize_parameters(extra_arguments) if extra_arguments else None
        self.__condition = condition

    @classmethod
    def parse(cls, parser: Parser, entity: Entity) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<composable_node>``."""
        _, kwargs = Action.parse(entity, parser)
        for attribute, name in (("pkg", "package"), ("plugin", "plugin"), ("name", "name")):
            kwargs[name] = parser.parse_substitution(entity.get_attr(attribute))
        namespace = entity.get_attr("namespace", optional=True)
        if namespace is not None:
            kwargs["namespace"] = parser.parse_substitution(namespace)
        parameters = entity.get_attr("param", data_type=_ENTITIES, optional=True)
        if parameters is not None:
            kwargs["parameters"] = parameters_of(parameters, parser)
        remaps = remaps_of(entity, parser)
        if remaps is not None:
            kwargs["remappings"] = remaps
        extra = entity.get_attr("extra_arg", data_type=_ENTITIES, optional=True)
        if extra is not None:
            kwargs["extra_arguments"] = [_extra(one, parser) for one in extra]
        entity.assert_entity_completely_parsed()
        return cls, kwargs

    def condition(self) -> Condition | None:
        """Return its condition, None when it is always loaded."""
        return self.__condition


def _extra(entity: Entity, parser: Parser) -> dict[Any, Any]:
    name, value = (parser.parse_substitution(entity.get_attr(key)) for key in ("name", "value"))
    entity.assert_entity_completely_parsed()
    # As one text: several substitutions side by side would be a list otherwise.
    return {tuple(name): ParameterValue(value)}


def _subs(value: Any) -> Any:
    return None if value is None else normalize_to_list_of_substitutions(value)
