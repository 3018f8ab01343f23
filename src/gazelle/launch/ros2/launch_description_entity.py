"""What a launch description is made of."""

from __future__ import annotations

import asyncio
import collections.abc
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import SourceSpan
from gazelle.launch.ros2.user_spans import calling_span

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "LaunchDescriptionEntity",
    "SomeActionsType",
    "SomeActionsType_types_tuple",
    "SomeEntitiesType",
    "SomeEntitiesType_types_tuple",
]


class LaunchDescriptionEntity:
    """Something that launch visits: an action, or a description with more of them.

    Attributes:
        span: the user's line that made it, None when no file did.
    """

    span: SourceSpan | None

    def __new__(cls, *_args: Any, **_kwargs: Any) -> LaunchDescriptionEntity:
        """Make it and note the user's line that did so, for messages."""
        instance = super().__new__(cls)
        instance.span = calling_span()
        return instance

    def describe(self) -> str:
        """Return a text for people."""
        raise NotImplementedError

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return what is visited with it in any case."""
        return []

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return what may be visited with it, each list with its condition in words."""
        return []

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Do what it stands for and return what is to be visited next."""
        return None

    def get_asyncio_future(self) -> asyncio.Future[Any] | None:
        """Return what is done when it has ended, None for what takes no time."""
        return None


SomeEntitiesType = LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity]
SomeEntitiesType_types_tuple = (LaunchDescriptionEntity, collections.abc.Iterable)
# The names up to Humble.
SomeActionsType = SomeEntitiesType
SomeActionsType_types_tuple = SomeEntitiesType_types_tuple
