"""The specification printed, as ``-d`` does, without descriptions: those are at sdformat.org."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description.sdformat_emulation.gz_sdf.console import Console
from gazelle.description.sdformat_emulation.gz_sdf.specification import (
    Definition,
    Parameter,
    specification,
)
from gazelle.description.sdformat_emulation.gz_sdf.values import default_text
from gazelle.description.sdformat_emulation.release import Release

__all__ = ["described_specification"]


def described_specification(release: Release) -> str:
    """Return elements, attributes, types, defaults and what is required, nested as in SDF."""
    lines = _lines(specification(release), "", Console(release))
    return "".join(f"{line}\n" for line in lines)


def _lines(definition: Definition, indent: str, console: Console) -> Iterator[str]:
    head = f"{indent}<element name ='{definition.name}' required ='{definition.required}'"
    value = definition.value
    yield head + (_typed(value, console) + _limits(value, console) if value else "") + ">"
    inner = indent + "  "
    for item in definition.attributes:
        typed = _typed(item, console)
        yield f"{inner}<attribute name ='{item.key}'{typed} required ='{int(item.required)}'/>"
    if definition.takes_any:
        yield f"{inner}<element copy_data ='true' required ='*'/>"
    if definition.reference:
        yield f"{inner}<element ref ='{definition.reference}' required ='*'/>"
    for child in definition.children.values():
        yield from _lines(child, inner, console)
    yield f"{indent}</element>"


def _typed(value: Parameter, console: Console) -> str:
    default = default_text(value, console, as_typed=True)
    return f" type ='{value.kind}' default ='{default}'"


def _limits(value: Parameter, console: Console) -> str:
    if console.release is Release.V9:
        return ""
    pairs = (("min", value.least), ("max", value.most))
    return "".join(f" {word} ='{limit:.17g}'" for word, limit in pairs if limit is not None)
