"""Finds links, joints, sensors and models by the names people use."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.diagnostics.suggestions import nearest_names
from gazelle.errors import NotFoundError

__all__ = ["full_name"]


def full_name(kind: str, name: str, existing: Iterable[str]) -> str:
    """Return the one full name (``model::part``) that `name` means.

    A name without its model is enough while it is unique.

    Raises:
        NotFoundError: there is none, or several models have it; the message lists the nearest
            names or all that fit.
    """
    names = tuple(existing)
    if name in names:
        return name
    fitting = [item for item in names if item.endswith(f"::{name}")]
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        hint = "several have this name: " + ", ".join(f"'{item}'" for item in fitting)
        raise NotFoundError(kind, name, hint=hint)
    by_last = {item.split("::", 1)[-1]: item for item in names}
    nearest = nearest_names(name, [*by_last, *names])
    hint = "" if nearest else "there are: " + ", ".join(f"'{item}'" for item in names[:12])
    raise NotFoundError(kind, name, nearest=nearest, hint=hint)
