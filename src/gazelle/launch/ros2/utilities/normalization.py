"""Arguments, substitutions and entities in one form, however they are written."""

from __future__ import annotations

import asyncio
import inspect
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity, SomeEntitiesType
from gazelle.launch.ros2.substitution import Substitution, TextSubstitution
from gazelle.launch.ros2.user_spans import keep_span

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "ensure_argument_type",
    "is_a",
    "is_a_subclass",
    "isclassinstance",
    "normalize_to_list_of_entities",
    "normalize_to_list_of_substitutions",
    "perform_substitutions",
    "visit_all_entities_and_collect_futures",
]

_Pair = tuple[LaunchDescriptionEntity, "asyncio.Future[Any]"]


def isclassinstance(obj: Any) -> bool:
    """Return whether something has a class."""
    return hasattr(obj, "__class__")


def is_a(obj: Any, entity_type: Any) -> bool:
    """Return whether something is an instance of a class.

    Raises:
        RuntimeError: `entity_type` is no class.
    """
    if not inspect.isclass(entity_type):
        raise RuntimeError(f"entity_type '{entity_type}' is not a class")
    return isinstance(obj, entity_type)


def is_a_subclass(obj: Any, entity_type: Any) -> bool:
    """Return whether something is an instance or a subclass of a class."""
    if is_a(obj, entity_type):
        return True
    return inspect.isclass(obj) and issubclass(obj, entity_type)


def ensure_argument_type(
    argument: Any,
    types: type | Iterable[type],
    argument_name: str,
    caller: str | None = None,
) -> None:
    """Check the type of an argument.

    Raises:
        TypeError: it is none of `types`; the message names argument and caller.
    """
    allowed = [types] if isinstance(types, type) else list(types)
    if any(isinstance(argument, one) for one in allowed):
        return
    who = "E" if caller is None else f"'{caller}' e"
    known = ", ".join(str(one) for one in allowed)
    raise TypeError(
        f"{who}xpected '{argument_name}' to be one of [{known}], "
        f"but got '{argument}' of type '{type(argument)}'"
    )


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
        keep_span(error, getattr(entity, "span", None))
        raise
    if future is not None:
        pairs.append((entity, future))
    for one in yielded or ():
        visit_all_entities_and_collect_futures(one, context, pairs)
    return pairs


def normalize_to_list_of_substitutions(subs: Any) -> list[Substitution]:
    """Return a list of substitutions for a text, a substitution or several of both.

    Raises:
        TypeError: something is neither text nor substitution.
    """
    if isinstance(subs, str | Substitution) or not isinstance(subs, Iterable):
        return [_substitution(subs)]
    return [_substitution(item) for item in subs]


def normalize_to_list_of_entities(
    entities: Iterable[SomeEntitiesType],
) -> list[LaunchDescriptionEntity]:
    """Return one list for entities and lists of them."""
    flat: list[LaunchDescriptionEntity] = []
    for entity in entities:
        flat += [entity] if isinstance(entity, LaunchDescriptionEntity) else list(entity)
    return flat


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    """Return the joined texts of substitutions."""
    return "".join(context.perform_substitution(sub) for sub in subs)


def _substitution(item: Any) -> Substitution:
    if isinstance(item, Substitution):
        return item
    if isinstance(item, str):
        return TextSubstitution(text=item)
    text = str(item).lower() if isinstance(item, bool) else str(item)
    hint = f" Write '{text}'." if isinstance(item, bool | int | float) else ""
    raise TypeError(
        f"Failed to normalize given item of type '{type(item)}', "
        f"when only 'str' or 'launch.Substitution' were expected.{hint}"
    )
