"""Nodes (rclpy.node)."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

from gazelle.compat.rclpy import logging
from gazelle.compat.rclpy.callback_groups import CallbackGroup, MutuallyExclusiveCallbackGroup
from gazelle.compat.rclpy.clock import Clock, ROSClock
from gazelle.compat.rclpy.context import Context, get_default_context
from gazelle.compat.rclpy.event_handler import (
    EventWatch,
    PublisherEventCallbacks,
    SubscriptionEventCallbacks,
)
from gazelle.compat.rclpy.exceptions import (
    InvalidParameterException,
    InvalidParameterTypeException,
    InvalidParameterValueException,
    NotInitializedException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from gazelle.compat.rclpy.executors import Once, Work
from gazelle.compat.rclpy.guard_condition import GuardCondition
from gazelle.compat.rclpy.name_validation import (
    expand_topic_name,
    validate_full_topic_name,
    validate_topic_name,
)
from gazelle.compat.rclpy.parameter import Parameter
from gazelle.compat.rclpy.publisher_subscription_service import (
    Client,
    MsgType,
    Publisher,
    Service,
    SrvType,
    SrvTypeRequest,
    SrvTypeResponse,
    Subscription,
    check_type,
)
from gazelle.compat.rclpy.qos import QoSProfile, as_profile, qos_profile_services_default
from gazelle.compat.rclpy.qos_overriding_options import QoSOverridingOptions, overridden
from gazelle.compat.rclpy.timer import Rate, Timer
from gazelle.compat.rclpy.topic_endpoint_info import TopicEndpointInfo, endpoint_info
from gazelle.compat.rclpy.type_description_service import (
    START_TYPE_DESCRIPTION_SERVICE_PARAM,
    offer_type_descriptions,
)
from gazelle.diagnostics import did_you_mean
from gazelle.errors import NotFoundError as NodeNameNonExistentError
from gazelle.graph import Entity, Graph, Kind, NodeInfo, ServiceRefusedError
from gazelle.graph.actions import actions_of
from gazelle.graph.names import join, resolve, split
from gazelle.graph.ros2_node_parameters import Descriptor, NodeParameters, ParameterPolicy
from gazelle.graph.ros2_parameter_values import value_from_message, value_message
from gazelle.interfaces import message_type, service_type

__all__ = [
    "HIDDEN_NODE_PREFIX",
    "MsgType",
    "Node",
    "NodeNameNonExistentError",
    "SrvType",
    "SrvTypeRequest",
    "SrvTypeResponse",
]

HIDDEN_NODE_PREFIX = "_"

ParametersCallback = Callable[[list[Parameter]], Any]
NamesAndTypes = list[tuple[str, list[str]]]
_T = TypeVar("_T")
_S_TO_NS = 1_000_000_000
_SIM_TIME = "use_sim_time"


class Node:
    """A node of ROS 2.

    Args:
        node_name: one legal part; ``__node:=`` on the command line counts more.
        context: the default one when None.
        cli_args: arguments of this node alone, with ``--ros-args``.
        namespace: ``__ns:=`` on the command line counts more.
        use_global_arguments: heed the program's arguments.
        enable_rosout: say things on ``/rosout`` too.
        start_parameter_services: let others get and set parameters.
        parameter_overrides: values that count more than defaults.
        allow_undeclared_parameters: setting declares.
        automatically_declare_parameters_from_overrides: declare what the overrides name.
        enable_logger_service: let others get and set the levels of loggers.

    Raises:
        NotInitializedException: `rclpy.init` has not been called.
        IllegalNameError: the name is not legal.
    """

    def __init__(  # noqa: PLR0913 - rclpy's signature
        self,
        node_name: str,
        *,
        context: Context | None = None,
        cli_args: list[str] | None = None,
        namespace: str | None = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        start_parameter_services: bool = True,
        parameter_overrides: list[Parameter] | None = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None:
        from gazelle.graph.ros2_arguments import RosArguments, parse_ros_arguments

        self.context = context or get_default_context()
        if not self.context.ok():
            raise NotInitializedException
        given = self.context.arguments if use_global_arguments else RosArguments()
        own = parse_ros_arguments(cli_args or [])
        name = own.node_name(given.node_name(node_name))
        space = own.namespace(node_name) or given.namespace(node_name) or namespace or ""
        with self.context.graph.announcements.together():  # who sees the node sees its services
            self.graph_node = self.context.graph.create_node(
                name,
                namespace=resolve(space or "/"),
                remappings={**given.remappings(name), **own.remappings(name)},
                rosout=enable_rosout,
                is_ros2=True,
            )
            self.is_destroyed = False
            self.executor: Any = None
            self.__pending: deque[Work] = deque()
            self.__answers: set[threading.Event] = set()
            self.__created: list[Any] = []
            self._default_callback_group = MutuallyExclusiveCallbackGroup()
            self._clock = ROSClock()
            self._clock.attach(self.graph_node.clock)
            self._logger = logging.RcutilsLogger(self.__logger_name())
            logging.attach_node(self._logger.name, self.graph_node)
            for logger, level in {**given.log_levels, **own.log_levels}.items():
                if logger in ("", self._logger.name):
                    self._logger.set_level(logging.get_logging_severity_from_string(level))
            overrides = {**given.parameters(self._rcl_full), **own.parameters(self._rcl_full)}
            overrides |= {one.name: one.value for one in parameter_overrides or []}
            self.__make_parameters(overrides, allow_undeclared_parameters, start_parameter_services)
            self.__offer_type_descriptions()
            if enable_logger_service:
                logging.offer_logger_levels(self)
            if automatically_declare_parameters_from_overrides:
                self.__declare_overrides()

    def __enter__(self) -> Node:
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.destroy_node()

    @property
    def default_callback_group(self) -> CallbackGroup:
        """The group of what names no other."""
        return self._default_callback_group

    @property
    def publishers(self) -> Iterator[Publisher]:
        """Publishers of this node."""
        return (one for one in self.__created if isinstance(one, Publisher))

    @property
    def subscriptions(self) -> Iterator[Subscription]:
        """Subscriptions of this node."""
        return (one for one in self.__created if isinstance(one, Subscription))

    @property
    def services(self) -> Iterator[Service]:
        """Services of this node."""
        return (one for one in self.__created if isinstance(one, Service))

    @property
    def clients(self) -> Iterator[Client]:
        """Clients of this node."""
        return (one for one in self.__created if isinstance(one, Client))

    @property
    def timers(self) -> Iterator[Timer]:
        """Timers of this node."""
        return (one for one in self.__created if isinstance(one, Timer))

    @property
    def guards(self) -> Iterator[GuardCondition]:
        """Guard conditions of this node."""
        return (one for one in self.__created if isinstance(one, GuardCondition))

    def get_name(self) -> str:
        """Return the node's own name."""
        return self._rcl_full.rpartition("/")[2]

    def get_namespace(self) -> str:
        """Return the namespace, ``/`` for none."""
        return self._rcl_full.rpartition("/")[0] or "/"

    def get_fully_qualified_name(self) -> str:
        """Return namespace and name."""
        return self._rcl_full

    def get_clock(self) -> ROSClock:
        """Return the node's clock."""
        return self._clock

    def get_logger(self) -> logging.RcutilsLogger:
        """Return the node's logger."""
        return self._logger

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Return a topic's global name, after remapping unless only expanded.

        Raises:
            InvalidTopicNameException: the name is not legal.
            ValueError: it has an unknown substitution.
        """
        return self._rcl_resolved(topic, only_expand=only_expand)

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """Return a service's global name, after remapping unless only expanded.

        Raises:
            InvalidServiceNameException: the name is not legal.
        """
        return self._rcl_resolved(service, only_expand=only_expand, is_service=True)

    def create_publisher(
        self,
        msg_type: Any,
        topic: str,
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: PublisherEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        publisher_class: type[Publisher] = Publisher,
    ) -> Publisher:
        """Offer a topic.

        Args:
            msg_type: class of the messages.
            topic: any legal name.
            qos_profile: a profile, or the queue's depth.
            callback_group: that of `event_callbacks`.
            event_callbacks: called when subscriptions come and go, and so on.
            qos_overriding_options: policies that parameters may change.
            publisher_class: what is returned.

        Raises:
            AttributeError: the type is none of ROS 2.
        """
        check_type(msg_type, "msg")
        full = self.resolve_topic_name(topic)
        qos = overridden(self, full, "publisher", as_profile(qos_profile), qos_overriding_options)
        made = self.__keep(publisher_class(self, msg_type, topic, qos))
        group = callback_group or self._default_callback_group
        events = event_callbacks or PublisherEventCallbacks()
        made.events = EventWatch(self, topic, full, qos, events, group)
        return made

    def create_subscription(
        self,
        msg_type: Any,
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> Subscription:
        """Receive a topic; callbacks run while the node spins.

        Args:
            msg_type: class of the messages.
            topic: any legal name.
            callback: takes the message, and its details if it wants them.
            qos_profile: a profile, or the queue's depth.
            callback_group: what may run at the same time.
            event_callbacks: called when publishers come and go, and so on.
            qos_overriding_options: policies that parameters may change.
            raw: give the callback bytes.

        Raises:
            AttributeError: the type is none of ROS 2.
        """
        check_type(msg_type, "msg")
        group = callback_group or self._default_callback_group
        full = self.resolve_topic_name(topic)
        given = as_profile(qos_profile)
        qos = overridden(self, full, "subscription", given, qos_overriding_options)
        made = self.__keep(Subscription(self, msg_type, topic, callback, qos, group=group, raw=raw))
        events = event_callbacks or SubscriptionEventCallbacks()
        made.events = EventWatch(self, topic, full, qos, events, group)
        return made

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Callable[[Any, Any], Any],
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Service:
        """Answer a service: `callback(request, response)` returns the response.

        Raises:
            AttributeError: the type is none of ROS 2.
        """
        check_type(srv_type, "srv")
        group = callback_group or self._default_callback_group
        return self.__keep(Service(self, srv_type, srv_name, callback, qos_profile, group))

    def create_client(
        self,
        srv_type: Any,
        srv_name: str,
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Client:
        """Prepare calls of a service.

        Raises:
            AttributeError: the type is none of ROS 2.
        """
        check_type(srv_type, "srv")
        group = callback_group or self._default_callback_group
        return self.__keep(Client(self, srv_type, srv_name, qos_profile, group))

    def create_timer(
        self,
        timer_period_sec: float,
        callback: Callable[..., Any],
        callback_group: CallbackGroup | None = None,
        clock: Clock | None = None,
        autostart: bool = True,
    ) -> Timer:
        """Call back once a period of the node's clock."""
        period_ns = int(float(timer_period_sec) * _S_TO_NS)
        group = callback_group or self._default_callback_group
        return self.__keep(
            Timer(self, callback, period_ns, clock or self._clock, group, autostart=autostart)
        )

    def create_guard_condition(
        self, callback: Callable[[], Any], callback_group: CallbackGroup | None = None
    ) -> GuardCondition:
        """Prepare a call that `trigger` asks for, from any thread."""
        group = callback_group or self._default_callback_group
        return self.__keep(GuardCondition(self, callback, group))

    def create_rate(self, frequency: float, clock: Clock | None = None) -> Rate:
        """Return something that sleeps at a rate.

        Raises:
            TypeError: the frequency is no number.
            ValueError: it is not positive.
        """
        if not isinstance(frequency, int | float):
            raise TypeError(f"frequency must be float or int, got {type(frequency)}")
        if frequency <= 0:
            raise ValueError("frequency must be greater than 0")
        return Rate(self, int(_S_TO_NS / frequency), clock or self._clock)

    def destroy_publisher(self, publisher: Publisher) -> bool:
        """Stop offering a topic."""
        return self.__destroy(publisher)

    def destroy_subscription(self, subscription: Subscription) -> bool:
        """Stop receiving a topic."""
        return self.__destroy(subscription)

    def destroy_service(self, service: Service) -> bool:
        """Stop answering a service."""
        return self.__destroy(service)

    def destroy_client(self, client: Client) -> bool:
        """Give a client up."""
        return self.__destroy(client)

    def destroy_timer(self, timer: Timer) -> bool:
        """Stop a timer."""
        return self.__destroy(timer)

    def destroy_guard_condition(self, guard: GuardCondition) -> bool:
        """Give a guard condition up."""
        return self.__destroy(guard)

    def destroy_rate(self, rate: Rate) -> bool:
        """Stop a rate."""
        rate.destroy()
        return True

    def destroy_node(self) -> None:
        """Take everything of this node off the graph; twice does nothing."""
        if self.is_destroyed:
            return
        self.is_destroyed = True
        if self.executor is not None:
            self.executor.remove_node(self)
        for one in reversed(self.__created):
            one.destroy()
        for event in tuple(self.__answers):
            event.set()
        self._parameters.close()
        self.graph_node.shutdown("destroyed")
        logging.detach_node(self._logger.name)

    # Parameters.

    def declare_parameter(
        self,
        name: str,
        value: Any = None,
        descriptor: Any = None,
        ignore_override: bool = False,
    ) -> Parameter:
        """Declare a parameter; what the command line and parameter files say counts more.

        Args:
            name: parts are separated by dots.
            value: the default, or a `Parameter.Type` for a value that must be given.
            descriptor: ``rcl_interfaces/msg/ParameterDescriptor``.
            ignore_override: keep the default whatever others say.

        Raises:
            ParameterAlreadyDeclaredException: it was declared before.
            InvalidParameterException: the name is empty.
            InvalidParameterValueException: the value was refused.
            InvalidParameterTypeException: the value given is of another type.
        """
        if not name or not isinstance(name, str):
            raise InvalidParameterException(str(name))
        if name in self._parameters.values or name in self._rcl_uninitialized:
            raise ParameterAlreadyDeclaredException([name])
        known = _descriptor_of(descriptor)
        wanted = value if isinstance(value, Parameter.Type) else None
        given = None if wanted is not None else value
        if not ignore_override and name in self._rcl_overrides:
            given = _override_of_type(name, self._rcl_overrides[name], value, known)
        elif wanted is not None:
            self._rcl_uninitialized[name] = wanted
            return Parameter(name)
        reason = self.__refusal([Parameter(name, value=given)])
        if reason:
            raise InvalidParameterValueException(name, given, reason)
        self._parameters.declare(name, given, known)
        return Parameter(name, value=given)

    def declare_parameters(
        self, namespace: str, parameters: Iterable[Any], ignore_override: bool = False
    ) -> list[Parameter]:
        """Declare several: names, (name, value) or (name, value, descriptor), below a prefix."""
        prefix = f"{namespace}." if namespace else ""
        found = []
        for item in parameters:
            name, *rest = (item,) if isinstance(item, str) else item
            value, descriptor = (*rest, None, None)[:2]
            found.append(self.declare_parameter(prefix + name, value, descriptor, ignore_override))
        return found

    def undeclare_parameter(self, name: str) -> None:
        """Remove a parameter.

        Raises:
            ParameterNotDeclaredException: there is none of the name.
            ParameterImmutableException: it is read-only.
        """
        if self._rcl_uninitialized.pop(name, None) is not None:
            return
        self.__check_declared(name)
        if self._parameters.descriptor(name).read_only:
            raise ParameterImmutableException(name)
        self._parameters.undeclare(name)

    def has_parameter(self, name: str) -> bool:
        """Tell whether it is declared."""
        return name in self._parameters.values or name in self._rcl_uninitialized

    def get_parameter(self, name: str) -> Parameter:
        """Return a parameter.

        Raises:
            ParameterNotDeclaredException: there is none of the name.
            ParameterUninitializedException: it was declared by type and has no value.
        """
        if name in self._rcl_uninitialized:
            raise ParameterUninitializedException(name)
        if name not in self._parameters.values and self._rcl_allow_undeclared:
            return Parameter(name)
        self.__check_declared(name)
        return Parameter(name, value=self._parameters.values[name])

    def get_parameters(self, names: Iterable[str]) -> list[Parameter]:
        """Return several parameters."""
        return [self.get_parameter(name) for name in names]

    def get_parameter_or(self, name: str, alternative_value: Any = None) -> Parameter:
        """Return a parameter, or another one when it is not there or not set."""
        if self._parameters.values.get(name) is None:
            return alternative_value or Parameter(name)
        return self.get_parameter(name)

    def get_parameter_type(self, name: str) -> Parameter.Type:
        """Return a parameter's type."""
        return self.get_parameter(name).type_

    def get_parameter_types(self, names: Iterable[str]) -> list[Parameter.Type]:
        """Return the types of several parameters."""
        return [self.get_parameter_type(name) for name in names]

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter]:
        """Return the parameters below a prefix, their names without it."""
        start = f"{prefix}." if prefix else ""
        return {
            name.removeprefix(start): Parameter(name, value=value)
            for name, value in self._parameters.values.items()
            if name.startswith(start)
        }

    def set_parameters(self, parameter_list: list[Parameter]) -> list[Any]:
        """Set parameters one by one; a ``SetParametersResult`` for each.

        Raises:
            ParameterNotDeclaredException: one is not declared.
        """
        return [self.set_parameters_atomically([one]) for one in parameter_list]

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> Any:
        """Set all parameters or none; return ``SetParametersResult``.

        Raises:
            ParameterNotDeclaredException: one is not declared.
        """
        for callback in self._rcl_pre_callbacks:
            parameter_list = callback(parameter_list)
        for one in parameter_list:
            if one.name in self._rcl_uninitialized:
                self._parameters.declare(one.name, one.value)
                del self._rcl_uninitialized[one.name]
            if not self._rcl_allow_undeclared:
                self.__check_declared(one.name)
        reason = self._parameters.set({one.name: one.value for one in parameter_list})
        result = message_type("rcl_interfaces/msg/SetParametersResult")
        return result(successful=not reason, reason=reason)

    def list_parameters(self, prefixes: list[str], depth: int) -> Any:
        """Return ``rcl_interfaces/msg/ListParametersResult`` of names below prefixes."""
        kind = service_type("rcl_interfaces/srv/ListParameters")
        response = kind.Response()
        self._parameters.list_into(kind.Request(prefixes=prefixes, depth=depth), response)
        return response.result

    def set_descriptor(self, name: str, descriptor: Any, alternative_value: Any = None) -> Any:
        """Set what is said about a parameter; return its ``ParameterValue``.

        Args:
            name: a declared parameter.
            descriptor: ``rcl_interfaces/msg/ParameterDescriptor``.
            alternative_value: a ``ParameterValue`` for when the present one does not fit.

        Raises:
            ParameterNotDeclaredException: there is none of the name.
            ParameterImmutableException: it is read-only.
            InvalidParameterValueException: neither value fits.
        """
        self.__check_declared(name)
        if self._parameters.descriptor(name).read_only:
            raise ParameterImmutableException(name)
        known = _descriptor_of(descriptor)
        value = self._parameters.values[name]
        if not known.allows(value) and alternative_value is not None:
            value = value_from_message(alternative_value)
        if not known.allows(value):
            limits = f"[{known.lowest:g}, {known.highest:g}]"
            text = f"Parameter {{{name}}} doesn't comply with range {limits}."
            raise InvalidParameterValueException(name, value, text)
        self._parameters.declare(name, value, known)
        return value_message(value)

    def describe_parameter(self, name: str) -> Any:
        """Return ``rcl_interfaces/msg/ParameterDescriptor`` of a parameter."""
        self.__check_declared(name)
        return self._parameters._descriptor_message(name)

    def describe_parameters(self, names: Iterable[str]) -> list[Any]:
        """Return the descriptors of several parameters."""
        return [self.describe_parameter(name) for name in names]

    def add_pre_set_parameters_callback(self, callback: ParametersCallback) -> None:
        """Call something that may change what is to be set."""
        self._rcl_pre_callbacks.insert(0, callback)

    def add_on_set_parameters_callback(self, callback: ParametersCallback) -> None:
        """Call something that judges what is to be set, with a ``SetParametersResult``."""
        self._rcl_set_callbacks.insert(0, callback)

    def add_post_set_parameters_callback(self, callback: ParametersCallback) -> None:
        """Call something after parameters were set."""
        self._rcl_post_callbacks.insert(0, callback)

    def remove_on_set_parameters_callback(self, callback: ParametersCallback) -> None:
        """Ask a callback no more."""
        self._rcl_set_callbacks.remove(callback)

    def remove_pre_set_parameters_callback(self, callback: ParametersCallback) -> None:
        """Ask a callback no more."""
        self._rcl_pre_callbacks.remove(callback)

    def remove_post_set_parameters_callback(self, callback: ParametersCallback) -> None:
        """Tell a callback no more."""
        self._rcl_post_callbacks.remove(callback)

    # The graph.

    def get_node_names(self) -> list[str]:
        """Return the nodes' own names."""
        return [name for name, _ in self.get_node_names_and_namespaces()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """Return the nodes' global names."""
        return list(self._rcl_graph.node_names(include_hidden=True))

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return the nodes' own names and namespaces."""
        found = (split(name) for name in self._rcl_graph.node_names(include_hidden=True))
        return [(name, namespace) for namespace, name in found]

    def get_topic_names_and_types(self, no_demangle: bool = False) -> NamesAndTypes:
        """Return all topics; `no_demangle` changes nothing, as in rmw_zenoh."""
        topics = self._rcl_graph.topics(include_hidden=True)
        return [(one.name, [one.type_name]) for one in topics]

    def get_service_names_and_types(self) -> NamesAndTypes:
        """Return all services."""
        services = self._rcl_graph.services(include_hidden=True)
        return [(one.name, [one.type_name]) for one in services]

    def get_action_names_and_types(self) -> NamesAndTypes:
        """Return all actions of ROS 2."""
        found = actions_of(self._rcl_graph.entities())
        return [(one.name, [one.type_name]) for one in found if one.ros_version == 2]

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return what a node publishes; `no_demangle` changes nothing, as in rmw_zenoh."""
        return _pairs(self.__info(node_name, node_namespace).publications)

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return what a node subscribes; `no_demangle` changes nothing, as in rmw_zenoh."""
        return _pairs(self.__info(node_name, node_namespace).subscriptions)

    def get_service_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> NamesAndTypes:
        """Return the services that a node answers."""
        return _pairs(self.__info(node_name, node_namespace).services)

    def get_client_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> NamesAndTypes:
        """Return the services that a node calls."""
        return _pairs(self.__info(node_name, node_namespace).clients)

    def count_publishers(self, topic_name: str) -> int:
        """Return how many publishers a topic has."""
        return len(
            self._rcl_graph.publishers_info(self.resolve_topic_name(topic_name, only_expand=True))
        )

    def count_subscribers(self, topic_name: str) -> int:
        """Return how many subscriptions a topic has."""
        return len(
            self._rcl_graph.subscriptions_info(
                self.resolve_topic_name(topic_name, only_expand=True)
            )
        )

    def count_clients(self, service_name: str) -> int:
        """Return how many clients a service has."""
        return self.__count(Kind.CLIENT, service_name)

    def count_services(self, service_name: str) -> int:
        """Return how many servers a service has."""
        return self.__count(Kind.SERVICE, service_name)

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Return the nodes' own names, namespaces and enclaves, which are all ``/``."""
        return [(*one, "/") for one in self.get_node_names_and_namespaces()]

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Wait until a node is there; False when `timeout` seconds pass first."""
        wanted = resolve(fully_qualified_node_name)

        def is_there(entities: Iterable[Entity]) -> bool:
            return any(one.kind is Kind.NODE and one.node == wanted for one in entities)

        return self._rcl_graph.discovery.wait_for(is_there, timeout)

    def get_publishers_info_by_topic(self, topic_name: str) -> list[TopicEndpointInfo]:
        """Return the publishers of a topic."""
        full = self.resolve_topic_name(topic_name)
        return [
            endpoint_info(self._rcl_graph, one) for one in self._rcl_graph.publishers_info(full)
        ]

    def get_subscriptions_info_by_topic(self, topic_name: str) -> list[TopicEndpointInfo]:
        """Return the subscriptions of a topic."""
        full = self.resolve_topic_name(topic_name)
        return [
            endpoint_info(self._rcl_graph, one) for one in self._rcl_graph.subscriptions_info(full)
        ]

    # What entities and executors call.

    def keep_entity(self, one: Any) -> None:
        """Destroy something together with the node: an action's end."""
        self.__created.append(one)

    def post_work(self, work: Work) -> None:
        """Let the executor that spins this node do some work; from any thread."""
        self.__pending.append(work)
        if self.executor is not None:
            self.executor.wake()

    def next_work(self) -> tuple[Work, Callable[[], Any]] | None:
        """Return the oldest work whose group lets it run now, and claim the group."""
        for _ in range(len(self.__pending)):
            work = self.__pending.popleft()
            if not work.callback_group.beginning_execution(work):
                self.__pending.append(work)
                continue
            callback = work.take()
            if callback is not None:
                return work, callback
            work.callback_group.ending_execution(work)
        return None

    def run_in_executor(
        self, group: CallbackGroup, callback: Callable[[], Any]
    ) -> Callable[[], Any]:
        """Let the executor run a function or coroutine; return what waits for its value.

        That raises `ServiceRefusedError` when the node is destroyed meanwhile.
        """
        done = threading.Event()
        found: list[Any] = []

        async def run() -> None:
            try:
                value = callback()
                found.append(await value if hasattr(value, "__await__") else value)
            finally:
                done.set()

        def value() -> Any:
            try:
                done.wait()
            finally:
                self.__answers.discard(done)
            if not found:
                raise ServiceRefusedError(f"node {self._rcl_full} could not answer")
            return found[0]

        self.__answers.add(done)
        self.post_work(Once(group, run))
        return value

    @property
    def _rcl_full(self) -> str:
        return self.graph_node.name

    def __logger_name(self) -> str:
        return self._rcl_full.strip("/").replace("/", ".")

    def __make_parameters(
        self, overrides: dict[str, Any], allow_undeclared: bool, services: bool
    ) -> None:
        self._rcl_overrides = overrides
        self._rcl_allow_undeclared = allow_undeclared
        self._rcl_uninitialized: dict[str, Parameter.Type] = {}
        self._rcl_pre_callbacks: list[ParametersCallback] = []
        self._rcl_set_callbacks: list[ParametersCallback] = []
        self._rcl_post_callbacks: list[ParametersCallback] = []
        self._parameters = NodeParameters(
            self.graph_node,
            self._rcl_full,
            {_SIM_TIME: overrides.get(_SIM_TIME) is True},
            self._rcl_on_set,
            policy=ParameterPolicy(allow_undeclared, is_strict=True, has_services=services),
            run=self.__run_parameters,
            now_ns=self._clock.now_ns,
        )
        self._rcl_take_effect({_SIM_TIME: self._parameters.values[_SIM_TIME]})

    def _rcl_on_set(self, changes: dict[str, Any]) -> str:
        """Judge a change from whomever; why it is refused, or nothing."""
        parameters = [Parameter(name, value=value) for name, value in changes.items()]
        reason = self.__refusal(parameters)
        if reason:
            return reason
        self._rcl_take_effect(changes)
        for callback in self._rcl_post_callbacks:
            callback(parameters)
        return ""

    def __declare_overrides(self) -> None:
        for key in [key for key in self._rcl_overrides if not self.has_parameter(key)]:
            self.declare_parameter(key, self._rcl_overrides[key])

    def __offer_type_descriptions(self) -> None:
        name = START_TYPE_DESCRIPTION_SERVICE_PARAM
        text = "If enabled, start the ~/get_type_description service."
        known = message_type("rcl_interfaces/msg/ParameterDescriptor")
        descriptor = known(name=name, type=1, description=text, read_only=True)
        if self.declare_parameter(name, True, descriptor).value:
            offer_type_descriptions(self.graph_node)

    def __run_parameters(self, command: Callable[[], Any]) -> Any:
        """Handle a request in the thread that spins, so that callbacks meet no other thread."""
        if self.executor is None:
            return command()
        return self.run_in_executor(self._default_callback_group, command)()

    def _rcl_take_effect(self, changes: dict[str, Any]) -> None:
        if _SIM_TIME in changes:
            self.graph_node.clock.use(bool(changes[_SIM_TIME]))

    def __keep(self, one: _T) -> _T:
        self.__created.append(one)
        return one

    def __destroy(self, one: Any) -> bool:
        if one not in self.__created:
            return False
        self.__created.remove(one)
        one.destroy()
        return True

    def __refusal(self, parameters: list[Parameter]) -> str:
        for callback in self._rcl_set_callbacks:
            result = callback(parameters)
            if not result.successful:
                return str(result.reason) or "refused"
        return ""

    def __check_declared(self, name: str) -> None:
        if name not in self._parameters.values:
            raise ParameterNotDeclaredException([name], did_you_mean(name, self._parameters.values))

    def _rcl_resolved(
        self, name: str, *, only_expand: bool = False, is_service: bool = False
    ) -> str:
        validate_topic_name(name, is_service=is_service)
        namespace, own = split(self.graph_node.name)
        full = expand_topic_name(name, own, namespace)
        validate_full_topic_name(full, is_service=is_service)
        return full if only_expand else self.graph_node.resolve_name(full)

    @property
    def _rcl_graph(self) -> Graph:
        return self.graph_node.graph

    def __count(self, kind: Kind, name: str) -> int:
        full = self.resolve_topic_name(name, only_expand=True)
        return sum(one.kind is kind and one.name == full for one in self._rcl_graph.entities())

    def __info(self, name: str, namespace: str) -> NodeInfo:
        return self._rcl_graph.node_info(join(namespace or "/", name))


def _pairs(endpoints: Any) -> NamesAndTypes:
    return [(one.name, [one.type_name]) for one in endpoints]


def _descriptor_of(message: Any) -> Descriptor:
    if message is None:
        return Descriptor()
    ranges = [*message.floating_point_range, *message.integer_range]
    return Descriptor(
        description=message.description,
        read_only=message.read_only,
        dynamic_typing=message.dynamic_typing,
        lowest=ranges[0].from_value if ranges else None,
        highest=ranges[0].to_value if ranges else None,
    )


def _override_of_type(name: str, given: Any, declared: Any, known: Descriptor) -> Any:
    """Return an override if it is of the declared type; 3 is no double, as in rclpy.

    Raises:
        InvalidParameterTypeException: it is of another type.
    """
    if declared is None or known.dynamic_typing:
        return given
    wanted = declared
    if not isinstance(declared, Parameter.Type):
        wanted = Parameter.Type.from_parameter_value(declared)
    if not wanted.check(given):
        kind = Parameter.Type.from_parameter_value(given).name
        raise InvalidParameterTypeException(name, given, given=kind, desired=wanted.name)
    return given
