"""An element of a launch file, whichever way it is written."""

from __future__ import annotations

from typing import Any, TypeVar

from gazelle.diagnostics import SourceSpan

__all__ = ["Entity", "TargetType"]

TargetType = TypeVar("TargetType")


class Entity:
    """An element: a kind, attributes and children.

    Attributes:
        span: where it is written, None when that is not known.
    """

    span: SourceSpan | None = None

    @property
    def type_name(self) -> str:
        """Its kind, such as ``node``."""
        raise NotImplementedError

    @property
    def parent(self) -> Entity | None:
        """The element around it."""
        raise NotImplementedError

    @property
    def children(self) -> list[Any]:
        """The elements in it."""
        raise NotImplementedError

    def get_attr(
        self,
        name: str,
        *,
        data_type: Any = str,
        optional: bool = False,
        can_be_str: bool = True,
    ) -> Any:
        """Return an attribute.

        Args:
            name: of the attribute.
            data_type: one of `launch.utilities.type_utils.AllowedTypesTuple`, ``List[Entity]``
                for the elements with this name, None to read the text as YAML.
            optional: return None when it is not there.
            can_be_str: a text that does not fit is returned as it is, for its substitutions.

        Raises:
            AttributeError: it is not there.
            TypeError: it has another type.
            ValueError: its text does not fit the type.
        """
        raise NotImplementedError

    def assert_entity_completely_parsed(self) -> None:
        """Check that somebody asked for every attribute and child.

        Raises:
            ValueError: it has some that its kind does not know.
        """
        raise NotImplementedError
