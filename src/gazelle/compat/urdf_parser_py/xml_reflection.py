"""Objects that are read from XML and written to it by a table of their attributes and elements."""

from __future__ import annotations

import copy
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path as FilePath
from typing import Any, ClassVar, Self
from xml.etree import ElementTree as ET

from gazelle.compat.urdf_parser_py.value_types import CORE, ParseError, Path, get_type, report
from gazelle.compat.urdf_parser_py.xml_text import (
    YamlReflection,
    node_add,
    xml_children,
    xml_string,
)

__all__ = [
    "AggregateElement",
    "Attribute",
    "Element",
    "Info",
    "Object",
    "Param",
    "Reflection",
    "reflect",
]


def _skips_defaults() -> bool:
    return bool(getattr(sys.modules.get(CORE), "skip_default", False))


class Param:
    """An attribute or element of an object.

    Attributes:
        xml_var: its name in the file.
        var: its name in Python.
        default: its value where the file has none.
    """

    type: str | None = None
    is_aggregate = False

    def __init__(
        self,
        xml_var: str,
        value_type: Any,
        required: bool = True,
        default: Any = None,
        var: str | None = None,
    ) -> None:
        assert not required or default is None, "Default does not make sense for a required field"
        self.xml_var = xml_var
        self.var = xml_var if var is None else var
        self.value_type = get_type(value_type)
        self.required = required
        self.default = default

    def set_default(self, obj: Any) -> None:
        """Give the object the default value."""
        if self.required:
            raise Exception(f"Required {self.type} not set in XML: {self.xml_var}")
        if not _skips_defaults():
            setattr(obj, self.var, copy.copy(self.default))

    def value_to_write(self, obj: Any) -> Any:
        """Return what the file says of an object: its value or the default, None for nothing."""
        value = getattr(obj, self.var)
        if value is not None:
            return value
        if self.required:
            said = "not set" if self.type == "attribute" else "not defined"
            raise Exception(f"Required {self.type} {said} in object: {self.var}")
        return None if _skips_defaults() else self.default


class Attribute(Param):
    """An attribute of an object."""

    type = "attribute"

    def set_from_string(self, obj: Any, value: str) -> None:
        """Set the variable from the attribute's text."""
        setattr(obj, self.var, self.value_type.from_string(value))

    def get_value(self, obj: Any) -> Any:
        """Return the variable."""
        return getattr(obj, self.var)

    def add_to_xml(self, obj: Any, node: ET.Element) -> None:
        """Write the attribute into the object's element."""
        value = self.value_to_write(obj)
        if value is not None:
            node.set(self.xml_var, self.value_type.to_string(value))


class Element(Param):
    """A child element of an object, there once."""

    type = "element"

    def __init__(
        self,
        xml_var: str,
        value_type: Any,
        required: bool = True,
        default: Any = None,
        var: str | None = None,
        is_raw: bool = False,
    ) -> None:
        super().__init__(xml_var, value_type, required, default, var)
        self.is_raw = is_raw

    def set_from_xml(self, obj: Any, node: ET.Element, path: Path | None) -> None:
        """Set the variable from the child."""
        setattr(obj, self.var, self.value_type.from_xml(node, path))

    def add_to_xml(self, obj: Any, parent: ET.Element) -> None:
        """Write the child into the object's element."""
        value = self.value_to_write(obj)
        if value is not None:
            self.add_scalar_to_xml(parent, value)

    def add_scalar_to_xml(self, parent: ET.Element, value: Any) -> None:
        """Write one value into the object's element."""
        node = parent if self.is_raw else node_add(parent, self.xml_var)
        assert node is not None
        self.value_type.write_xml(node, value)


class AggregateElement(Element):
    """A child element of an object, there any number of times."""

    is_aggregate = True

    def __init__(
        self, xml_var: str, value_type: Any, var: str | None = None, is_raw: bool = False
    ) -> None:
        super().__init__(xml_var, value_type, False, None, var or f"{xml_var}s", is_raw)

    def add_from_xml(self, obj: Any, node: ET.Element, path: Path | None) -> None:
        """Append the child to the object's list."""
        obj.add_aggregate(self.xml_var, self.value_type.from_xml(node, path))

    def set_default(self, obj: Any) -> None:
        """Leave the list as it is."""


class Info:
    """What of an element is not read yet: names of attributes, and children."""

    def __init__(self, node: ET.Element) -> None:
        self.attributes = list(node.attrib)
        self.children = xml_children(node)


def _with_path(path: Path | None, do: Callable[[], None]) -> None:
    """Do something; an error of it is told with the place."""
    try:
        do()
    except ParseError:
        raise
    except Exception as error:
        raise ParseError(error, path) from error


class Reflection:
    """The table of a class: its attributes and elements, after those of the class it is made of.

    Attributes:
        tag: the element's name when it stands alone.
        vars: the names of the variables.
    """

    def __init__(
        self, params: Sequence[Param] = (), parent_cls: Any = None, tag: str | None = None
    ) -> None:
        self.parent: Reflection | None = None if parent_cls is None else parent_cls.XML_REFL
        self.tag = tag
        self.elements = [one for one in params if isinstance(one, Element)]
        self.attributes = [one for one in params if isinstance(one, Attribute)]
        self.aggregates = [one for one in self.elements if isinstance(one, AggregateElement)]
        self.scalars = [one for one in self.elements if not one.is_aggregate]
        self.scalarNames = [one.xml_var for one in self.scalars]
        self.vars = [one.var for one in (*self.attributes, *self.elements)]
        self.attribute_map = {one.xml_var: one for one in self.attributes}
        self.element_map = {one.xml_var: one for one in self.elements}
        self.paramMap: dict[str, Param] = {**self.attribute_map, **self.element_map}
        self.required_attribute_names = [one.xml_var for one in self.attributes if one.required]
        self.required_element_names = [one.xml_var for one in self.elements if one.required]

    def set_from_xml(
        self, obj: Any, node: ET.Element, path: Path, info: Info | None = None
    ) -> Path:
        """Read an element into an object; the outermost tells what nothing reads."""
        left = Info(node) if info is None else info
        if self.parent is not None:
            path = self.parent.set_from_xml(obj, node, path, left)
        for attribute in self._read_attributes(obj, node, path, left):
            _with_path(path, partial(attribute.set_default, obj))
        for element in self._read_elements(obj, path, left):
            _with_path(path, partial(element.set_default, obj))
        if info is None:
            for name in left.attributes:
                report(f'Unknown attribute "{name}" in {path}')
            for child in left.children:
                report(f'Unknown tag "{child.tag}" in {path}')
        return path

    def _read_attributes(
        self, obj: Any, node: ET.Element, path: Path, left: Info
    ) -> list[Attribute]:
        """Read the attributes and return those that are not there."""
        for name in [one for one in left.attributes if one in self.attribute_map]:
            attribute = self.attribute_map[name]
            child_path = Path(path.tag, path.parent, f"{path.suffix}[@{name}]", path.tree)
            _with_path(child_path, partial(attribute.set_from_string, obj, node.attrib[name]))
            if name == "name":
                path.suffix = f"[@name='{attribute.get_value(obj)}']"
            left.attributes.remove(name)
        return [one for name, one in self.attribute_map.items() if name not in node.attrib]

    def _read_elements(self, obj: Any, path: Path, left: Info) -> list[Element]:
        """Read the children and return those that are not there."""
        unset = dict.fromkeys(self.scalarNames)
        for child in list(left.children):
            element = self.element_map.get(child.tag)
            if element is None:
                continue
            left.children.remove(child)
            child_path = Path(child.tag, path)
            if isinstance(element, AggregateElement):
                child_path.suffix = f"[{1 + len(obj.get_aggregate_list(child.tag))}]"
                element.add_from_xml(obj, child, child_path)
            elif child.tag in unset:
                del unset[child.tag]
                element.set_from_xml(obj, child, child_path)
            else:
                report(f"Scalar element defined multiple times: {child.tag}")
        return [self.element_map[name] for name in unset]

    def add_to_xml(self, obj: Any, node: ET.Element) -> None:
        """Write an object into its element."""
        if self.parent is not None:
            self.parent.add_to_xml(obj, node)
        for attribute in self.attributes:
            attribute.add_to_xml(obj, node)
        for scalar in self.scalars:
            scalar.add_to_xml(obj, node)
        if self.aggregates:
            obj.add_aggregates_to_xml(node)


class Object(YamlReflection):
    """An object that is read from XML and written to it.

    Attributes:
        aggregate_order: the members of its lists in the file's order.
        aggregate_type: the tag of each.
    """

    XML_REFL: ClassVar[Reflection | None] = None
    aggregate_order: list[Any]
    aggregate_type: dict[Any, str]

    @classmethod
    def _table(cls) -> Reflection:
        assert cls.XML_REFL is not None, f"{cls.__name__} has no reflection: call reflect"
        return cls.XML_REFL

    def get_refl_vars(self) -> list[str]:
        """Return the names of the variables that are written out."""
        return self._table().vars

    def check_valid(self) -> None:
        """Raise if the object is wrong; classes say how."""

    def pre_write_xml(self) -> None:
        """Make ready for being written; classes say how."""

    def post_read_xml(self) -> None:
        """Follow up on having been read; classes say how."""

    def write_xml(self, node: ET.Element) -> None:
        """Write the object into its element."""
        self.check_valid()
        self.pre_write_xml()
        self._table().add_to_xml(self, node)

    def to_xml(self) -> ET.Element:
        """Return the object as an element."""
        tag = self._table().tag
        assert tag is not None, "Must define 'tag' in reflection to use this function"
        node = ET.Element(tag)
        self.write_xml(node)
        return node

    def to_xml_string(self, addHeader: bool = True) -> str:
        """Return the object as text."""
        return xml_string(self.to_xml(), addHeader)

    def read_xml(self, node: ET.Element, path: Path) -> None:
        """Read an element into the object.

        Raises:
            ParseError: it says something wrong, or not enough.
        """
        self._table().set_from_xml(self, node, path)
        self.post_read_xml()
        _with_path(path, self.check_valid)

    @classmethod
    def from_xml(cls, node: ET.Element, path: Path) -> Self:
        """Return the object of an element."""
        made: Self = get_type(cls).from_xml(node, path)
        return made

    @classmethod
    def from_xml_string(cls, xml_string: str | bytes) -> Self:
        """Return the object of a text."""
        node = ET.fromstring(xml_string)  # noqa: S314 - the user's own file
        return cls.from_xml(node, Path(cls._table().tag, tree=ET.ElementTree(node)))

    @classmethod
    def from_xml_file(cls, file_path: str) -> Self:
        """Return the object of a file."""
        return cls.from_xml_string(FilePath(file_path).read_bytes())

    def parse(self, xml_string: str | bytes) -> Self:
        """Read a text into the object and return it."""
        node = ET.fromstring(xml_string)  # noqa: S314 - the user's own file
        self.read_xml(node, Path(self._table().tag, tree=ET.ElementTree(node)))
        return self

    def get_aggregate_list(self, xml_var: str) -> list[Any]:
        """Return the list of a tag."""
        values = getattr(self, self._table().paramMap[xml_var].var)
        assert isinstance(values, list)
        return values

    def aggregate_init(self) -> None:
        """Forget the order of the lists' members; a class with lists calls it when it is made."""
        self.aggregate_order = []
        self.aggregate_type = {}

    def add_aggregate(self, xml_var: str, obj: Any) -> None:
        """Append a member to the list of a tag."""
        self.get_aggregate_list(xml_var).append(obj)
        self.aggregate_order.append(obj)
        self.aggregate_type[obj] = xml_var

    def remove_aggregate(self, obj: Any) -> None:
        """Take a member out of its list."""
        self.aggregate_order.remove(obj)
        self.get_aggregate_list(self.aggregate_type.pop(obj)).remove(obj)

    def add_aggregates_to_xml(self, node: ET.Element) -> None:
        """Write the members of the lists in their order."""
        for value in self.aggregate_order:
            self._table().element_map[self.aggregate_type[value]].add_scalar_to_xml(node, value)

    def lump_aggregates(self) -> None:
        """Order the members by their lists."""
        self.aggregate_init()
        for param in self._table().aggregates:
            for value in self.get_aggregate_list(param.xml_var):
                self.aggregate_order.append(value)
                self.aggregate_type[value] = param.xml_var


def reflect(cls: type[Object], *args: Any, **kwargs: Any) -> None:
    """Give a class its table."""
    cls.XML_REFL = Reflection(*args, **kwargs)
