"""Names and conditions of rows that depend on a node's parameters."""

from __future__ import annotations

import re
from collections.abc import Callable

__all__ = ["ValueOf", "expanded", "holds"]

ValueOf = Callable[[str, str], str]
"""Gives the value of a parameter (``~private`` or of the node's namespace), from its default."""

_PARAMETER = re.compile(r"\{([^|{}]+)\|([^{}]*)\}")
_FALSE = frozenset({"", "0", "false"})


def expanded(pattern: str, value_of: ValueOf) -> str:
    """Return a name with its parameters put in: ``{~scan_topic|scan}`` is a value, or ``scan``."""
    return _PARAMETER.sub(lambda found: value_of(found[1], found[2]), pattern)


def holds(when: str, value_of: ValueOf) -> bool:
    """Tell whether a condition is met: ``~publish_tf|true``, the other way round after a ``!``."""
    if not when:
        return True
    name, _, default = when.removeprefix("!").partition("|")
    return (value_of(name, default).lower() not in _FALSE) is not when.startswith("!")
