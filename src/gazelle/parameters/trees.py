"""Trees of parameters and lists of their leaves.

A branch without anything below it is a leaf whose value is an empty dict: it was written, so it is
told of and kept. Who offers values, of which ROS has no empty branch, leaves such leaves out by
`values_only`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

__all__ = ["flattened", "leaves_at", "nested", "values_only"]


def nested(tree: Mapping[str, Any]) -> dict[str, Any]:
    """Return a tree whose keys with dots or slashes became branches.

    What is written twice counts as the last one says, branches hold what all of them say.
    """
    result: dict[str, Any] = {}
    for key, value in tree.items():
        *path, last = str(key).replace("/", ".").strip(".").split(".")
        branch = result
        for word in path:
            branch = _branch(branch, word)
        if isinstance(value, Mapping):
            _merge(_branch(branch, last), nested(value))
        else:
            branch[last] = value
    return result


def flattened(
    tree: Mapping[str, Any], prefix: str = "", *, separator: str = "."
) -> Iterator[tuple[str, Any]]:
    """Yield every leaf of a tree by its name; empty branches are leaves.

    Args:
        tree: keys are taken as they are, so that one with dots stays one part.
        prefix: stands before every name, with its separator.
        separator: between the parts: ROS 2's dot, or ROS 1's slash.
    """
    for key, value in tree.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping) and value:
            yield from flattened(value, f"{name}{separator}", separator=separator)
        else:
            yield name, value


def leaves_at(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Yield the leaves of what stands at an absolute name of ROS 1: itself where it is no branch.

    Args:
        name: such as ``/robot``; empty or ``/`` for the root.
        value: a branch or a value; an empty branch is a leaf.
    """
    if isinstance(value, Mapping) and value:
        yield from flattened(value, f"{name.rstrip('/')}/", separator="/")
    else:
        yield name or "/", value


def values_only(leaves: Iterable[tuple[str, Any]]) -> Iterator[tuple[str, Any]]:
    """Yield the leaves that have a value, which an empty branch has not."""
    return (leaf for leaf in leaves if not isinstance(leaf[1], Mapping))


def _branch(tree: dict[str, Any], word: str) -> dict[str, Any]:
    found = tree.get(word)
    if not isinstance(found, dict):
        found = tree[word] = {}
    return found


def _merge(into: dict[str, Any], tree: Mapping[str, Any]) -> None:
    for key, value in tree.items():
        if isinstance(value, Mapping):
            _merge(_branch(into, key), value)
        else:
            into[key] = value
