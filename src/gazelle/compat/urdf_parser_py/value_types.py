"""How text and elements of a robot's XML become Python values and back."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from typing import Any
from xml.etree import ElementTree as ET

from gazelle.compat.urdf_parser_py.xml_text import xml_children

__all__ = [
    "BasicType",
    "DuckTypedFactory",
    "FactoryType",
    "ListType",
    "ObjectType",
    "ParseError",
    "Path",
    "RawType",
    "SimpleElementType",
    "ValueType",
    "VectorType",
    "add_type",
    "end_namespace",
    "get_type",
    "make_type",
    "on_error_stderr",
    "report",
    "start_namespace",
    "value_types",
]

CORE = "urdf_parser_py.xml_reflection.core"
value_types: dict[Any, ValueType] = {}
_NAMESPACE = [""]


def on_error_stderr(message: str) -> None:
    """Print what is wrong with a file; a user's program may put another function in its place."""
    sys.stderr.write(message + "\n")


def report(message: str, module: str = CORE) -> None:
    """Tell what is wrong with a file, with the ``on_error`` that a user's program has set."""
    tell = getattr(sys.modules.get(module), "on_error", on_error_stderr)
    tell(message)


class Path:
    """Where in the file a value stands, written as XPath."""

    def __init__(
        self,
        tag: str | None,
        parent: Path | None = None,
        suffix: str = "",
        tree: ET.ElementTree | None = None,
    ) -> None:
        self.tag = tag
        self.parent = parent
        self.suffix = suffix
        self.tree = tree

    def __str__(self) -> str:
        if self.parent is not None:
            return f"{self.parent}/{self.tag}{self.suffix}"
        return f"/{self.tag}{self.suffix}" if self.tag else self.suffix


class ParseError(Exception):
    """A robot's XML cannot be read.

    Attributes:
        e: why.
        path: where.
    """

    def __init__(self, e: Exception, path: Path | None) -> None:
        super().__init__(f"ParseError in {path}:\n{e}")
        self.e = e
        self.path = path


def start_namespace(namespace: str) -> None:
    """Keep the names of types that are added from now on apart from others'."""
    _NAMESPACE[0] = f"{namespace}."


def end_namespace() -> None:
    """Add types for everybody again."""
    _NAMESPACE[0] = ""


def _key(key: Any) -> Any:
    return _NAMESPACE[0] + key if isinstance(key, str) else key


def add_type(key: Any, value: ValueType) -> None:
    """Give a type a name."""
    assert _key(key) not in value_types, f"type {key} is there already"
    value_types[_key(key)] = value


def get_type(cur_type: Any) -> ValueType:
    """Return the type of a name or a class; it is made and kept when there is none."""
    for key in (_key(cur_type), cur_type):
        if key in value_types:
            return value_types[key]
    made = make_type(cur_type)
    add_type(cur_type, made)
    return made


def make_type(cur_type: Any) -> ValueType:
    """Return a type for ``vectorN``, a class of text or numbers, or a class of objects."""
    if isinstance(cur_type, ValueType):
        return cur_type
    if isinstance(cur_type, str):
        if not cur_type.startswith("vector"):
            raise Exception(f"Invalid value type: {cur_type}")
        count = cur_type.removeprefix("vector")
        return VectorType(float(count) if count else None)
    if cur_type is list:
        return ListType()
    if hasattr(cur_type, "XML_REFL"):
        return ObjectType(cur_type)
    if cur_type in (str, float):
        return BasicType(cur_type)
    raise Exception(f"Invalid type: {cur_type}")


class ValueType:
    """A type of value: its text, or its element."""

    def from_string(self, value: Any) -> Any:
        """Return the value of a text."""
        raise NotImplementedError(f"{type(self).__name__} has no from_string")

    def to_string(self, value: Any) -> str:
        """Return the text of a value."""
        raise NotImplementedError(f"{type(self).__name__} has no to_string")

    def from_xml(self, node: ET.Element, path: Path | None) -> Any:
        """Return the value of an element."""
        return self.from_string(node.text)

    def write_xml(self, node: ET.Element, value: Any) -> None:
        """Write a value into its element."""
        node.text = self.to_string(value)

    def equals(self, a: Any, b: Any) -> bool:
        """Tell whether two values are the same."""
        return bool(a == b)


class BasicType(ValueType):
    """Text, or a number."""

    def __init__(self, cur_type: Any) -> None:
        self.type = cur_type

    def to_string(self, value: Any) -> str:
        """Return the value's text."""
        return str(value)

    def from_string(self, value: Any) -> Any:
        """Return the text's value."""
        return self.type(value)


class ListType(ValueType):
    """Words with spaces between them."""

    def to_string(self, values: Sequence[Any]) -> str:
        """Return the words in one text."""
        return " ".join(values)

    def from_string(self, text: str) -> list[Any]:
        """Return the words of a text."""
        return text.split()

    def equals(self, aValues: Sequence[Any], bValues: Sequence[Any]) -> bool:
        """Tell whether the words are the same."""
        return list(aValues) == list(bValues)


class VectorType(ListType):
    """Numbers with spaces between them.

    Attributes:
        count: how many there have to be, None for any number.
    """

    def __init__(self, count: float | None = None) -> None:
        self.count = count

    def check(self, values: Sequence[Any]) -> None:
        """Raise AssertionError if it is another number of numbers."""
        assert self.count in (None, len(values)), "Invalid vector length"

    def to_string(self, values: Sequence[Any]) -> str:
        """Return the numbers in one text."""
        self.check(values)
        return super().to_string([str(value) for value in values])

    def from_string(self, text: str) -> list[Any]:
        """Return the numbers of a text."""
        tokens = super().from_string(text)
        self.check(tokens)
        return [float(token) for token in tokens]


class RawType(ValueType):
    """An element as it is."""

    def from_xml(self, node: ET.Element, path: Path | None) -> ET.Element:
        """Return the element."""
        return node

    def write_xml(self, node: ET.Element, value: ET.Element) -> None:
        """Put the attributes, the text and the children of an element into another."""
        node.text = value.text
        node.attrib.update(value.attrib)
        node.extend(xml_children(value))


class SimpleElementType(ValueType):
    """An element that is known by one attribute.

    Attributes:
        attribute: its name.
        value_type: its type.
    """

    def __init__(self, attribute: str, value_type: Any) -> None:
        self.attribute = attribute
        self.value_type = get_type(value_type)

    def from_xml(self, node: ET.Element, path: Path | None) -> Any:
        """Return the attribute's value."""
        return self.value_type.from_string(node.get(self.attribute))

    def write_xml(self, node: ET.Element, value: Any) -> None:
        """Set the attribute."""
        node.set(self.attribute, self.value_type.to_string(value))


class ObjectType(ValueType):
    """An element that is an object of a class."""

    def __init__(self, cur_type: Any) -> None:
        self.type = cur_type

    def from_xml(self, node: ET.Element, path: Path | None) -> Any:
        """Make an object and read the element into it."""
        made = self.type()
        made.read_xml(node, path)
        return made

    def write_xml(self, node: ET.Element, obj: Any) -> None:
        """Write the object into its element."""
        obj.write_xml(node)


class FactoryType(ValueType):
    """An element whose tag says what it is.

    Attributes:
        typeMap: the types by tag; `nameMap` is the other way round.
    """

    def __init__(self, name: str, typeMap: Mapping[str, Any]) -> None:
        self.name = name
        self.typeMap = typeMap
        self.nameMap = {value: key for key, value in typeMap.items()}

    def from_xml(self, node: ET.Element, path: Path | None) -> Any:
        """Return the value of an element."""
        if node.tag not in self.typeMap:
            raise Exception(f"Invalid {self.name} tag: {node.tag}")
        return get_type(self.typeMap[node.tag]).from_xml(node, path)

    def get_name(self, obj: object) -> str:
        """Return the tag of an object."""
        if type(obj) not in self.nameMap:
            raise Exception(f"Invalid {self.name} type: {type(obj)}")
        return self.nameMap[type(obj)]

    def write_xml(self, node: ET.Element, obj: Any) -> None:
        """Write the object into its element."""
        obj.write_xml(node)


class DuckTypedFactory(ValueType):
    """An element that is of the first type that can read it.

    Attributes:
        type_order: the types.
    """

    def __init__(self, name: str, typeOrder: Sequence[Any]) -> None:
        assert typeOrder, "no types"
        self.name = name
        self.type_order = typeOrder

    def from_xml(self, node: ET.Element, path: Path | None) -> Any:
        """Return the value of an element.

        Raises:
            ParseError: no type can read it.
        """
        told = "Could not perform duck-typed parsing."
        for value_type in self.type_order:
            try:
                return value_type.from_xml(node, path)
            except Exception as error:  # noqa: BLE001 - a type says no by any error
                told += f"\nValue Type: {value_type}\nException: {error}\n"
        raise ParseError(Exception(told), path)

    def write_xml(self, node: ET.Element, obj: Any) -> None:
        """Write the object into its element."""
        obj.write_xml(node)


add_type("element_name", SimpleElementType("name", str))
add_type("element_value", SimpleElementType("value", float))
for _vector in ("vector3", "vector4", "vector6"):
    get_type(_vector)
