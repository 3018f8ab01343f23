"""Nodes (rclpy.node)."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

from gazelle.compat.rclpy import logging
from gazelle.compat.rclpy.annotations import MsgType, SrvType, SrvTypeRequest, SrvTypeResponse
from gazelle.compat.rclpy.callback_groups import CallbackGroup, MutuallyExclusiveCallbackGroup
from gazelle.compat.rclpy.clock import Clock, ROSClock
from gazelle.compat.rclpy.context import Context, get_default_context
from gazelle.compat.rclpy.endpoints import Client, Publisher, Service, Subscription, check_type
from gazelle.compat.rclpy.event_handler import (
    EventWatch,
    PublisherEventCallbacks,
    SubscriptionEventCallbacks,
)
from gazelle.compat.rclpy.exceptions import NotInitializedException
from gazelle.compat.rclpy.guard_condition import GuardCondition
from gazelle.compat.rclpy.logger_levels import offer_logger_levels
from gazelle.compat.rclpy.node_graph import GraphQueries
from gazelle.compat.rclpy.node_parameters import ParameterHolder
from gazelle.compat.rclpy.parameter import Parameter
from gazelle.compat.rclpy.qos import QoSProfile, as_profile, qos_profile_services_default
from gazelle.compat.rclpy.qos_overriding_options import QoSOverridingOptions, overridden
from gazelle.compat.rclpy.timer import Rate, Timer
from gazelle.compat.rclpy.type_description_service import (
    START_TYPE_DESCRIPTION_SERVICE_PARAM,
    offer_type_descriptions,
)
from gazelle.compat.rclpy.work import Once, Work
from gazelle.errors import NotFoundError as NodeNameNonExistentError
from gazelle.graph import ServiceRefusedError
from gazelle.graph.names import resolve
from gazelle.graph.ros2_node_parameters import NodeParameters, ParameterPolicy
from gazelle.interfaces import message_type

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

_T = TypeVar("_T")
_S_TO_NS = 1_000_000_000
_SIM_TIME = "use_sim_time"


class Node(ParameterHolder, GraphQueries):
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
        from gazelle.compat.rclpy.arguments import RosArguments, parse_ros_arguments

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
                offer_logger_levels(self)
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
        self._rcl_uninitialized = {}
        self._rcl_pre_callbacks, self._rcl_set_callbacks, self._rcl_post_callbacks = [], [], []
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
