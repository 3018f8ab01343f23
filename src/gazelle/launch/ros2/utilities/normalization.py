"""Lists out of the many ways to write substitutions and entities."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity, SomeEntitiesType
from gazelle.launch.ros2.substitution import Substitution, TextSubstitution

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "normalize_to_list_of_entities",
    "normalize_to_list_of_substitutions",
    "perform_substitutions",
]


def normalize_to_list_of_substitutions(subs: Any) -> list[Substitution]:
    """Return a list of substitutions for a text, a substitution or several of both.

    Raises:
        TypeError: something is neither text nor substitution.
    """
    if isinstance(subs, str | Substitution) or not isinstance(subs, Iterable):
        return [_substitution(subs)]
    return [_substitution(item) for item in subs]


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
