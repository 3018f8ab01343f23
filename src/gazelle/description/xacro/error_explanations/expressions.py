"""Expressions that Python refuses, and names in them that are not defined, not yet, or not here."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from gazelle.description.xacro.failure import (
    Explanation,
    Failure,
    include_line,
    is_below,
    known_keys,
    one_line,
    short_location,
)
from gazelle.description.xacro.macro_definitions import Definition, definitions_in, files_beside
from gazelle.diagnostics import did_you_mean

__all__ = ["explain_expression", "explain_name"]

_NAME_ERROR = re.compile(r"name '(.+?)' is not defined")
_KEY_ERROR = re.compile(r"The yaml dictionary has no key '(.+?)'")
_LIKE_A_NUMBER = re.compile(r"\s*-?\d*\.\d*\.\d+\s*")
_COMMA_VALUE = re.compile(r"\s*[-+]?\d+,\d+\s*")
_COMMA = re.compile(r"(?<![\w.,\[])\d+,\d+(?![\w.,\]])")
_WITH_UNIT = re.compile(r"\s*([-+]?\d*\.?\d+)\s*([a-zA-Z°]+)\s*")
_MAX_LENGTH = 60


def explain_name(failure: Failure) -> Explanation | None:
    """Explain an undefined name or a missing key of a YAML file; None for other failures."""
    error = failure.cause(NameError)
    found = _NAME_ERROR.search(str(error)) if error is not None else None
    if found is not None:
        return _undefined(found[1], failure)
    key = failure.cause(AttributeError)
    found = _KEY_ERROR.search(str(key)) if key is not None else None
    return _no_key(found[1], failure) if found is not None else None


def explain_expression(failure: Failure) -> Explanation | None:
    """Explain why an expression has no value; None for other failures."""
    if "circular variable definition" in str(failure.error):
        return _circular(failure)
    if "invalid expression: " in str(failure.error) and not failure.part:
        return _unclosed(failure)
    if not failure.expression:
        return None
    cause = failure.causes[-1]
    expression = f"${{{failure.expression}}}"
    what = failure.part or expression
    inner = "" if expression == what else f" in '{expression}'"
    message = f"cannot evaluate '{what}'{inner}: {_reason(cause)}"
    if "${" in failure.expression:
        return Explanation("xacro.bad-expression", message, failure.span, "add '}'")
    values = _values(failure)
    if values:
        shown = ", ".join(
            f"{name} = {_shown(value)}{_where(name, failure)}" for name, value in values
        )
        message += f"; here {shown}"
    comma = _decimal_comma(failure.expression, values) if isinstance(cause, TypeError) else ""
    if comma:
        text = _property_of(comma, failure) or _text_in(values, cause)
        span = failure.library_run.properties.get(text) if comma not in failure.expression else None
        if span is not None:
            # The value has to change, not what is done with it; it is told once for all its uses.
            message = f"property '{text}' is '{comma}', a text: the decimal sign is a dot"
            fix = f"write {comma.replace(',', '.')}"
            place = replace(span, via=(failure.span, *failure.via))
            return Explanation("xacro.decimal-comma", message, place, fix, text)
        fix = f"write the decimal sign as a dot: {comma.replace(',', '.')}"
        return Explanation("xacro.decimal-comma", message, failure.span, fix, text)
    fix = _remedy(failure, cause, values)
    text = _text_in(values, cause)
    written = str(dict(values).get(text, ""))
    text = _property_of(written.strip(), failure) or text
    span = failure.library_run.properties.get(text)
    if span is not None and _LIKE_A_NUMBER.fullmatch(written):
        # The value has to change, not what is done with it.
        message = f"property '{text}' is '{written}', which is no number"
        place = replace(span, via=(failure.span, *failure.via))
        fix = f"write {' or '.join(_with_one_point(written))}: a number has one decimal point"
        return Explanation("xacro.bad-expression", message, place, fix, text)
    return Explanation("xacro.bad-expression", message, failure.span, fix, text)


def _property_of(text: str, failure: Failure) -> str:
    """Return the property that has a value, which parameters of macros may have from it."""
    for name in failure.library_run.properties:
        try:
            value = failure.symbols[name]
        # Evaluating a property may fail as the expression did.
        except Exception:  # noqa: BLE001, S112
            continue
        if isinstance(name, str) and isinstance(value, str) and value.strip() == text:
            return name
    return ""


def _with_one_point(text: str) -> tuple[str, str]:
    first, second = text.index("."), text.rindex(".")
    return text[:second] + text[second + 1 :], text[:first] + text[second:]


def _undefined(name: str, failure: Failure) -> Explanation:
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
        note, fix = _defined_elsewhere(name, failure)
        message += note
        fix = fix or hint
    return Explanation("xacro.undefined-name", message, failure.span, fix, name)


def _defined_elsewhere(name: str, failure: Failure) -> tuple[str, str]:
    """Return what to add to the message and a remedy when a file defines the name after all."""
    files = failure.library_run.tracker.files
    found = [item for item in definitions_in(files) if item.name == name]
    if not found:
        output_files = definitions_in(files_beside(files[0], files)) if files else ()
        other = [item for item in output_files if item.name == name and _is_global(item)]
        if not other:
            return "", ""
        span = other[0].span
        line = include_line(span.file, failure.files[-1])
        return f"; {short_location(span)} defines it", f"include that file above: {line}"
    best = min(found, key=lambda item: ("property", "arg", "parameter", "macro").index(item.kind))
    return _note_about(best, failure)


def _is_global(item: Definition) -> bool:
    return item.kind == "property" and not item.macro


def _note_about(item: Definition, failure: Failure) -> tuple[str, str]:
    name, location = item.name, short_location(item.span)
    if item.kind == "arg":
        return f"; {location} has an argument of this name", f"write $(arg {name}) for an argument"
    if item.kind == "parameter":
        note = f"; it is a parameter of macro '{item.macro}' ({location}) and known only inside it"
        return note, ""
    if item.kind == "macro":
        note = f"; a macro has this name ({location})"
        return note, f"a macro is called as an element: <xacro:{name} …/>"
    if item.macro:
        note = f"; it is defined inside macro '{item.macro}' ({location}) and known only there"
        return note, 'define it outside of the macro, or add scope="global" to it'
    if any(is_below(item.span, location) for location in (failure.span, *failure.via)):
        return f"; it is defined further down ({location})", "move the property above its first use"
    return f"; {location} defines it, and that is not seen from here", ""


def _no_key(key: str, failure: Failure) -> Explanation:
    table = failure.locals.get("__getattr__", {}).get("self")
    keys = [str(item) for item in table] if isinstance(table, dict) else []
    message = f"cannot evaluate '{failure.part}': the yaml dictionary has no key '{key}'"
    if keys:
        message += f"; it has {one_line(', '.join(keys[:12]))}"
    fix = did_you_mean(key, keys) or "correct the key, or add it to the YAML file"
    return Explanation("xacro.bad-expression", message, failure.span, fix)


def _reason(cause: BaseException) -> str:
    if isinstance(cause, SyntaxError):
        return str(cause.msg)
    if isinstance(cause, KeyError):
        return f"there is no key {cause}"
    return one_line(str(cause)) or type(cause).__name__


def _values(failure: Failure) -> list[tuple[str, Any]]:
    """Return the names in an expression with their values, functions left out."""
    try:
        tree = ast.parse(failure.expression.strip(), mode="eval")
    except (SyntaxError, ValueError):
        return []
    names = [node.id for node in ast.walk(tree) if isinstance(node, ast.Name)]
    found: list[tuple[str, Any]] = []
    for name in dict.fromkeys(names):
        try:
            value = failure.symbols[name]
        # Evaluating a property may fail as the expression did; then there is no value to show.
        except Exception:  # noqa: BLE001, S112
            continue
        if not callable(value) and name not in {"True", "False", "pi", "e", "python", "xacro"}:
            found.append((name, value))
    return found


def _shown(value: Any) -> str:
    text = one_line(repr(value))
    return text if len(text) <= _MAX_LENGTH else f"{text[: _MAX_LENGTH - 1]}…"


def _where(name: str, failure: Failure) -> str:
    span = failure.library_run.properties.get(name)
    return f" ({short_location(span)})" if span is not None else ""


def _text_in(values: list[tuple[str, Any]], cause: BaseException) -> str:
    """Return the name of the text that stands where a number is needed, empty when none does."""
    if not isinstance(cause, TypeError):
        return ""
    return next((name for name, value in values if isinstance(value, str)), "")


def _decimal_comma(expression: str, values: list[tuple[str, Any]]) -> str:
    """Return the number that is written with a comma, empty when there is none."""
    for _, value in values:
        if isinstance(value, str) and _COMMA_VALUE.fullmatch(value):
            return value.strip()
    found = _COMMA.search(expression)
    return found[0] if found else ""


def _remedy(failure: Failure, cause: BaseException, values: list[tuple[str, Any]]) -> str:
    if isinstance(cause, ZeroDivisionError):
        zeros = [name for name, value in values if value in (0, 0.0)]
        return f"give {' or '.join(zeros)} a value other than 0" if zeros else ""
    if isinstance(cause, SyntaxError):
        return _syntax_remedy(failure, cause)
    if isinstance(cause, KeyError):
        keys = [str(key) for _, value in values if isinstance(value, dict) for key in _keys(value)]
        return did_you_mean(str(cause.args[0]), keys)
    for name, value in values:
        unit = _WITH_UNIT.fullmatch(value) if isinstance(value, str) else None
        if unit is not None:
            return f"{name} is a text; write the number alone: {unit[1]}"
        if name == _text_in(values, cause):
            return f"{name} is a text and no number; correct its value"
    return ""


def _keys(table: dict[Any, Any]) -> Iterator[Any]:
    for key, value in table.items():
        yield key
        yield from _keys(value) if isinstance(value, dict) else ()


def _syntax_remedy(failure: Failure, cause: SyntaxError) -> str:
    text = failure.expression
    if text.count("{") > text.count("}"):
        return (
            "xacro ends ${…} at the first '}': write dict(a=1) for {'a': 1}, '%.2f' % x for format"
        )
    if re.search(r"&&|\|\|", text):
        return "Python writes 'and' and 'or'"
    if re.search(r"!\s*\w", text):
        return "Python writes 'not'"
    if "?" in text:
        return "Python writes 'A if CONDITION else B'"
    if re.fullmatch(r"\s*", text):
        return "write an expression between the braces"
    found = _WITH_UNIT.search(text)
    if found is not None and "invalid decimal literal" in str(cause.msg):
        return f"write the number alone, without '{found[2]}'"
    return ""


def _circular(failure: Failure) -> Explanation:
    text = str(failure.error)
    found = re.search(r"circular variable definition: (.*)", text)
    chain = found[1].strip() if found else ""
    message = f"circular variable definition: {chain}: the properties need each other"
    fix = 'break the circle, or evaluate one at once with lazy_eval="false"'
    return Explanation("xacro.recursion", message, failure.span, fix)


def _unclosed(failure: Failure) -> Explanation:
    rest = str(failure.error).partition("invalid expression: ")[2]
    close = "}" if rest.startswith("${") else ")"
    failure.part = rest
    message = f"'{one_line(rest)}' has no closing '{close}'"
    return Explanation("xacro.bad-expression", message, failure.span, f"add '{close}'")
