"""Types by name: definitions, and the classes and services made of them.

A process has one store that everybody uses who names none, `default_types`. Another one lies over
it, or over none: what it is taught counts in it alone, and what it is not taught is answered from
below, by the very same classes.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Hashable
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar

from gazelle.errors import GazelleError
from gazelle.interfaces import definition_lookup, ros1_md5sum
from gazelle.interfaces.definition import Definition, RosVersion
from gazelle.interfaces.definition_library import Library, Source
from gazelle.interfaces.message import Message, make_message_class, recursion
from gazelle.interfaces.message_base import MessageBase
from gazelle.interfaces.ros1_message import AnyMsg, Ros1Message, make_ros1_class
from gazelle.interfaces.services import (
    ActionType,
    Ros1Service,
    ServiceType,
    make_ros1_service,
    ros2_action,
    ros2_service,
)
from gazelle.interfaces.type_names import canonical_name, split_name

__all__ = ["TypeStore", "default_types", "types_of"]

_T = TypeVar("_T")
# What others name is remembered too: there is no end of names.
_MAX = 16_384
_RENAMED = {"roslib/msg/Header": "std_msgs/msg/Header", "roslib/msg/Log": "rosgraph_msgs/msg/Log"}


class TypeStore:
    """Definitions, classes, codecs and texts of types, of both generations.

    Codecs live at their classes. Any thread may use it.

    Attributes:
        taught_by: what has taught it, by names that those who teach choose; see `reset`.
    """

    def __init__(self, below: TypeStore | None = None) -> None:
        """Begin with what is below.

        Args:
            below: answers for the types that this one is not taught; Gazelle's own when None.
        """
        self.taught_by: set[str] = set()
        self._below = below
        self._library: Library = Library(None if below is None else below._library)
        self._lock = threading.RLock()
        self._revision = 0
        self._messages: dict[str, type[Message]] = {}
        self._ros1_messages: dict[str, type[Ros1Message]] = {}
        self._services: dict[str, type[Ros1Service]] = {}
        self._memory: tuple[int, dict[Hashable, Any]] = (0, {})
        self._texts: Any = None

    @property
    def revision(self) -> int:
        """A number that is raised whenever definitions may have changed."""
        return self._library.revision

    def add_package(
        self, name: str, path: Path | str, ros_version: RosVersion | None = None
    ) -> None:
        """Let a user's own package define types; its msg/, srv/ and action/ are read when needed.

        Args:
            name: the package's name.
            path: its folder.
            ros_version: which ROS the files are written for; read from ``package.xml`` when None.

        Raises:
            NotFoundError: there is no such folder.
        """
        self._library.add_package(name, path, ros_version)

    def add_search_path(self, folder: Path | str) -> tuple[str, ...]:
        """Add every package with definitions directly under a folder; return their names."""
        return self._library.add_search_path(folder)

    def add_text(self, name: str, ros_version: RosVersion, text: str) -> None:
        """Let a text define one message.

        Args:
            name: ``pkg/Name`` or ``pkg/msg/Name``.
            ros_version: whose rules it follows.
            text: without the texts of what the message contains.

        Raises:
            NotFoundError: the name is not written as a type's name.
        """
        package, _, bare = split_name(name)
        self._library.add_text(package, bare, ros_version, text)

    def reset(self) -> None:
        """Forget all that was taught."""
        self._library.clear()
        self._texts = None
        self.taught_by.clear()

    def look_again(self) -> None:
        """Forget what was made of definitions: files and variables of the machine have changed."""
        self._memory = (self._library.revision, {})

    def remembered(self, key: Hashable, make: Callable[[], _T]) -> _T:
        """Return what `make` gives, made once for as long as definitions stay what they are."""
        revision, memory = self._memory
        if revision != self._library.revision or len(memory) >= _MAX:
            memory = {}
            self._memory = (self._library.revision, memory)
        found: _T | None = memory.get(key)
        if found is None:
            found = memory[key] = make()
        return found

    def definition(self, name: str, ros_version: RosVersion) -> Definition:
        """Return a message's definition by the rules of one generation.

        One written for that generation comes first; else the other generation's is translated.

        Args:
            name: full name; parts of services and actions are ``pkg/srv/Name_Request`` and so on.
            ros_version: whose rules.

        Raises:
            NotFoundError: nothing defines it.
            UserFileError: its text has errors.
        """
        if self._below is not None and not self._library.adds_to(split_name(name)[0]):
            return self._below.definition(name, ros_version)
        key = ("definition", name, ros_version)
        return self.remembered(
            key, lambda: definition_lookup.read_definition(self._library, name, ros_version)
        )

    def find_source(
        self, package: str, part: str, name: str, ros_version: RosVersion
    ) -> Source | None:
        """Return the text of a definition of one generation, None when there is none.

        A user's own package comes before the data of Gazelle.

        Args:
            package: such as ``std_msgs``.
            part: ``msg``, ``srv`` or ``action``.
            name: such as ``Header``.
            ros_version: which ROS it must be written for.

        Raises:
            UserFileError: the file is there and cannot be read.
        """
        return self._library.find_source(package, part, name, ros_version)

    def exists(self, name: str) -> bool:
        """Return whether something defines this message, without reading its text."""
        return definition_lookup.exists(self._library, name)

    def known_types(self, part: str = "msg", package: str = "") -> tuple[str, ...]:
        """Return the full names of all types of a part (``msg``, ``srv``, ``action``), sorted.

        Messages that ROS 1 makes from actions (``FibonacciActionGoal`` …) are in the list too.
        """
        return definition_lookup.known_types(self._library, part, package)

    def message_type(self, name: str) -> type[Message]:
        """Return the class of a message in the form of ROS 2; made on the first call.

        Args:
            name: ``sensor_msgs/msg/LaserScan`` or ``sensor_msgs/LaserScan``.

        Raises:
            NotFoundError: nothing defines it.
            UserFileError: its definition has errors.
        """
        found = self._messages.get(name)
        if found is not None and self._revision == self._library.revision:
            return found
        full = canonical_name(name)
        with self._lock:
            self._forget_changed()
            found = self._messages[name] = self._message(full, ())
            return found

    def ros1_message_type(self, name: str) -> type[Ros1Message]:
        """Return the class of a message in the form of ROS 1; made on the first call.

        Args:
            name: ``sensor_msgs/LaserScan`` or ``sensor_msgs/msg/LaserScan``; ``*`` is `AnyMsg`.

        Raises:
            NotFoundError: nothing defines it.
            UserFileError: its definition has errors.
        """
        if name == "*":
            return AnyMsg
        full = canonical_name("std_msgs/Header" if name == "Header" else name)
        return self._ros1_class(_RENAMED.get(full, full))

    def class_of(self, full: str, ros_version: RosVersion) -> type[MessageBase]:
        """Return the class of a message in the form of one generation.

        Args:
            full: full name; parts of services are ``pkg/srv/Name_Request``.
            ros_version: whose form.

        Raises:
            NotFoundError: nothing defines it.
            UserFileError: its definition has errors.
        """
        if ros_version is RosVersion.ROS1:
            return self._ros1_class(full)
        return self.message_type(full)

    def service_type(self, name: str) -> ServiceType:
        """Return a service in the form of ROS 2.

        Args:
            name: ``std_srvs/srv/SetBool`` or ``std_srvs/SetBool``.

        Raises:
            NotFoundError: nothing defines it.
            UserFileError: its definition has errors.
        """
        return ros2_service(self, canonical_name(name, "srv"))

    def action_type(self, name: str) -> ActionType:
        """Return an action in the form of ROS 2.

        Args:
            name: ``example_interfaces/action/Fibonacci`` or ``example_interfaces/Fibonacci``.

        Raises:
            NotFoundError: nothing defines it.
            UserFileError: its definition has errors.
        """
        return ros2_action(self, canonical_name(name, "action"))

    def ros1_service_type(self, name: str) -> type[Ros1Service]:
        """Return a service class in the form of ROS 1.

        It has `_type`, `_md5sum`, `_request_class` and `_response_class`, as genpy's classes do.

        Args:
            name: ``std_srvs/SetBool`` or ``std_srvs/srv/SetBool``.

        Raises:
            NotFoundError: nothing defines it.
            UserFileError: its definition has errors.
        """
        full = canonical_name(name, "srv")
        request, response = (self._ros1_class(full + end) for end in ("_Request", "_Response"))
        with self._lock:
            found = self._services.get(full)
            if found is None or found._request_class is not request:
                found = make_ros1_service(self, full, request, response)
                self._services[full] = found
            return found

    def keep_text(self, name: str, ros_version: RosVersion, text: str) -> bool:
        """Keep a whole text that came in, when it means what is known here; return whether it does.

        Args:
            name: ``pkg/Name`` or ``pkg/msg/Name``.
            ros_version: whose rules it follows.
            text: with the texts of all that the message contains.
        """
        from gazelle.interfaces.full_definition_text import KeptTexts

        with self._lock:
            if self._texts is None:
                self._texts = KeptTexts(self)
            return bool(self._texts.keep(name, ros_version, text))

    def kept_text(self, name: str, ros_version: RosVersion) -> str:
        """Return the text that came in with a type, empty when none did or the type has changed."""
        kept = self._texts
        found = "" if kept is None else kept.find(name, ros_version)
        if found or self._below is None or not self._inherits(canonical_name(name), ros_version):
            return str(found)
        return self._below.kept_text(name, ros_version)

    def md5sum(self, name: str) -> str:
        """Return the MD5 sum of a message in ROS 1.

        Args:
            name: ``sensor_msgs/LaserScan`` or the full name.

        Raises:
            NotFoundError: nothing defines it.
        """
        return ros1_md5sum.md5sum(self, name)

    def service_md5sum(self, name: str) -> str:
        """Return the MD5 sum of a service in ROS 1: of request and response, one after the other.

        Raises:
            NotFoundError: nothing defines it.
        """
        return ros1_md5sum.service_md5sum(self, name)

    def show_message(self, name: str, indent: str = "") -> str:
        """Return the fields of a message, nested ones indented, as ``rosmsg show`` prints them.

        Raises:
            NotFoundError: nothing defines it.
        """
        return ros1_md5sum.show_message(self, name, indent)

    def show_service(self, name: str) -> str:
        """Return request and response of a service, as ``rossrv show`` prints them.

        Raises:
            NotFoundError: nothing defines it.
        """
        return ros1_md5sum.show_service(self, name)

    def ros1_definition(self, name: str) -> str:
        """Return a message's text and, behind rules of ``=``, those of all it contains.

        The layout, to the byte, is that of genpy's ``_full_text``.

        Raises:
            NotFoundError: nothing defines it.
        """
        from gazelle.interfaces.full_definition_text import ros1_definition

        return ros1_definition(self, name)

    def ros2_definition(self, name: str) -> str:
        """Return a message's text and those of all it contains, as rosbag2's ``ros2msg`` schemas.

        Raises:
            NotFoundError: nothing defines it.
        """
        from gazelle.interfaces.full_definition_text import ros2_definition

        return ros2_definition(self, name)

    def type_hash(self, name: str, part: str = "msg") -> str:
        """Return the REP-2016 hash of a message, service or action in the form of ROS 2.

        Args:
            name: ``std_msgs/String``, ``std_srvs/srv/SetBool`` …
            part: what a name of two words means: ``msg``, ``srv`` or ``action``.

        Raises:
            NotFoundError: nothing defines it.
        """
        from gazelle.interfaces.rihs01 import type_hash

        return type_hash(self, name, part)

    def type_description(self, name: str) -> dict[str, Any]:
        """Return what is hashed: a ``type_description_interfaces/msg/TypeDescription``, in dicts.

        Args:
            name: full name of a message, service or action, or of a part of these two.

        Raises:
            NotFoundError: nothing defines it.
        """
        from gazelle.interfaces.rihs01 import type_description

        return type_description(self, name)

    def time_keys(self, now_ns: int, ros_version: RosVersion) -> dict[str, Any]:
        """Return what ``now`` and ``auto`` stand for in `fill`: a time and a header of now."""
        from gazelle.interfaces.message_dict import time_keys

        return time_keys(self, now_ns, ros_version)

    def rebuilt(self, full: str, ros_version: RosVersion, values: list[Any]) -> MessageBase:
        """Return a message with these values of its fields, as `copy` and `pickle` ask for it."""
        made = self.class_of(full, ros_version)()
        for name, value in zip(made._names, values, strict=True):
            setattr(made, name, value)
        return made

    def __reduce__(self) -> str | tuple[Any, ...]:
        if self is _DEFAULT:
            return "_DEFAULT"
        return _taught, (self._below, self._library.packages(), self._library.texts())

    def _forget_changed(self) -> None:
        """Drop classes of definitions that something newly added changes."""
        if self._revision == self._library.revision:
            return
        self._revision = self._library.revision
        for classes in (self._messages, self._ros1_messages):
            for name, cls in list(classes.items()):
                if cls._types is not self or not self._is_current(cls.DEFINITION):
                    del classes[name]

    def _is_current(self, known: Definition) -> bool:
        try:
            return self.definition(known.name, known.ros_version) == known
        except GazelleError:
            return False

    def _inherits(self, full: str, ros_version: RosVersion) -> bool:
        """Return whether a message and all that it contains are as they are below."""
        left, seen = [full], {full}
        while left:
            name = left.pop()
            package, _, bare = split_name(name)
            if self._library.defines(package, bare):
                return False
            fields = self.definition(name, ros_version).fields
            new = {item.type.base for item in fields if item.type.is_message} - seen
            left += new
            seen |= new
        return True

    def _message(self, full: str, above: tuple[str, ...]) -> type[Message]:
        found = self._messages.get(full)
        if found is not None:
            return found
        if full in above:
            raise recursion(full, above)
        source = self.definition(full, RosVersion.ROS2)
        if self._below is not None and self._inherits(full, RosVersion.ROS2):
            found = self._below.message_type(full)
        else:
            inside = (*above, full)
            found = make_message_class(source, self, lambda name: self._message(name, inside))
        self._messages[full] = found
        return found

    def _ros1_class(self, full: str) -> type[Ros1Message]:
        found = self._ros1_messages.get(full)
        if found is not None and self._revision == self._library.revision:
            return found
        with self._lock:
            self._forget_changed()
            found = self._ros1_messages.get(full)
            if found is not None:
                return found
            source = self.definition(full, RosVersion.ROS1)
            if self._below is not None and self._inherits(full, RosVersion.ROS1):
                found = self._below._ros1_class(full)
            else:
                self.message_type(full)  # finds circles before they are followed here
                found = make_ros1_class(source, self, self._ros1_class)
            self._ros1_messages[full] = found
            return found


_DEFAULT = TypeStore()


def default_types() -> TypeStore:
    """Return the process's store, which everybody uses who names none."""
    return _DEFAULT


def types_of(message: object) -> TypeStore:
    """Return the store that a message or its class is of, the process's where it is of none."""
    found = getattr(message, "_types", None)
    return found if isinstance(found, TypeStore) else _DEFAULT


@lru_cache(maxsize=64)
def _taught(
    below: TypeStore | None,
    packages: tuple[tuple[str, Path, RosVersion | None], ...],
    texts: tuple[tuple[str, str, RosVersion, str], ...],
) -> TypeStore:
    """Return a store that was taught so; one for each content, so that classes stay the same."""
    made = TypeStore(below)
    for name, folder, ros_version in packages:
        made.add_package(name, folder, ros_version)
    for package, bare, ros_version, text in texts:
        made.add_text(f"{package}/{bare}", ros_version, text)
    return made
