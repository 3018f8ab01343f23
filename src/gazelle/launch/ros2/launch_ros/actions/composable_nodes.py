"""launch_ros.actions: containers, and nodes that are loaded into them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, List  # noqa: UP035

from gazelle.cpp.component_libraries import may_register
from gazelle.cpp.lookup import prefers_cpp
from gazelle.errors import GraphError
from gazelle.graph.ros2_parameter_values import value_message
from gazelle.interfaces import message_type, service_type
from gazelle.launch.cpp_nodes import all_of_package
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.launch_ros.actions.node import Node
from gazelle.launch.ros2.launch_ros.descriptions import ComposableNode
from gazelle.launch.ros2.launch_ros.launch_graph import call_while_running, launch_node
from gazelle.launch.ros2.launch_ros.parameter_descriptions import ParameterFile
from gazelle.launch.ros2.launch_ros.utilities import (
    add_node_name,
    evaluate_parameters,
    get_node_name_count,
    make_namespace_absolute,
    normalize_parameter_dict,
    parameter_values,
    prefix_namespace,
)
from gazelle.launch.ros2.substitution import (
    SomeSubstitutionsType,
    SomeSubstitutionsType_types_tuple,
)
from gazelle.launch.ros2.utilities import (
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from gazelle.node_specs.registry import executable_of_component
from gazelle.workspace.ament_index import known_workspace

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["ComposableNodeContainer", "LoadComposableNodes", "get_composable_node_load_request"]

_KIND = "composition_interfaces/srv/LoadNode"
_ENTITIES: Any = List[Entity]  # noqa: UP006


def _nodes_of(entity: Entity, parser: Parser, *, optional: bool) -> list[ComposableNode] | None:
    found = entity.get_attr("composable_node", data_type=_ENTITIES, optional=optional)
    if found is None:
        return None
    pairs = (ComposableNode.parse(parser, one) for one in found)
    return [kind(**kwargs) for kind, kwargs in pairs]


@expose_action("node_container")
class ComposableNodeContainer(Node):
    """Runs a container, and loads nodes into it."""

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        composable_node_descriptions: Sequence[ComposableNode] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.__nodes = composable_node_descriptions

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: list[str] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<node_container>``."""
        _, kwargs = super().parse(entity, parser, ignore=ignore)
        nodes = _nodes_of(entity, parser, optional=True)
        if nodes is not None:
            kwargs["composable_node_descriptions"] = nodes
        return cls, kwargs

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start the container; the nodes are loaded when it runs."""
        found = super().execute(context) or []
        chosen = [one for one in self.__nodes or () if _is_wanted(one, context)]
        if not chosen:
            return found
        loading = LoadComposableNodes(composable_node_descriptions=chosen, target_container=self)
        return [*found, loading]


@expose_action("load_composable_node")
class LoadComposableNodes(Action):
    """Loads nodes into a container that runs, one after the other."""

    def __init__(
        self,
        *,
        composable_node_descriptions: Sequence[ComposableNode],
        target_container: Any,
        **kwargs: Any,
    ) -> None:
        types = (*SomeSubstitutionsType_types_tuple, ComposableNodeContainer)
        ensure_argument_type(target_container, types, "target_container", "LoadComposableNodes")
        super().__init__(**kwargs)
        self.__nodes = composable_node_descriptions
        self.__target = target_container
        self.__logger = launch_logging.get_logger("launch_ros.actions.load_composable_nodes")

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<load_composable_node>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["target_container"] = parser.parse_substitution(entity.get_attr("target"))
        kwargs["composable_node_descriptions"] = _nodes_of(entity, parser, optional=False)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Begin to load them; what they are given is found out now."""
        requests = [get_composable_node_load_request(one, context) for one in self.__nodes]
        wanted = [one for one in requests if one is not None]
        if not wanted:
            return
        for request in wanted:
            _want_cpp(context, request)
        container = self.__container(context)
        launch_node(context)
        loop = context.asyncio_loop
        future = loop.run_in_executor(None, self.__load, context, container, wanted)
        context.add_completion_future(future)

    def __container(self, context: LaunchContext) -> str:
        if isinstance(self.__target, ComposableNodeContainer):
            return self.__target.node_name
        return perform_substitutions(context, normalize_to_list_of_substitutions(self.__target))

    def __load(self, context: LaunchContext, container: str, requests: Sequence[Any]) -> None:
        for request in requests:
            if not self.__load_one(context, container, request):
                return

    def __load_one(self, context: LaunchContext, container: str, request: Any) -> bool:
        """Load a node; False when the launch ends."""
        service = f"{container}/_container/load_node"
        what = f"node '{request.node_name}' of type '{request.plugin_name}'"
        try:
            answer = call_while_running(context, service, service_type(_KIND), request)
        except GraphError as error:
            self.__logger.error(f"Failed to load {what} in container '{container}': {error}")
            return True
        if answer is None:
            self.__logger.warning(f"Abandoning wait for the '{service}' service, due to shutdown.")
            return False
        if not answer.success:
            why = answer.error_message
            self.__logger.error(f"Failed to load {what} in container '{container}': {why}")
            return True
        name = answer.full_node_name or request.node_name
        self.__logger.info(f"Loaded node '{name}' in container '{container}'")
        self.__count(context, container, name)
        return True

    def __count(self, context: LaunchContext, container: str, name: str) -> None:
        add_node_name(context, name)
        count = get_node_name_count(context, name)
        if count > 1:
            launch_logging.get_logger(container).warning(
                f"there are now at least {count} nodes with the name {name} created within this "
                "launch context"
            )


def get_composable_node_load_request(
    composable_node_description: ComposableNode, context: LaunchContext
) -> Any:
    """Return the request that loads a node, None when its condition says no."""
    node = composable_node_description
    if not _is_wanted(node, context):
        return None
    request: Any = service_type(_KIND).Request()
    request.package_name = perform_substitutions(context, node.package)
    request.plugin_name = perform_substitutions(context, node.node_plugin)
    if node.node_name is not None:
        request.node_name = perform_substitutions(context, node.node_name)
    space = node.node_namespace
    own = None if space is None else perform_substitutions(context, space)
    base = context.launch_configurations.get("ros_namespace")
    full = make_namespace_absolute(prefix_namespace(base, own))
    request.node_namespace = full or ""
    request.remap_rules = _remaps(node, context)
    given = [*_shared(context), *(node.parameters or ())]
    request.parameters = _messages(context, request, full, given)
    request.extra_arguments = _messages(context, request, full, node.extra_arguments or ())
    return request


def _want_cpp(context: LaunchContext, request: Any) -> None:
    """Let the C++ of a component be compiled before its container starts."""
    package = known_workspace().packages.get(request.package_name)
    if package is None or package.prefix is not None or not may_register(package):
        return
    plugin = request.plugin_name
    if executable_of_component(package.name, plugin) and not prefers_cpp(context.environment):
        return
    context.cpp_builds.want(all_of_package(package))


def _is_wanted(node: ComposableNode, context: LaunchContext) -> bool:
    condition = node.condition()
    return condition is None or condition.evaluate(context)


def _remaps(node: ComposableNode, context: LaunchContext) -> list[str]:
    shared: Any = context.launch_configurations.get("ros_remaps") or ()
    rules = [f"{source}:={target}" for source, target in shared]
    for pair in node.remappings or ():
        source, target = (perform_substitutions(context, one) for one in pair)
        rules.append(f"{source}:={target}")
    return rules


def _shared(context: LaunchContext) -> list[Any]:
    """Return what `SetParameter` and `SetParametersFromFile` have set."""
    given: Any = context.launch_configurations.get("global_params") or ()
    return [
        normalize_parameter_dict(dict([one])) if isinstance(one, tuple) else ParameterFile(one)
        for one in given
    ]


def _messages(
    context: LaunchContext, request: Any, namespace: str | None, given: Sequence[Any]
) -> list[Any]:
    kind: Any = message_type("rcl_interfaces/msg/Parameter")
    evaluated = evaluate_parameters(context, given)
    values = parameter_values(context, request.node_name, namespace, evaluated)
    return [
        kind(name=name, value=value_message(list(value) if isinstance(value, tuple) else value))
        for name, value in values
    ]
