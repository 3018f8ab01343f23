"""Which class an element or a ``$(…)`` stands for."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, TypeVar

from gazelle.diagnostics import did_you_mean

if TYPE_CHECKING:
    from gazelle.launch.ros2.frontend.entity import Entity
    from gazelle.launch.ros2.frontend.parser import Parser

__all__ = [
    "action_parse_methods",
    "expose_action",
    "expose_substitution",
    "instantiate_action",
    "instantiate_substitution",
    "substitution_parse_methods",
]

_Exposed = TypeVar("_Exposed")

action_parse_methods: dict[str, Callable[..., Any]] = {}
substitution_parse_methods: dict[str, Callable[..., Any]] = {}


def instantiate_action(entity: Entity, parser: Parser) -> Any:
    """Return the action of an element.

    Raises:
        RuntimeError: no action has this name.
    """
    method = action_parse_methods.get(entity.type_name)
    if method is None:
        hint = _hint(entity.type_name, action_parse_methods)
        raise RuntimeError(f"Unrecognized entity of the type: {entity.type_name}{hint}")
    action_type, kwargs = method(entity, parser)
    return action_type(**kwargs)


def instantiate_substitution(type_name: str, args: Iterable[Any] | None = None) -> Any:
    """Return the substitution of a ``$(name args…)``.

    Raises:
        RuntimeError: no substitution has this name.
    """
    method = substitution_parse_methods.get(type_name)
    if method is None:
        hint = _hint(type_name, substitution_parse_methods)
        raise RuntimeError(f"Unknown substitution: {type_name}{hint}")
    substitution_type, kwargs = method([] if args is None else list(args))
    # The ones of any and all go by position.
    positional = kwargs.pop("args", ()) if _takes_any_number(substitution_type) else ()
    return substitution_type(*positional, **kwargs)


def expose_substitution(name: str) -> Callable[[_Exposed], _Exposed]:
    """Return a decorator that lets ``$(name …)`` stand for a class, by its ``parse``."""
    return _exposing(name, substitution_parse_methods, "substitution")


def expose_action(name: str) -> Callable[[_Exposed], _Exposed]:
    """Return a decorator that lets an element stand for a class, by its ``parse``.

    Elements with attributes or children that ``parse`` does not ask for are refused.
    """
    return _exposing(name, action_parse_methods, "action")


def _exposing(
    name: str, methods: dict[str, Callable[..., Any]], kind: str
) -> Callable[[_Exposed], _Exposed]:
    def decorate(exposed: _Exposed) -> _Exposed:
        found = _parse_method(exposed, name, kind)
        known = methods.get(name)
        if known is not None and getattr(known, "__wrapped__", known) != found:
            raise RuntimeError(f"Two {kind} parsing methods exposed with the same name: [{name}].")
        methods[name] = _checking(found) if kind == "action" else found
        return exposed

    return decorate


def _parse_method(exposed: Any, name: str, kind: str) -> Callable[..., Any]:
    if inspect.isclass(exposed):
        method = getattr(exposed, "parse", None)
        if not inspect.ismethod(method):
            raise RuntimeError(
                "Did not find a class method called 'parse' in the class being decorated."
            )
        return method
    if not inspect.isfunction(exposed):
        raise RuntimeError(
            f"Exposed {kind} parser for {name} is not a callable or a class"
            " containing a parse method"
        )
    return exposed


def _checking(method: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(method)
    def parse(entity: Entity, parser: Parser) -> Any:
        found = method(entity, parser)
        entity.assert_entity_completely_parsed()
        return found

    return parse


def _takes_any_number(substitution_type: Any) -> bool:
    parameters = inspect.signature(substitution_type).parameters.values()
    return any(one.kind is inspect.Parameter.VAR_POSITIONAL for one in parameters)


def _hint(name: str, known: Iterable[str]) -> str:
    hint = did_you_mean(name, sorted(known))
    return f" ({hint})" if hint else ""
