"""How types are named: ``pkg/Name``, ``pkg/msg/Name`` and what they mean to each other."""

from __future__ import annotations

from gazelle.errors import NotFoundError

__all__ = ["canonical_name", "ros1_name", "split_name"]


def split_name(name: str, part: str = "msg") -> tuple[str, str, str]:
    """Return package, part and bare name of ``pkg/Name`` or ``pkg/part/Name``.

    Raises:
        NotFoundError: the text is not written as a type's name.
    """
    words = name.strip("/").split("/")
    if len(words) == 2 and all(words):
        return words[0], part, words[1]
    if len(words) == 3 and all(words) and words[1] in ("msg", "srv", "action"):
        return words[0], words[1], words[2]
    raise NotFoundError(
        "type", name, hint="a type is written package/Name or package/msg/Name (srv, action)"
    )


def canonical_name(name: str, part: str = "msg") -> str:
    """Return ``pkg/msg/Name`` for that or for ``pkg/Name``.

    Raises:
        NotFoundError: the text is not written as a type's name.
    """
    return "/".join(split_name(name, part))


def ros1_name(full: str) -> str:
    """Return ``pkg/Name`` of a full name; ``pkg/srv/Name_Request`` is ``pkg/NameRequest``."""
    package, part, name = split_name(full)
    if part == "srv":
        for suffix in ("_Request", "_Response"):
            if name.endswith(suffix):
                name = name.removesuffix(suffix) + suffix[1:]
    return f"{package}/{name}"
