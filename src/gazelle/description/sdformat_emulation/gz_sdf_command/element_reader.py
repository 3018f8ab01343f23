"""One document's elements read by the rules of the specification: types, requirements, defaults."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf_command.console import Code, Console, SdfError
from gazelle.description.sdformat_emulation.gz_sdf_command.specification import (
    Definition,
    Parameter,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.values import (
    default_text,
    empty_pose,
    printed_value,
)
from gazelle.description.sdformat_emulation.release import Release

__all__ = [
    "Document",
    "ElementLocation",
    "Include",
    "Reading",
    "default_element",
    "read_element",
    "set_attribute",
    "set_text",
]

_FRAME_REFERENCES = frozenset(
    {
        ("frame", "attached_to"),
        ("pose", "relative_to"),
        ("model", "placement_frame"),
        ("model", "canonical_link"),
        ("custom_rpy", "parent_frame"),
    }
)


@dataclass(frozen=True, slots=True)
class Document:
    """What a release makes of a document.

    Attributes:
        root: ``<sdf>`` of the release's version, every value checked, everything required there;
            None when sdformat refuses the document.
        original_version: version that the document says; empty when it says none.
        errors: with numbers, as ``readFile`` returns them.
        console: lines that the library writes meanwhile.
        included_from: the ``<include>`` that an element came from, by identity of the element.
        versions: version of the file that an included element came from, by identity.
    """

    root: SdfElement | None
    original_version: str
    errors: tuple[SdfError, ...]
    console: Console
    included_from: dict[int, SdfElement] = field(default_factory=dict)
    versions: dict[int, tuple[int, ...]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class ElementLocation:
    """Where an element stands, for messages: the path of elements and the file."""

    path: str
    file: str

    def child(self, element: SdfElement) -> ElementLocation:
        """Return the place of a child element."""
        name = element.attributes.get("name")
        label = f'[@name="{name}"]' if name is not None else ""
        return ElementLocation(f"{self.path}/{element.name}{label}", self.file)


@dataclass(frozen=True, slots=True)
class Include:
    """An ``<include>`` and where its content goes.

    Attributes:
        raw: the element as it stands in the document.
        parent: receives the content.
        definition: of the parent.
        location: of the parent.
        index: how many includes stand before it in the parent.
    """

    raw: SdfElement
    parent: SdfElement
    definition: Definition
    location: ElementLocation
    index: int


@dataclass(slots=True)
class Reading:
    """A run of reading: what it writes, which errors it found, how includes are read.

    Attributes:
        console: terminal; its release decides.
        errors: found so far.
        include: reads an ``<include>`` into its parent; False ends the reading of the parent.
        included_from: the ``<include>`` of elements that came from other files, by identity.
        versions: version of the file that an included element came from, by identity.
    """

    console: Console
    include: Callable[[Reading, Include], bool]
    errors: list[SdfError] = field(default_factory=list)
    included_from: dict[int, SdfElement] = field(default_factory=dict)
    versions: dict[int, tuple[int, ...]] = field(default_factory=dict)

    @property
    def is_new(self) -> bool:
        """Whether errors have places, as those of newer releases."""
        return self.console.release.is_new

    def fail(self, code: int, message: str, location: ElementLocation, line: int = 0) -> None:
        """Note an error."""
        if self.is_new:
            self.errors.append(SdfError(code, message, location.path, location.file, line))
        else:
            self.errors.append(SdfError(code, message))


def read_element(
    raw: SdfElement, definition: Definition, location: ElementLocation, reading: Reading
) -> SdfElement | None:
    """Return an element with checked values and all that is required of it; None for errors.

    Args:
        raw: as it stands in the document, already of the release's version.
        definition: what the specification says of it.
        location: for messages.
        reading: receives errors.
    """
    definition = definition.resolved
    if definition.required == "-1" and not _read_deprecated(definition, location, reading):
        return SdfElement(definition.name, line=raw.line)
    element = SdfElement(definition.name, line=raw.line)
    steps = [_read_attributes, _read_text] if reading.is_new else [_read_text, _read_attributes]
    if not all(step(element, raw, definition, location, reading) for step in steps):
        return None
    if definition.takes_any:
        element.children += [_copied(child, reading) for child in raw.children]
        return element
    if not _read_children(element, raw, definition, location, reading):
        return None
    unknown = [child for child in raw.children if child.name not in definition.children]
    for child in unknown:
        _warn_of_unknown_element(child, raw, location, reading)
    element.children += [_copied(child, reading) for child in unknown]
    return element if _complete(element, raw, definition, location, reading) else None


def default_element(definition: Definition, console: Console) -> SdfElement:
    """Return an element that nobody wrote, with everything that is required once."""
    definition = definition.resolved
    element = SdfElement(definition.name)
    element.attributes = {
        item.key: default_text(item, console) for item in definition.attributes if item.required
    }
    if definition.value is not None:
        element.text = default_text(definition.value, console)
    inner = definition.children.values()
    element.children = [default_element(one, console) for one in inner if one.required == "1"]
    return element


def set_attribute(
    element: SdfElement, definition: Definition, name: str, text: str, console: Console
) -> bool:
    """Set an attribute the specification knows; False, with a word, when the text is refused."""
    parameter = definition.resolved.attribute(name)
    if parameter is None:
        return False
    text = text.strip()
    if not text:
        return not _refuses_empty(parameter, console)
    value = printed_value(parameter, text, element.attributes, console)
    if value is None:
        return False
    values = element.attributes | {name: value}
    known = [item.key for item in definition.resolved.attributes if item.key in values]
    others = [key for key in values if key not in known]
    element.attributes = {key: values[key] for key in (*known, *others)}
    return True


def set_text(element: SdfElement, parameter: Parameter, text: str, console: Console) -> bool:
    """Set an element's value; False, with a word on the console, when the text is refused."""
    text = text.strip()
    if not text and not _refuses_empty(parameter, console):
        element.text = default_text(parameter, console, as_typed=True)
        if parameter.kind == "pose" and console.release.is_new:
            element.text = empty_pose(element.attributes)
        return True
    value = printed_value(parameter, text, element.attributes, console) if text else None
    if value is None:
        return False
    element.text = value
    return True


def _refuses_empty(parameter: Parameter, console: Console) -> bool:
    if parameter.required:
        message = f"Empty string used when setting a required parameter. Key[{parameter.key}]"
        console.error("empty", message)
    return parameter.required


def _read_deprecated(definition: Definition, location: ElementLocation, reading: Reading) -> bool:
    message = f"SDF Element[{definition.name}] is deprecated"
    if reading.is_new:
        reading.console.warn("policy-path", f"[{location.path}]: {message}")
        return True
    reading.fail(Code.ELEMENT_DEPRECATED, message, location)
    return False


def _read_text(
    element: SdfElement,
    raw: SdfElement,
    definition: Definition,
    _place: ElementLocation,
    reading: Reading,
) -> bool:
    parameter = definition.value
    if parameter is None:
        return True
    if not raw.text and not reading.is_new:
        element.text = default_text(parameter, reading.console)
        return True
    return set_text(element, parameter, raw.text, reading.console)


def _read_attributes(
    element: SdfElement,
    raw: SdfElement,
    definition: Definition,
    location: ElementLocation,
    reading: Reading,
) -> bool:
    for name, text in raw.attributes.items():
        at = ElementLocation(f'{location.path}[@{name}="{text}"]', location.file)
        if ":" in name:
            element.attributes[name] = text.strip()
        elif definition.attribute(name) is None:
            _warn_of_unknown(name, raw, at, reading)
        else:
            _check_reference(raw, name, at, reading)
            if not set_attribute(element, definition, name, text, reading.console):
                message = f"Unable to read attribute[{name}]"
                reading.fail(Code.ATTRIBUTE_INVALID, message, at, raw.line)
                return False
    for item in definition.attributes:
        if item.required and item.key not in element.attributes:
            message = (
                f"Required attribute[{item.key}] in element[{raw.name}] is not specified in SDF."
            )
            reading.fail(Code.ATTRIBUTE_MISSING, message, location, raw.line)
            return False
    return True


def _warn_of_unknown(name: str, raw: SdfElement, at: ElementLocation, reading: Reading) -> None:
    message = f"XML Attribute[{name}] in element[{raw.name}] not defined in SDF"
    if reading.is_new:
        where = f"[{at.path}:{at.file}:L{raw.line}]"
        reading.console.warn("policy-line", f"{where}: {message}.")
    else:
        reading.console.warn("unknown-attribute", f"{message}, ignoring.")


def _warn_of_unknown_element(
    child: SdfElement, raw: SdfElement, location: ElementLocation, reading: Reading
) -> None:
    """Say what sdformat 14 says, whose predecessors only told it to their log file."""
    named = child.name == "include" or ":" in child.name
    if named or reading.console.release is not Release.V14:
        return
    at = location.child(child)
    reading.console.warn(
        "policy-line",
        f"[{at.path}:{at.file}:L{child.line}]: XML Element[{child.name}], child of "
        f"element[{raw.name}], not defined in SDF. Copying[{child.name}] as children of "
        f"[{raw.name}].",
    )


def _check_reference(raw: SdfElement, name: str, at: ElementLocation, reading: Reading) -> None:
    if not reading.is_new or (raw.name, name) not in _FRAME_REFERENCES:
        return
    text = raw.attributes[name]
    if text == "__root__":
        message = f"'{text}' is reserved; it cannot be used as a value of attribute [{name}]"
        reading.fail(Code.ATTRIBUTE_INVALID, message, at, raw.line)


def _read_children(
    element: SdfElement,
    raw: SdfElement,
    definition: Definition,
    location: ElementLocation,
    reading: Reading,
) -> bool:
    includes = 0
    for child in raw.children:
        if child.name == "include":
            if not reading.include(
                reading, Include(child, element, definition, location, includes)
            ):
                return False
            includes += 1
            continue
        known = definition.children.get(child.name)
        if known is None:
            continue
        at = location.child(child)
        found = read_element(child, known, at, reading)
        if found is None:
            message = f"Error reading element <{child.name}>"
            reading.fail(Code.ELEMENT_INVALID, message, at, child.line)
            return False
        element.children.append(found)
    return True


def _complete(
    element: SdfElement,
    raw: SdfElement,
    definition: Definition,
    location: ElementLocation,
    reading: Reading,
) -> bool:
    present = {child.name for child in element.children}
    for name, known in definition.children.items():
        if known.required not in ("1", "+") or name in present:
            continue
        if element.name == "joint" and element.attributes.get("type") != "ball":
            message = f"XML Missing required element[{name}], child of element[joint]"
            at = ElementLocation(f"{location.path}/{name}", location.file)
            reading.fail(Code.ELEMENT_MISSING, message, at, raw.line)
            return False
        element.children.append(default_element(known, reading.console))
    return True


def _copied(raw: SdfElement, reading: Reading) -> SdfElement:
    """Return an element the specification does not know, as it is."""
    for name, text in raw.attributes.items():
        if not text.strip():
            message = f"Empty string used when setting a required parameter. Key[{name}]"
            reading.console.error("empty", message)
    attributes = {name: _copied_text(text, reading) for name, text in raw.attributes.items()}
    children = [_copied(child, reading) for child in raw.children]
    return SdfElement(raw.name, attributes, _copied_text(raw.text, reading), children, raw.line)


def _copied_text(text: str, reading: Reading) -> str:
    text = text.strip()
    # Old releases take every value through the same reader, which knows these two words.
    if not reading.is_new and text.lower() in ("true", "false"):
        return str(int(text.lower() == "true"))
    return text
