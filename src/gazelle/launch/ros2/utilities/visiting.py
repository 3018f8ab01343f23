"""Visiting entities and everything they yield."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.user_spans import keep_place

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["visit_all_entities_and_collect_futures"]

_Pair = tuple[LaunchDescriptionEntity, "asyncio.Future[Any]"]


def visit_all_entities_and_collect_futures(
    entity: LaunchDescriptionEntity, context: LaunchContext, pairs: list[_Pair] | None = None
) -> list[_Pair]:
    """Visit an entity, then what it yields, depth first; return what takes time.

    Args:
        entity: the first one.
        context: what the launch knows.
        pairs: a list to add to: what has begun before an entity raised an error stays in it.
    """
    pairs = [] if pairs is None else pairs
    try:
        yielded = entity.visit(context)
        future = entity.get_asyncio_future()
    except Exception as error:
        keep_place(error, getattr(entity, "place", None))
        raise
    if future is not None:
        pairs.append((entity, future))
    for one in yielded or ():
        visit_all_entities_and_collect_futures(one, context, pairs)
    return pairs
