"""What a release's SDF specification knows: elements, attributes, types, defaults.

``specification.txt`` holds the facts of SDF 1.7, 1.9 and 1.11, one element or attribute in a line,
what belongs to it below it with one more space of indentation::

    == camera 1.9                      a file of the specification, of these versions or of all
    camera ?                           element: ? optional, ! required once, + at least once, * any
     @name ? string=__default__        attribute with type and default
     near ! double[0.1,]=.1            least and largest value
     <noise                            the element of another file
     ^model                            nested in itself: what stands inside is as in that file
     ...                               any children
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.resources import files
from typing import NamedTuple

from gazelle.description.sdformat_emulation.release import Release

__all__ = ["Definition", "Parameter", "specification"]

_REQUIRED = {"?": "0", "!": "1", "-": "-1"}


class Parameter(NamedTuple):
    """A typed value: an attribute or the text of an element.

    Attributes:
        key: name of the attribute or element.
        kind: type, such as ``double`` or ``vector3``.
        default: as the specification spells it.
        required: an empty text is refused; an attribute must be there.
        least: smallest number, None when any will do.
        most: largest number, None when any will do.
    """

    key: str
    kind: str
    default: str
    required: bool
    least: float | None = None
    most: float | None = None


@dataclass(frozen=True, eq=False)
class Definition:
    """An element of the specification.

    Attributes:
        name: element name.
        required: ``0``, ``1``, ``*``, ``+`` or ``-1`` (deprecated).
        value: its text; None when it has none.
        attributes: in the order in which they are printed.
        takes_any: children of any name are copied.
        reference: file whose element this one is nested in; empty for others.
        parts: definitions and, behind ``<``, names of files.
        book: all files of the version by name.
    """

    name: str
    required: str
    value: Parameter | None
    attributes: tuple[Parameter, ...]
    takes_any: bool
    reference: str
    parts: tuple[Definition | str, ...]
    book: Mapping[str, Definition]

    @cached_property
    def children(self) -> dict[str, Definition]:
        """Definitions of child elements by name, own ones before those of other files."""
        own = [part for part in self.parts if isinstance(part, Definition)]
        other = [self.book[part] for part in self.parts if isinstance(part, str)]
        found: dict[str, Definition] = {}
        for part in (*own, *other):
            found.setdefault(part.name, part)
        return found

    @property
    def resolved(self) -> Definition:
        """The definition that counts when the element is read: that of `reference`, if any."""
        return self.book[self.reference] if self.reference else self

    def attribute(self, name: str) -> Parameter | None:
        """Return an attribute's facts, None when the specification does not know it."""
        return next((item for item in self.attributes if item.key == name), None)


@cache
def specification(release: Release) -> Definition:
    """Return the definition of ``<sdf>`` in a release."""
    book: dict[str, Definition] = {}
    for block in _text("specification.txt").split("== ")[1:]:
        title, *lines = block.splitlines()
        name, _, only = title.partition(" ")
        if not only or release.spec_text in only.split():
            book[name] = _definition(lines, 0, 0, book)
    return book["root"]


def _text(name: str) -> str:
    return (files(__package__) / name).read_text(encoding="utf-8")


def _definition(
    lines: list[str], start: int, depth: int, book: dict[str, Definition]
) -> Definition:
    value = _parameter(lines[start].strip())
    parts: list[Definition | str] = []
    attributes: list[Parameter] = []
    takes_any, reference = False, ""
    for number in range(start + 1, len(lines)):
        line = lines[number].strip()
        level = len(lines[number]) - len(lines[number].lstrip(" "))
        if level <= depth:
            break
        if level > depth + 1:
            continue
        if line == "...":
            takes_any = True
        elif line[0] == "^":
            reference = line[1:]
        elif line[0] == "<":
            parts.append(line[1:])
        elif line[0] == "@":
            attributes.append(_parameter(line[1:])[1] or _NOTHING)
        else:
            parts.append(_definition(lines, number, level, book))
    (name, required), parameter = value
    return Definition(
        name, required, parameter, tuple(attributes), takes_any, reference, tuple(parts), book
    )


_NOTHING = Parameter("", "string", "", required=False)


def _parameter(line: str) -> tuple[tuple[str, str], Parameter | None]:
    name, _, rest = line.partition(" ")
    mark, _, kind = rest.partition(" ")
    required = _REQUIRED.get(mark, mark)
    if not kind:
        return (name, required), None
    kind, _, default = kind.partition("=")
    kind, _, limits = kind.partition("[")
    least, _, most = limits.rstrip("]").partition(",")
    parameter = Parameter(
        name, kind.replace("_", " ") if kind.startswith("unsigned") else kind, default,
        required == "1", _number(least), _number(most),
    )  # fmt: skip
    return (name, required), parameter


def _number(text: str) -> float | None:
    # The limits of vectors are never compared.
    return float(text) if text and " " not in text else None
