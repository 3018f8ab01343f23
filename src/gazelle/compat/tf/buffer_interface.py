"""What every buffer of tf2_ros can do with objects that have a header."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from gazelle.compat.tf.exceptions import NotImplementedException, TypeException

__all__ = ["BufferInterface", "ConvertRegistration", "TransformRegistration", "convert"]


class TransformRegistration:
    """Functions that transform objects, by class; ``tf2_geometry_msgs`` adds its own."""

    _functions: ClassVar[dict[type, Callable[[Any, Any], Any]]] = {}

    def add(self, key: type, callback: Callable[[Any, Any], Any]) -> None:
        """Let `callback(object, transform)` transform objects of a class."""
        self._functions[key] = callback

    def get(self, key: type) -> Callable[[Any, Any], Any]:
        """Return the function of a class.

        Raises:
            TypeException: there is none.
        """
        if key not in self._functions:
            known = ", ".join(sorted(cls.__name__ for cls in self._functions)) or "none"
            raise TypeException(
                f"Type {key} is not loaded or supported (known: {known}); "
                "import tf2_geometry_msgs for geometry messages"
            )
        return self._functions[key]


class ConvertRegistration:
    """Functions that make one class of another, by way of messages."""

    _to_msg: ClassVar[dict[type, Callable[[Any], Any]]] = {}
    _from_msg: ClassVar[dict[type, Callable[[Any], Any]]] = {}
    _convert: ClassVar[dict[tuple[type, type], Callable[[Any], Any]]] = {}

    def add_from_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Let `callback(message)` make objects of a class."""
        self._from_msg[key] = callback

    def add_to_msg(self, key: type, callback: Callable[[Any], Any]) -> None:
        """Let `callback(object)` make messages of a class."""
        self._to_msg[key] = callback

    def add_convert(self, key: tuple[type, type], callback: Callable[[Any], Any]) -> None:
        """Let `callback(object)` make objects of the second class of the first."""
        self._convert[key] = callback

    def get_from_msg(self, key: type) -> Callable[[Any], Any]:
        """Return the function that makes objects of a class."""
        return _registered(self._from_msg, key)

    def get_to_msg(self, key: type) -> Callable[[Any], Any]:
        """Return the function that makes messages of a class."""
        return _registered(self._to_msg, key)

    def get_convert(self, key: tuple[type, type]) -> Callable[[Any], Any]:
        """Return the function from one class to the other.

        Raises:
            TypeException: there is none.
        """
        if key in self._convert:
            return self._convert[key]
        to_message, from_message = self.get_to_msg(key[0]), self.get_from_msg(key[1])
        return lambda value: from_message(to_message(value))


def convert(a: Any, b_type: type) -> Any:
    """Return an object as another class.

    Raises:
        TypeException: nobody registered how.
    """
    if isinstance(a, b_type):
        return a
    return ConvertRegistration().get_convert((type(a), b_type))(a)


class BufferInterface:
    """What every buffer can do with objects that have a header."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = 0, new_type: Any = None
    ) -> Any:
        """Return an object in another frame at its own time.

        Raises:
            TransformException: the transform is not known.
            TypeException: its class is not registered.
        """
        function = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        moved = function(object_stamped, found)
        return moved if new_type is None else convert(moved, new_type)

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Any,
        fixed_frame: str,
        timeout: Any = 0,
        new_type: Any = None,
    ) -> Any:
        """Return an object in another frame at another time, by way of a fixed frame.

        Raises:
            TransformException: the transform is not known.
            TypeException: its class is not registered.
        """
        function = self.registration.get(type(object_stamped))
        header = object_stamped.header
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        moved = function(object_stamped, found)
        return moved if new_type is None else convert(moved, new_type)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = 0
    ) -> Any:
        """Return a transform; every buffer has its own way."""
        raise NotImplementedException("this buffer has no lookup_transform")

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = 0,
    ) -> Any:
        """Return a transform between two times; every buffer has its own way."""
        raise NotImplementedException("this buffer has no lookup_transform_full")

    def can_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = 0
    ) -> Any:
        """Return whether a transform is known; every buffer has its own way."""
        raise NotImplementedException("this buffer has no can_transform")

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = 0,
    ) -> Any:
        """Return whether a transform between two times is known; every buffer has its own way."""
        raise NotImplementedException("this buffer has no can_transform_full")


def _registered(table: dict[type, Callable[[Any], Any]], key: type) -> Callable[[Any], Any]:
    if key not in table:
        known = ", ".join(sorted(cls.__name__ for cls in table)) or "none"
        raise TypeException(f"Type {key} is not loaded or supported (known: {known})")
    return table[key]
