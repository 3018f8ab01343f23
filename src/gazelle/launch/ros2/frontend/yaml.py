"""launch_yaml: launch files in YAML."""

from __future__ import annotations

import os
from typing import Any

from gazelle.diagnostics import SourceSpan, did_you_mean
from gazelle.documents import read_text_limited
from gazelle.documents.yaml import Dialect, YamlError, read_yaml
from gazelle.launch.ros2.frontend.entity import Entity as BaseEntity
from gazelle.launch.ros2.frontend.parser import Parser as BaseParser
from gazelle.launch.ros2.frontend.type_utils import check_is_list_entity
from gazelle.launch.ros2.user_spans import keep_span
from gazelle.launch.ros2.utilities.type_utils import is_instance_of

__all__ = ["Entity", "Parser"]


_PLACED = Dialect(has_places=True)


class Entity(BaseEntity):
    """A key of a YAML launch file with its value."""

    def __init__(self, element: Any, type_name: str = "", *, parent: Entity | None = None) -> None:
        self.__element = element
        self.__type_name = type_name
        self.__parent = parent
        self.__read_keys: set[str] = set()
        self.__asked_keys: set[str] = set()
        self.__children_called = False
        self.span: SourceSpan | None = getattr(element, "span", None)
        if self.span is None and parent is not None:
            self.span = parent.span

    @property
    def type_name(self) -> str:
        """Its key."""
        return self.__type_name

    @property
    def parent(self) -> Entity | None:
        """The element around it."""
        return self.__parent

    @property
    def children(self) -> list[Any]:
        """The elements in its list, or in the list below its key ``children``.

        Raises:
            TypeError: its value is neither mapping nor list.
            ValueError: its mapping has no ``children``.
            RuntimeError: an item of the list is no mapping with one key.
        """
        self.__children_called = True
        items = self.__element
        if isinstance(items, dict):
            if "children" not in items:
                raise ValueError(
                    f"Expected entity `{self.type_name}` to have children entities. That can be a "
                    "list of subentities or a dictionary with a `children` list element"
                )
            self.__read_keys.add("children")
            items = items["children"]
        if not isinstance(items, list):
            kind = type(items).__name__
            raise TypeError(f"Expected a dict or list in `{self.type_name}`, got {kind}: {items}")
        return [self._child(item) for item in items]

    def _child(self, item: Any) -> Entity:
        if not isinstance(item, dict) or len(item) != 1:
            error = RuntimeError(
                "Subentities must be a dictionary with only one key, which is the entity type"
            )
            keep_span(error, getattr(item, "span", None) or self.span)
            raise error
        [(name, value)] = item.items()
        child = Entity(value, str(name), parent=self)
        child.span = getattr(item, "span", None)
        return child

    def assert_entity_completely_parsed(self) -> None:
        """Check that somebody asked for every key.

        Raises:
            ValueError: it has some that its kind does not know.
        """
        if isinstance(self.__element, list):
            if not self.__children_called:
                raise ValueError(
                    f"Unexpected nested entity(ies) found in `{self.type_name}`: {self.__element}"
                )
            return
        unread = set(self.__element) - self.__read_keys if isinstance(self.__element, dict) else ()
        if unread:
            wrong = sorted(map(str, unread))
            names = ", ".join(f"'{name}'" for name in wrong)
            text = f"Unexpected key(s) found in `{self.type_name}`: {{{names}}}"
            hint = did_you_mean(wrong[0], sorted(self.__asked_keys))
            raise ValueError(f"{text}; {hint}" if hint else text)

    def get_attr(
        self,
        name: str,
        *,
        data_type: Any = str,
        optional: bool = False,
        can_be_str: bool = True,
    ) -> Any:
        """Return a value; YAML's own type has to be the one asked for.

        Raises:
            AttributeError: it is not there.
            TypeError: it has another type.
        """
        self.__asked_keys.add(name)
        if not isinstance(self.__element, dict) or name not in self.__element:
            if optional:
                return None
            raise AttributeError(f"Can not find attribute '{name}' in Entity '{self.type_name}'")
        self.__read_keys.add(name)
        value = self.__element[name]
        if check_is_list_entity(data_type):
            if isinstance(value, list) and value and isinstance(value[0], dict):
                return [Entity(item, name, parent=self) for item in value]
            raise TypeError(
                f"Attribute '{name}' of Entity '{self.type_name}' "
                "expected to be a list of dictionaries."
            )
        if not is_instance_of(value, data_type, can_be_str=can_be_str):
            raise TypeError(
                f"Attribute '{name}' of Entity '{self.type_name}' expected to be of type "
                f"'{data_type}', got '{type(value)}'"
            )
        return value


class Parser(BaseParser):
    """Reads launch files in YAML."""

    @classmethod
    def load(cls, file: Any) -> tuple[Entity, Parser]:
        """Return the root of a file.

        Raises:
            OSError: the file cannot be read.
            YamlError: it is no YAML.
            RuntimeError: it has not one root.
        """
        if isinstance(file, str | bytes | os.PathLike):
            name = os.fsdecode(file)
            return cls.__of_text(read_text_limited(name), name)
        return cls.__of_text(file.read(), str(getattr(file, "name", "<string>")))

    @classmethod
    def __of_text(cls, text: str | bytes, name: str) -> tuple[Entity, Parser]:
        try:
            tree = read_yaml(text, name, _PLACED, name=name).value
        except YamlError as error:
            if error.problem.has_place:
                keep_span(error, error.problem.span)
            raise
        if not isinstance(tree, dict) or len(tree) != 1:
            problem = RuntimeError("Expected only one root")
            begin = SourceSpan(name, 1)
            keep_span(problem, getattr(tree, "span", None) or begin)
            raise problem
        [(name, value)] = tree.items()
        entity = Entity(value, str(name))
        entity.span = getattr(tree, "span", None)
        return entity, cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the extensions of such files."""
        return {"launch.yaml", "launch.yml", "yaml", "yml", "launch"}
