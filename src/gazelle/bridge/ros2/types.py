"""Types on both sides, and what is told of those that one side lacks."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from gazelle.errors import GazelleError, NotFoundError
from gazelle.graph.errors import coded
from gazelle.graph.type_support import hash_of
from gazelle.interfaces import (
    RosVersion,
    add_package,
    definition,
    message_type,
    service_type,
)

__all__ = ["MessageKind", "ServiceKind", "TypeBook"]

_HASH = "RIHS01_"
_PARTS = ("msg", "srv", "action")
_T = TypeVar("_T", "MessageKind", "ServiceKind")


class MessageKind(NamedTuple):
    """A message type as a mirror publishes it.

    Attributes:
        type_name: ``pkg/msg/Name``.
        message_class: its class.
        reliable: whether slow subscriptions are waited for.
    """

    type_name: str
    message_class: Any
    reliable: bool


class ServiceKind(NamedTuple):
    """A service type.

    Attributes:
        type_name: ``pkg/srv/Name``.
        service_class: as the graph knows it.
    """

    type_name: str
    service_class: Any


class TypeBook:
    """Looks types up and tells once of each that does not get across."""

    def __init__(
        self, notice: Callable[[str], None], prefixes: Iterable[str] = (), distro: str = ""
    ) -> None:
        """Know nothing yet.

        Args:
            notice: told of what does not get across.
            prefixes: where ROS keeps ``share/<package>/msg``.
            distro: ``ROS_DISTRO``, empty when it is not known.
        """
        self._notice = notice
        self._told: set[str] = set()
        self._missing: set[str] = set()
        self._prefixes = tuple(prefixes)
        self._distro = distro

    def message(self, name: str, where: str, *, reliable: bool) -> MessageKind | None:
        """Return a message type, None when the graph does not know it."""
        found = self._found(message_type, name, where)
        return None if found is None else MessageKind(name, found, reliable)

    def service(self, name: str, where: str) -> ServiceKind | None:
        """Return a service type, None when the graph does not know it."""
        found = self._found(service_type, name, where)
        return None if found is None else ServiceKind(name, found)

    def is_missing(self, name: str) -> bool:
        """Return whether ROS was found to lack a type."""
        return name in self._missing

    def miss(self, name: str, where: str, error: str) -> None:
        """Learn that ROS lacks a type; tells once for each package."""
        self._missing.add(name)
        package = name.split("/", maxsplit=1)[0]
        if package in self._told:
            return
        self._told.add(package)
        if not _is_of_ros2(name):
            text = f"{where} cannot go to ROS 2: its type {name} exists only in ROS 1"
            self._notice(f"{text}; neither can other types of {package} that ROS 2 does not have")
            return
        distro = self._distro or "<distro>"
        text = f"{where} does not go to ROS 2, whose Python lacks its type {name}: {error}"
        fix = (
            f"apt install ros-{distro}-{package.replace('_', '-')}, or source the workspace that "
            f"builds {package}; then start the bridge again"
        )
        self._notice(coded("bridge.type-missing", text, fix=fix))

    def agrees(self, name: str, where: str, type_hash: str) -> bool:
        """Return whether both sides define a type alike; if not, it does not cross.

        Args:
            name: the type.
            where: what has it.
            type_hash: of ROS's definition, empty when it is not known; then they agree.
        """
        own = hash_of(name)
        if not (type_hash.startswith(_HASH) and own.startswith(_HASH)) or type_hash == own:
            return True
        self._missing.add(name)
        text = (
            f"{where} does not cross the bridge: ROS 2 defines its type {name} otherwise "
            f"({type_hash[:15]}… there, {own[:15]}… here)"
        )
        self._tell(name, coded("bridge.type-differs", text))
        return False

    def _found(self, look_up: Callable[[str], Any], name: str, where: str) -> Any:
        try:
            return self._looked_up(look_up, name)
        except NotFoundError:
            fix = "start the bridge where the package that defines it is found"
            text = f"{where} does not cross the bridge: nothing here defines its type {name}"
            self._tell(name, coded("bridge.type-missing", text, fix=fix))
        except GazelleError as error:
            self._tell(name, f"{where} does not cross the bridge: {error}")
        return None

    def _looked_up(self, look_up: Callable[[str], Any], name: str) -> Any:
        try:
            return look_up(name)
        except NotFoundError:
            # ROS has the definitions of what it has built.
            package = name.split("/", maxsplit=1)[0]
            folder = _share_of(package, self._prefixes)
            if folder is None:
                raise
            add_package(package, folder, RosVersion.ROS2)
            return look_up(name)

    def _tell(self, name: str, text: str) -> None:
        if name not in self._told:
            self._told.add(name)
            self._notice(text)


def _share_of(package: str, prefixes: Iterable[str]) -> Path | None:
    for prefix in prefixes:
        folder = Path(prefix) / "share" / package
        if any((folder / part).is_dir() for part in _PARTS):
            return folder
    return None


@lru_cache(maxsize=512)
def _is_of_ros2(name: str) -> bool:
    """Whether ROS 2 has a definition of its own, as far as is known here."""
    package, part, bare = name.split("/")
    wanted = f"{package}/{part}/{bare}_Request" if part == "srv" else name
    try:
        return definition(wanted, RosVersion.ROS2).native
    except GazelleError:
        return True
