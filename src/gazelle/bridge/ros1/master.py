"""The master of ROS 1, for machines where none runs: its API over a registry.

Source: http://wiki.ros.org/ROS/Master_API. Answers are (code, text, value) with code 1 for
success, 0 for failure and -1 for a wrong call.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from gazelle.bridge.ros1.master_parameters import ParameterApi
from gazelle.bridge.ros1.master_registry import Registry, Replaced
from gazelle.bridge.ros1.xmlrpc_call import RemoteError, call
from gazelle.graph import ANY_TYPE, ParameterStore
from gazelle.graph.names import is_legal, resolve

__all__ = ["MASTER_NAME", "Answer", "Master"]

MASTER_NAME = "/master"
_WORKERS = 8
_TELL_S = 3.0
_REPLACED = "new node registered with same name"

Answer = tuple[int, str, Any]


class Master:
    """Keeps registrations, answers for them and tells nodes what changes.

    Attributes:
        registry: what is registered.
        methods: Master API and Parameter Server API by name.
    """

    def __init__(self, parameters: ParameterStore, on_change: Callable[[], None]) -> None:
        """Start with nothing registered.

        Args:
            parameters: the store that is the parameter server.
            on_change: called after every registration.
        """
        self.registry = Registry()
        self.uri = ""
        self._on_change = on_change
        self._workers = ThreadPoolExecutor(_WORKERS, thread_name_prefix="ros1 master")
        self._told: set[tuple[str, str]] = set()
        self._lock = threading.Lock()
        self._parameters = ParameterApi(parameters, self.registry, self._later, self._replace)
        self.methods: dict[str, Callable[..., Answer]] = {
            "getPid": self._pid,
            "getPublishedTopics": self._published_topics,
            "getSystemState": self._system_state,
            "getTopicTypes": self._topic_types,
            "getUri": self._uri,
            "lookupNode": self._lookup_node,
            "lookupService": self._lookup_service,
            "registerPublisher": self._register_publisher,
            "registerService": self._register_service,
            "registerSubscriber": self._register_subscriber,
            "unregisterPublisher": self._unregister_publisher,
            "unregisterService": self._unregister_service,
            "unregisterSubscriber": self._unregister_subscriber,
            **self._parameters.methods,
        }

    def close(self) -> None:
        """Tell nodes nothing more."""
        self._parameters.close()
        self._workers.shutdown(wait=False, cancel_futures=True)

    def _register_publisher(self, node: str, topic: str, type_name: str, uri: str) -> Answer:
        if problem := _problem(node, topic, uri):
            return -1, problem, 0
        topic = resolve(topic)
        self._replace(self.registry.add_publisher(resolve(node), topic, type_name, uri))
        self._tell_subscribers(topic)
        found = self.registry.subscribers(topic)
        return 1, f"Registered [{node}] as publisher of [{topic}]", [uri for _, uri in found]

    def _unregister_publisher(self, node: str, topic: str, uri: str) -> Answer:
        topic = resolve(topic)
        removed = self.registry.remove_publisher(resolve(node), topic, uri)
        if removed:
            self._tell_subscribers(topic)
        return 1, _removal(removed, node, topic), int(removed)

    def _register_subscriber(self, node: str, topic: str, type_name: str, uri: str) -> Answer:
        if problem := _problem(node, topic, uri):
            return -1, problem, 0
        topic = resolve(topic)
        self._replace(self.registry.add_subscriber(resolve(node), topic, type_name, uri))
        self._on_change()
        return 1, f"Subscribed to [{topic}]", self.registry.publisher_uris(topic)

    def _unregister_subscriber(self, node: str, topic: str, uri: str) -> Answer:
        topic = resolve(topic)
        removed = self.registry.remove_subscriber(resolve(node), topic, uri)
        self._on_change()
        return 1, _removal(removed, node, topic), int(removed)

    def _register_service(self, node: str, service: str, service_uri: str, uri: str) -> Answer:
        if problem := _problem(node, service, uri):
            return -1, problem, 0
        if not service_uri.startswith("rosrpc://"):
            return -1, f"ERROR: parameter [service_api] is not a ROSRPC URI: {service_uri}", 0
        service = resolve(service)
        self._replace(self.registry.add_service(resolve(node), service, service_uri, uri))
        self._on_change()
        return 1, f"Registered [{node}] as provider of [{service}]", 1

    def _unregister_service(self, node: str, service: str, service_uri: str) -> Answer:
        service = resolve(service)
        removed = self.registry.remove_service(resolve(node), service, service_uri)
        self._on_change()
        return 1, _removal(removed, node, service), int(removed)

    def _lookup_node(self, _caller: str, node: str) -> Answer:
        uri = self.registry.node_uri(resolve(node))
        return (1, "node api", uri) if uri else (-1, f"unknown node [{node}]", "")

    def _lookup_service(self, _caller: str, service: str) -> Answer:
        uri = self.registry.service_uri(resolve(service))
        return (1, "rosrpc URI", uri) if uri else (-1, "no provider", "")

    def _published_topics(self, _caller: str, below: str) -> Answer:
        state = self.registry.state()
        start = resolve(below).rstrip("/") + "/" if below else "/"
        topics = sorted({topic for _, topic in state.publishers if topic.startswith(start)})
        return 1, "current topics", [[one, state.types.get(one, ANY_TYPE)] for one in topics]

    def _topic_types(self, _caller: str) -> Answer:
        types = self.registry.state().types
        return 1, "current system state", [list(item) for item in sorted(types.items())]

    def _system_state(self, _caller: str) -> Answer:
        state = self.registry.state()
        sides = (state.publishers, state.subscribers, state.services)
        return 1, "current system state", [_by_name(side) for side in sides]

    def _uri(self, _caller: str) -> Answer:
        return 1, "", self.uri

    def _pid(self, _caller: str) -> Answer:
        return 1, "", os.getpid()

    def _replace(self, replaced: Replaced | None) -> None:
        if replaced is not None:
            self._later(replaced.uri, "shutdown", MASTER_NAME, f"[{replaced.node}] {_REPLACED}")

    def _tell_subscribers(self, topic: str) -> None:
        self._on_change()
        for _, uri in self.registry.subscribers(topic):
            with self._lock:
                if (uri, topic) in self._told:
                    continue
                self._told.add((uri, topic))
            self._workers.submit(self._tell_publishers, uri, topic)

    def _tell_publishers(self, uri: str, topic: str) -> None:
        with self._lock:
            self._told.discard((uri, topic))
        self._tell(uri, "publisherUpdate", MASTER_NAME, topic, self.registry.publisher_uris(topic))

    def _later(self, uri: str, method: str, *arguments: Any) -> None:
        self._workers.submit(self._tell, uri, method, *arguments)

    def _tell(self, uri: str, method: str, *arguments: Any) -> None:
        try:
            call(uri, method, *arguments, timeout_s=_TELL_S)
        except RemoteError:
            # A node that has died stays registered until rosnode cleanup, as with the real one.
            return


def _problem(node: str, name: str, uri: str) -> str:
    for kind, text in (("caller_id", node), ("name", name)):
        if not isinstance(text, str) or not text or not is_legal(text):
            return f"ERROR: parameter [{kind}] is not a legal name: {text!r}"
    if not isinstance(uri, str) or not uri.startswith("http://"):
        return f"ERROR: parameter [caller_api] is not an XMLRPC URI: {uri!r}"
    return ""


def _removal(removed: bool, node: str, name: str) -> str:
    return f"Unregistered [{node}] as provider of [{name}]" if removed else "was not registered"


def _by_name(side: frozenset[tuple[str, str]]) -> list[list[Any]]:
    names: dict[str, list[str]] = {}
    for node, name in sorted(side):
        names.setdefault(name, []).append(node)
    return [[name, nodes] for name, nodes in names.items()]
