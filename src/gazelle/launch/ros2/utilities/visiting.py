"""Visiting entities and everything they yield."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.entity import LaunchDescriptionEntity
from gazelle.launch.ros2.place import keep_place

if TYPE_CHECKING:
    from gazelle.launch.ros2.context import LaunchContext

__all__ = ["visit_all_entities_and_collect_futures"]

_Pair = tuple[LaunchDescriptionEntity, "asyncio.Future[Any]"]


def visit_all_entities_and_collect_futures(
    entity: LaunchDescriptionEntity, context: LaunchContext
) -> list[_Pair]:
    """Visit an entity, then what it yields, depth first; return what takes time."""
    try:
        yielded = entity.visit(context)
        future = entity.get_asyncio_future()
    except Exception as error:
        keep_place(error, getattr(entity, "place", None))
        raise
    pairs: list[_Pair] = [] if future is None else [(entity, future)]
    for one in yielded or ():
        pairs += visit_all_entities_and_collect_futures(one, context)
    return pairs
