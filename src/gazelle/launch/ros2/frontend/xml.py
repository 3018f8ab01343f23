"""launch_xml: launch files in XML."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from gazelle.description.xml import Tag, attribute_span, parse_xml
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.launch.ros2.frontend.entity import Entity as BaseEntity
from gazelle.launch.ros2.frontend.parser import Parser as BaseParser
from gazelle.launch.ros2.frontend.type_utils import check_is_list_entity
from gazelle.launch.ros2.user_spans import keep_span
from gazelle.launch.ros2.utilities.type_utils import get_typed_value

__all__ = ["Entity", "Parser"]


class Entity(BaseEntity):
    """An XML element."""

    def __init__(self, xml_element: Tag, *, parent: Entity | None = None) -> None:
        self.__tag = xml_element
        self.__parent = parent
        self.__read_attributes: set[str] = set()
        self.__read_children: set[str] = set()
        self.span: SourceSpan | None = xml_element.span

    @property
    def type_name(self) -> str:
        """Its tag."""
        return self.__tag.name

    @property
    def parent(self) -> Entity | None:
        """The element around it."""
        return self.__parent

    @property
    def children(self) -> list[Any]:
        """The elements in it."""
        self.__read_children = {child.name for child in self.__tag.children}
        return [Entity(child, parent=self) for child in self.__tag.children]

    def assert_entity_completely_parsed(self) -> None:
        """Check that somebody asked for every attribute and child.

        Raises:
            ValueError: it has some that its tag does not know.
        """
        tag = self.__tag
        children = {child.name for child in tag.children} - self.__read_children
        if children:
            raise ValueError(f"Unexpected nested tag(s) found in `{tag.name}`: {_set(children)}")
        attributes = set(tag.attributes) - self.__read_attributes
        if attributes:
            first = sorted(attributes)[0]
            hint = did_you_mean(first, sorted(self.__read_attributes))
            text = f"Unexpected attribute(s) found in `{tag.name}`: {_set(attributes)}"
            error = ValueError(f"{text}; {hint}" if hint else text)
            keep_span(error, attribute_span(tag.span, first, whole=True))
            raise error

    def get_attr(
        self,
        name: str,
        *,
        data_type: Any = str,
        optional: bool = False,
        can_be_str: bool = True,
    ) -> Any:
        """Return an attribute; its text is read as the type wants.

        With ``name-sep`` beside it the text is a list with that between its items.

        Raises:
            AttributeError: it is not there.
            TypeError: its text does not fit the type.
        """
        if check_is_list_entity(data_type):
            found: Any = [Entity(one, parent=self) for one in self.__tag.find_all(name)] or None
            self.__read_children.add(name)
        else:
            found = self._value(name, data_type, can_be_str)
        if found is None and not optional:
            raise AttributeError(
                f"Attribute '{name}' of type '{data_type}' not found in Entity '{self.type_name}'"
            )
        return found

    def _value(self, name: str, data_type: Any, can_be_str: bool) -> Any:
        self.__read_attributes |= {name, f"{name}-sep"}
        attributes = self.__tag.attributes
        if name not in attributes:
            return None
        separator = attributes.get(f"{name}-sep")
        value = attributes[name] if separator is None else attributes[name].split(separator)
        try:
            return get_typed_value(value, data_type, can_be_str=can_be_str)
        except ValueError as problem:
            error = TypeError(
                f"Attribute '{name}' of Entity '{self.type_name}' expected to be of type "
                f"'{data_type}'.'{value}' can not be converted to one of those types"
            )
            keep_span(error, attribute_span(self.__tag.span, name))
            raise error from problem


class Parser(BaseParser):
    """Reads launch files in XML."""

    @classmethod
    def load(cls, file: Any) -> tuple[Entity, Parser]:
        """Return the root of a file.

        Raises:
            OSError: the file cannot be read.
            ValueError: it is no XML.
        """
        if isinstance(file, str | bytes | os.PathLike):
            name = os.fsdecode(file)
            text: Any = Path(name).read_bytes()
        else:
            name, text = str(getattr(file, "name", "<string>")), file.read()
        diagnostics = Diagnostics()
        root = parse_xml(text, name, diagnostics)
        if root is None:
            problem = diagnostics.errors[0]
            error = ValueError(f"{problem.span or name}: {problem.message}")
            keep_span(error, problem.span)
            raise error
        return Entity(root), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the extensions of such files."""
        return {"launch.xml", "xml", "launch"}


def _set(names: set[str]) -> str:
    return "{" + ", ".join(f"'{name}'" for name in sorted(names)) + "}"
