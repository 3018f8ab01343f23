"""What programs of C++ ask of Python by name, JSON in and JSON out: one table of verbs.

A family of verbs is a module: ``param/get`` is in `gazelle.cpp.verbs.param`, or in one that
`FAMILIES` names, which is imported when one of its verbs is first asked for. A verb is a function::

    @verb("param/get")
    def get(host: HostContext, request: dict[str, Any]) -> Any: ...

What it raises reaches C++ as a ``gazelle::Error`` whose `kind` is the exception's class.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from gazelle.errors import GazelleError

__all__ = ["FAMILIES", "UnknownVerbError", "Verb", "verb", "verb_named"]

Verb = Callable[[Any, dict[str, Any]], Any]
"""Takes the process's `HostContext` and a request; its module knows which class that is."""

FAMILIES: dict[str, str] = {
    "end": "gazelle.cpp.verbs.topic",
    "names": "gazelle.cpp.verbs.node",
}
"""Modules of families that do not have the family's name, or lie elsewhere."""

_verbs: dict[str, Verb] = {}


class UnknownVerbError(GazelleError):
    """C++ asked for a verb that there is not."""


def verb(name: str) -> Callable[[Verb], Verb]:
    """Register a function under ``family/word``."""

    def register(function: Verb) -> Verb:
        _verbs[name] = function
        return function

    return register


def verb_named(name: str) -> Verb:
    """Return a verb.

    Raises:
        UnknownVerbError: there is none of the name.
    """
    found = _verbs.get(name)
    if found is None:
        family = name.partition("/")[0]
        module = FAMILIES.get(family, f"gazelle.cpp.verbs.{family}")
        if family.isidentifier() and find_spec(module) is not None:
            import_module(module)
        found = _verbs.get(name)
    if found is None:
        raise UnknownVerbError(f"there is no verb '{name}'")
    return found
