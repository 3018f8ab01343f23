"""What message classes of both generations share, and whom they ask for other types."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, ClassVar, Protocol, TypeVar

from gazelle.interfaces.definition import Definition, Field, RosVersion
from gazelle.interfaces.definition_library import Source
from gazelle.rich_display import shown_by

__all__ = ["MessageBase", "Types"]

_T = TypeVar("_T")


class Types(Protocol):
    """Where definitions and classes come from; `gazelle.interfaces.type_store.TypeStore` is one."""

    def definition(self, name: str, ros_version: RosVersion) -> Definition:
        """Return a message's definition by the rules of one generation."""
        ...

    def find_source(
        self, package: str, part: str, name: str, ros_version: RosVersion
    ) -> Source | None:
        """Return the text of a definition of one generation, None when there is none."""
        ...

    def class_of(self, full: str, ros_version: RosVersion) -> type[MessageBase]:
        """Return the class of a message in the form of one generation."""
        ...

    def kept_text(self, name: str, ros_version: RosVersion) -> str:
        """Return the text that came in with a type, empty when none did."""
        ...

    def remembered(self, key: Hashable, make: Callable[[], _T]) -> _T:
        """Return what `make` gives, made once for as long as definitions stay what they are."""
        ...

    def rebuilt(self, full: str, ros_version: RosVersion, values: list[Any]) -> MessageBase:
        """Return a message with these values of its fields, as `copy` and `pickle` ask for it."""
        ...


@shown_by("messages:message_bundle")
class MessageBase:
    """Base of all message classes.

    Attributes:
        TYPE_NAME: full name, such as ``sensor_msgs/msg/LaserScan``.
        FIELDS: fields in the order of the definition.
    """

    # Codecs are compiled on first use and live as long as their class. Names of definitions
    # begin with a letter, so nothing that a type defines can be in the way of them.
    __slots__ = ("__weakref__",)
    TYPE_NAME: ClassVar[str] = ""
    FIELDS: ClassVar[tuple[Field, ...]] = ()
    DEFINITION: ClassVar[Definition]
    GENERATION: ClassVar[RosVersion]
    _names: ClassVar[tuple[str, ...]] = ()
    _types: ClassVar[Types]
    _cdr_writer: ClassVar[Any] = None
    _cdr_reader: ClassVar[Any] = None
    _big_reader: ClassVar[Any] = None
    _ros1_writer: ClassVar[Any] = None
    _ros1_reader: ClassVar[Any] = None

    def __reduce__(self) -> tuple[Any, ...]:
        values = [getattr(self, name) for name in self._names]
        return self._types.rebuilt, (self.TYPE_NAME, self.GENERATION, values)
