"""Names in expressions that are not defined, or not defined yet, or not here."""

from __future__ import annotations

import re

from gazelle.description.xacro.error_explanations.finding import (
    Finding,
    include_line,
    is_below,
    known_keys,
    one_line,
    short_place,
)
from gazelle.description.xacro.failure import Failure
from gazelle.description.xacro.macro_definitions import Definition, definitions_in, files_beside
from gazelle.diagnostics import did_you_mean

__all__ = ["explain_name"]

_NAME_ERROR = re.compile(r"name '(.+?)' is not defined")
_KEY_ERROR = re.compile(r"The yaml dictionary has no key '(.+?)'")


def explain_name(failure: Failure) -> Finding | None:
    """Explain an undefined name or a missing key of a YAML file; None for other failures."""
    error = failure.cause(NameError)
    found = _NAME_ERROR.search(str(error)) if error is not None else None
    if found is not None:
        return _undefined(found[1], failure)
    key = failure.cause(AttributeError)
    found = _KEY_ERROR.search(str(key)) if key is not None else None
    return _no_key(found[1], failure) if found is not None else None


def _undefined(name: str, failure: Failure) -> Finding:
    what = failure.part or f"${{{failure.expression}}}"
    message = f"cannot evaluate '{what}': name '{name}' is not defined"
    known = known_keys(failure.symbols)
    hint = did_you_mean(name, (item for item in known if not item.startswith(("*", "_"))))
    python = (
        dict.keys(failure.symbols.root.get("python", {})) if failure.symbols is not None else ()
    )
    if name in python:
        fix = f"write python.{name}: xacro has it there"
    elif f"**{name}" in known or f"*{name}" in known:
        message += "; it is a block of elements here, and no value"
        fix = f'put the block in with <xacro:insert_block name="{name}"/>'
    else:
        note, fix = _elsewhere(name, failure)
        message += note
        fix = fix or hint
    return Finding("xacro.undefined-name", message, failure.span, fix, name)


def _elsewhere(name: str, failure: Failure) -> tuple[str, str]:
    """Return what to add to the message and a remedy when a file defines the name after all."""
    files = failure.session.tracker.files
    found = [item for item in definitions_in(files) if item.name == name]
    if not found:
        beside = definitions_in(files_beside(files[0], files)) if files else ()
        other = [item for item in beside if item.name == name and _is_global(item)]
        if not other:
            return "", ""
        place = other[0].span
        line = include_line(place.file, failure.files[-1])
        return f"; {short_place(place)} defines it", f"include that file above: {line}"
    best = min(found, key=lambda item: ("property", "arg", "parameter", "macro").index(item.kind))
    return _note_about(best, failure)


def _is_global(item: Definition) -> bool:
    return item.kind == "property" and not item.macro


def _note_about(item: Definition, failure: Failure) -> tuple[str, str]:
    name, place = item.name, short_place(item.span)
    if item.kind == "arg":
        return f"; {place} has an argument of this name", f"write $(arg {name}) for an argument"
    if item.kind == "parameter":
        note = f"; it is a parameter of macro '{item.macro}' ({place}) and known only inside it"
        return note, ""
    if item.kind == "macro":
        note = f"; a macro has this name ({place})"
        return note, f"a macro is called as an element: <xacro:{name} …/>"
    if item.macro:
        note = f"; it is defined inside macro '{item.macro}' ({place}) and known only there"
        return note, 'define it outside of the macro, or add scope="global" to it'
    if any(is_below(item.span, place) for place in (failure.span, *failure.via)):
        return f"; it is defined further down ({place})", "move the property above its first use"
    return f"; {place} defines it, and that is not seen from here", ""


def _no_key(key: str, failure: Failure) -> Finding:
    table = failure.locals.get("__getattr__", {}).get("self")
    keys = [str(item) for item in table] if isinstance(table, dict) else []
    message = f"cannot evaluate '{failure.part}': the yaml dictionary has no key '{key}'"
    if keys:
        message += f"; it has {one_line(', '.join(keys[:12]))}"
    fix = did_you_mean(key, keys) or "correct the key, or add it to the YAML file"
    return Finding("xacro.bad-expression", message, failure.span, fix)
