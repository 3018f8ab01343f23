"""A message's text together with the texts of all that it contains, as bags carry it.

MD5 sums and hashes leave comments out, so one type has many texts. The one that counts is, in
this order: the text that came in with the messages, the file of the user's own package, the file
that is installed on this machine when it means the same, and Gazelle's own, which has no comments.
"""

from __future__ import annotations

import re
from functools import lru_cache

from gazelle.errors import GazelleError
from gazelle.interfaces import library
from gazelle.interfaces.definition import Definition, Generation
from gazelle.interfaces.installed import installed_texts
from gazelle.interfaces.lookup import definition, split_name
from gazelle.interfaces.naming import ros1_name
from gazelle.interfaces.parser import parse_message
from gazelle.interfaces.ros1_digest import md5sum

__all__ = ["keep_text", "kept_text", "ros1_definition", "ros2_definition"]

_RULE = "=" * 80 + "\n"
_PART = re.compile(r"\n=+\s*\nMSG: ")
_kept: dict[tuple[str, Generation], tuple[str, str]] = {}


def ros1_definition(name: str) -> str:
    """Return a message's text and, behind rules of ``=``, those of all it contains.

    The layout, to the byte, is that of genpy's ``_full_text``.

    Raises:
        NotFoundError: nothing defines it.
    """
    full = "/".join(split_name(name))
    kept = kept_text(full, Generation.ROS1)
    if kept:
        return kept
    text = _own_text(full, Generation.ROS1) + "\n"
    for item in _contained(full, []):
        text += f"{_RULE}MSG: {ros1_name(item)}\n{_own_text(item, Generation.ROS1)}\n"
    return text[:-1]


def ros2_definition(name: str) -> str:
    """Return a message's text and those of all it contains, as rosbag2 writes ``ros2msg`` schemas.

    Raises:
        NotFoundError: nothing defines it.
    """
    full = "/".join(split_name(name))
    return kept_text(full, Generation.ROS2) or _ros2_text(full, set())


def keep_text(name: str, generation: Generation, text: str) -> bool:
    """Keep a whole text that came in, when it means what is known here; return whether it does.

    Args:
        name: ``pkg/Name`` or ``pkg/msg/Name``.
        generation: whose rules it follows.
        text: with the texts of all that the message contains.
    """
    full = "/".join(split_name(name))
    known = _kept.get((full, generation))
    if known is not None and known[1] == text:
        return True
    try:
        own = definition(full, generation)
    except GazelleError:
        return False
    if not text.strip() or not _means(own, _PART.split(text, maxsplit=1)[0]):
        return False
    _kept[full, generation] = (_meaning(full, generation), text)
    return True


def kept_text(name: str, generation: Generation) -> str:
    """Return the text that came in with a type, empty when none did or the type has changed."""
    full = "/".join(split_name(name))
    if (full, generation) not in _kept:
        return ""
    meaning, text = _kept[full, generation]
    return text if meaning == _meaning(full, generation) else ""


def _meaning(name: str, generation: Generation) -> str:
    if generation is Generation.ROS1:
        return md5sum(name)
    from gazelle.interfaces.rihs01 import type_hash

    return type_hash(name)


def _ros2_text(name: str, seen: set[str]) -> str:
    """A type's text and, by name, those it contains: depth first, each once (rosbag2_cpp)."""
    text = _own_text(name, Generation.ROS2)
    fields = definition(name, Generation.ROS2).fields
    for base in sorted({item.type.base for item in fields if item.type.is_message}):
        if base not in seen:
            seen.add(base)
            text += f"\n{_RULE}MSG: {ros1_name(base)}\n{_ros2_text(base, seen)}"
    return text


def _own_text(name: str, generation: Generation) -> str:
    return _cached_text(name, generation, library.revision())


@lru_cache(maxsize=1024)
def _cached_text(name: str, generation: Generation, _revision: int) -> str:
    own = definition(name, generation)
    package, part, bare = split_name(name)
    source = library.find_source(package, part, bare, generation)
    if source is not None and not source.file.startswith("<"):
        return source.text
    if part == "msg":
        for text in installed_texts(package, bare, generation):
            if _means(own, text):
                return text
    return own.text + "\n" if own.text else ""


def _means(own: Definition, text: str) -> bool:
    """Whether a text defines the same as a definition: what sums and hashes are made of."""
    try:
        other = parse_message(text, own.name, own.generation, diagnostics=None, file="")
    except (GazelleError, ValueError):
        return False
    kinds = [(item.name, item.type) for item in own.fields]
    if [(item.name, item.type) for item in other.fields] != kinds:
        return False
    if own.generation is Generation.ROS2:
        return True
    constants = [(item.type, item.name, item.text) for item in own.constants]
    return [(item.type, item.name, item.text) for item in other.constants] == constants


def _contained(name: str, found: list[str]) -> list[str]:
    """All messages inside, each once, in the order of genmsg: depth first."""
    for item in definition(name, Generation.ROS1).fields:
        base = item.type.base
        if item.type.is_message and base not in found:
            found.append(base)
            _contained(base, found)
    return found
