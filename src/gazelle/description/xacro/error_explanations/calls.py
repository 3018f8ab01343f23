"""Calls of macros that do not fit the macro, unknown macros, blocks, and calls without end."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace
from typing import Any

from gazelle.description.xacro.dom import span_of
from gazelle.description.xacro.failure import (
    Explanation,
    Failure,
    include_line,
    known_keys,
    listed,
    one_line,
    short_location,
)
from gazelle.description.xacro.macro_definitions import definitions_in, files_beside
from gazelle.diagnostics import SourceSpan, did_you_mean
from gazelle.documents import TEXT_BYTES, LimitError, read_limited

__all__ = ["explain_call"]

_TAGS: tuple[str, ...] = ("arg", "attribute", "call", "element", "if", "include", "insert_block")
_TAGS += ("macro", "property", "unless")


def explain_call(failure: Failure) -> Explanation | None:
    """Explain a macro call or block; None for other failures."""
    text = str(failure.error)
    if failure.cause(RecursionError) is not None:
        return _endless(failure)
    if "unknown macro name" in text:
        return _unknown(failure)
    if text.startswith("Undefined block"):
        return _undefined_block(text, failure)
    if not getattr(failure.error, "macros", None):
        return None
    macro = failure.error.macros[0]  # type: ignore[attr-defined]
    if text.startswith("Invalid parameter"):
        return _invalid_parameter(text.split('"')[1], macro, failure)
    if text.startswith("Undefined property to forward"):
        return _nothing_to_forward(text.rpartition(": ")[2], macro, failure)
    return _unfit(text, macro, failure)


def _unfit(text: str, macro: Any, failure: Failure) -> Explanation:
    """Explain missing parameters and too many or too few blocks."""
    name, span = _name_of(macro), _tag_place(failure)
    if text.startswith("Undefined parameters"):
        missing = text.partition("[")[2].rstrip("]").split(",")
        given = listed(failure.locals["handle_macro_call"]["node"].attributes.keys(), "nothing")
        message = f"{text}: macro '{name}' needs {listed(missing)}; given: {given}"
        fix = "add " + " ".join(_as_elsewhere(name, item, failure) for item in missing)
        if any(macro.params.count(item) > 1 for item in missing):
            fix = "name each parameter once in params"
        return Explanation("xacro.bad-call", f"{message}; {_signature(macro)}", span, fix, name)
    blocks = [item for item in macro.params if item.startswith("*")]
    message = f"{text}: macro '{name}' takes {len(blocks)} block(s) ({listed(blocks)})"
    fix = "put one child element for each block into the call"
    if text.startswith("Unused block"):
        block = text.split('"')[1]
        fix = f'remove the child element, or add a block to the macro: params="… *{block}"'
        if block in macro.params:
            fix = f"'{block}' is a value in params; write *{block} there for a block"
    return Explanation("xacro.bad-call", f"{message}; {_signature(macro)}", span, fix, name)


def _as_elsewhere(macro: str, parameter: str, failure: Failure) -> str:
    """Write a parameter as another call of the macro has it, as an example."""
    call = re.compile(rf'<xacro:{re.escape(macro)}\s[^<>]*?\b{re.escape(parameter)}="([^"]*)"')
    for file in failure.library_run.tracker.files:
        try:
            found = call.findall(read_limited(file, TEXT_BYTES).decode("utf-8", errors="replace"))
        except (OSError, LimitError):
            continue
        if found:
            return f'{parameter}="{found[-1]}", as another call has it, or its own value'
    return f'{parameter}="…"'


def _invalid_parameter(name: str, macro: Any, failure: Failure) -> Explanation:
    message = f"Invalid parameter \"{name}\": macro '{_name_of(macro)}' does not have it"
    fix = did_you_mean(name, macro.params) or f'remove {name}="…" or add it to params'
    span = failure.attribute_place(name, whole=True)
    return Explanation("xacro.bad-call", f"{message}; {_signature(macro)}", span, fix, name)


def _nothing_to_forward(name: str, macro: Any, failure: Failure) -> Explanation:
    message = f"macro '{_name_of(macro)}' takes '{name}' from its caller ({name}:=^)"
    message += f", and there is no property '{name}' there"
    fix = f"define '{name}' before the call, pass it, or give a default: {name}:=^|VALUE"
    call = failure.library_run.tracker.via()
    return Explanation("xacro.bad-call", message, call[0] if call else failure.span, fix, name)


def _unknown(failure: Failure) -> Explanation:
    name = failure.node.tagName.removeprefix("xacro:")
    message = f"unknown macro name: xacro:{name}"
    files = failure.library_run.tracker.files
    known = [*_qualified(failure.macros), *known_keys(failure.macros)]
    inside = [item for item in known if item.endswith(f".{name}")]
    found = [item for item in definitions_in(files) if item.kind == "macro" and item.name == name]
    if inside:
        fix = f"it is in a namespace here: write <xacro:{inside[0]} …>"
    elif found:
        span = short_location(found[0].span)
        message += f"; it is defined further down ({span})"
        fix = "a macro is known below its definition: move that, or its include, above this call"
    else:
        fix = did_you_mean(name, known) or did_you_mean(name, _TAGS)
        fix = fix or _defined_beside(name, files, failure.files[-1])
    return Explanation("xacro.unknown-macro", message, _tag_place(failure), fix, name)


def _qualified(macros: Any) -> list[str]:
    """Return macros of included namespaces as they are called: ``ns.macro``."""
    names: list[str] = []
    for key in known_keys(macros):
        inside = macros[key]
        if isinstance(inside, dict):
            names += [f"{key}.{item}" for item in dict.keys(inside)]
    return names


def _defined_beside(name: str, files: list[str], reader: str) -> str:
    output_files = definitions_in(files_beside(files[0], files)) if files else ()
    for item in output_files:
        if item.kind == "macro" and item.name == name:
            line = include_line(item.span.file, reader)
            return f"{short_location(item.span)} defines it; include that file above: {line}"
    return ""


def _undefined_block(text: str, failure: Failure) -> Explanation:
    name = text.split('"')[1]
    blocks = [key.lstrip("*") for key in known_keys(failure.symbols) if key.startswith("*")]
    message = f'Undefined block "{name}"; blocks known here: {listed(blocks)}'
    fix = did_you_mean(name, blocks)
    if name in known_keys(failure.symbols):
        fix = f"'{name}' is a value: write ${{{name}}}, or make it a block: params=\"*{name}\""
    span = failure.attribute_place("name")
    return Explanation(
        "xacro.bad-call", message, span, fix or "name one of the macro's *blocks", name
    )


def _endless(failure: Failure) -> Explanation:
    files = list(failure.files)
    span = _endless_place(failure)
    if len(set(files)) < len(files):
        first = next(name for name in files if files.count(name) > 1)
        start = files.index(first)
        circle = files[start : files.index(first, start + 1) + 1]
        message = "files include each other without end: " + " → ".join(circle)
        fix = "include the file once, from the file above both"
        return Explanation("xacro.recursion", message, span, fix, files[-1])
    message = "macros or properties call each other without end"
    names = [_name_of(macro) for macro in failure.macro_stack]
    repeated = [name for name in names if names.count(name) > 1]
    if repeated:
        message = f"macros call each other without end: {listed(repeated)}"
    return Explanation("xacro.recursion", message, span)


def _endless_place(failure: Failure) -> SourceSpan:
    """Return the innermost call that is made again and again, and how one gets there."""
    calls = failure.library_run.tracker.calls
    counts = Counter(calls)
    again = [index for index, call in enumerate(calls) if counts[call] > 1]
    if not again:
        return failure.span
    return replace(calls[again[-1]], via=tuple(reversed(calls[: again[0]])))


def _signature(macro: Any) -> str:
    """Return what a macro takes and where it stands."""
    declared = []
    for parameter in macro.params:
        forward, default = macro.defaultmap.get(parameter, (None, None))
        value = ("^" if forward else "") + ("|" if forward and default else "") + (default or "")
        declared.append(f"{parameter}:={value}" if parameter in macro.defaultmap else parameter)
    span = span_of(macro.body)
    where = f" ({short_location(span)})" if span is not None else ""
    return one_line(f'it is defined with params="{" ".join(declared)}"{where}')


def _name_of(macro: Any) -> str:
    return str(macro.body.getAttribute("name"))


def _tag_place(failure: Failure) -> Any:
    failure.text = ""
    return failure.span
