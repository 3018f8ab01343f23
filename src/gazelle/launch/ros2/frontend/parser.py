"""Launch files in markup: which reader takes a file, and what its elements become."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import io
import itertools
import os
import traceback
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.documents import read_text_limited
from gazelle.launch.ros2.frontend.entity import Entity
from gazelle.launch.ros2.frontend.expose import instantiate_action
from gazelle.launch.ros2.frontend.parse_substitution import (
    parse_if_substitutions,
    parse_substitution,
    replace_escaped_characters,
)
from gazelle.launch.ros2.invalid_launch_file_error import InvalidLaunchFileError
from gazelle.launch.ros2.substitution import Substitution
from gazelle.launch.ros2.user_spans import keep_span, written_at

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_description import LaunchDescription

__all__ = ["InvalidFrontendLaunchFileError", "Parser"]

_EXTENSIONS = "launch.frontend.launch_extension"
_PARSERS = "launch.frontend.parser"


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    """A launch file in markup cannot be read."""


class Parser:
    """Reads launch files in markup; the readers of XML and YAML are subclasses.

    Attributes:
        extensions_loaded: the actions and substitutions of other packages are known.
        frontend_parsers: readers by name, None before they are asked for.
    """

    extensions_loaded = False
    frontend_parsers: dict[str, type[Parser]] | None = None

    @classmethod
    def load_launch_extensions(cls) -> None:
        """Let packages that extend launch expose their actions and substitutions, once."""
        if Parser.extensions_loaded:
            return
        Parser.extensions_loaded = True
        importlib.import_module("gazelle.launch.ros2.actions")
        importlib.import_module("gazelle.launch.ros2.substitutions")
        if importlib.util.find_spec("gazelle.launch.ros2.launch_ros") is not None:
            importlib.import_module("gazelle.launch.ros2.launch_ros")
            importlib.import_module("gazelle.launch.ros2.ros_gz")
        _load(_EXTENSIONS)

    @classmethod
    def load_parser_implementations(cls) -> dict[str, type[Parser]]:
        """Return the readers by name: XML, YAML and those of installed packages."""
        if Parser.frontend_parsers is None:
            from gazelle.launch.ros2.frontend.xml import Parser as XmlParser
            from gazelle.launch.ros2.frontend.yaml import Parser as YamlParser

            found = {**_load(_PARSERS), "launch_xml": XmlParser, "launch_yaml": YamlParser}
            Parser.frontend_parsers = dict(sorted(found.items()))
        return Parser.frontend_parsers

    def parse_action(self, entity: Entity) -> Any:
        """Return the action that an element stands for."""
        self.load_launch_extensions()
        try:
            with written_at(entity.span):
                return instantiate_action(entity, self)
        except Exception as error:
            keep_span(error, entity.span)
            raise

    def parse_substitution(self, value: str) -> list[Substitution]:
        """Return what a text is made of."""
        self.load_launch_extensions()
        return parse_substitution(value)

    def parse_if_substitutions(self, value: Any) -> Any:
        """Return a value with the substitutions in its texts."""
        self.load_launch_extensions()
        return parse_if_substitutions(value)

    def escape_characters(self, value: str) -> str:
        """Return a text without the backslashes that escape characters."""
        return replace_escaped_characters(value)

    def parse_description(self, entity: Entity) -> LaunchDescription:
        """Return the description of a whole file.

        Raises:
            RuntimeError: the root is not ``launch``.
        """
        from gazelle.launch.ros2.launch_description import LaunchDescription

        try:
            if entity.type_name != "launch":
                raise RuntimeError("Expected 'launch' as root tag")
            deprecated = entity.get_attr("deprecated", optional=True)
            actions = [self.parse_action(child) for child in entity.children]
            entity.assert_entity_completely_parsed()
        except Exception as error:
            keep_span(error, entity.span)
            raise
        return LaunchDescription(actions, deprecated_reason=deprecated)

    @classmethod
    def get_available_extensions(cls) -> list[str]:
        """Return the names of the readers."""
        return list(cls.load_parser_implementations())

    @classmethod
    def is_extension_valid(cls, extension: str) -> bool:
        """Return whether a reader has this name (deprecated)."""
        warnings.warn(
            "Parser.is_extension_valid is deprecated, use Parser.is_filename_valid instead",
            stacklevel=2,
        )
        return extension in cls._by_extension()

    @classmethod
    def get_parser_from_extension(cls, extension: str) -> type[Parser]:
        """Return the reader of this name (deprecated).

        Raises:
            RuntimeError: there is none.
        """
        warnings.warn(
            "Parser.get_parser_from_extension is deprecated, "
            "use Parser.get_parsers_from_filename instead",
            stacklevel=2,
        )
        try:
            return cls._by_extension()[extension]
        except KeyError:
            raise RuntimeError("Not recognized frontend implementation") from None

    @classmethod
    def _by_extension(cls) -> dict[str, type[Parser]]:
        named = cls.load_parser_implementations()
        return {**named, **{name.removeprefix("launch_"): one for name, one in named.items()}}

    @classmethod
    def may_parse(cls, filename: str) -> bool:
        """Return whether a file has one of this reader's extensions."""
        return any(filename.endswith(f".{one}") for one in cls.get_file_extensions())

    @classmethod
    def is_filename_valid(cls, filename: str) -> bool:
        """Return whether any reader takes files with such a name."""
        return bool(cls.get_parsers_from_filename(filename))

    @classmethod
    def get_parsers_from_filename(cls, filename: str) -> list[type[Parser]]:
        """Return the readers that take files with such a name."""
        parsers = cls.load_parser_implementations().values()
        return [one for one in parsers if one.may_parse(filename)]

    @classmethod
    def get_file_extensions_from_parsers(cls) -> set[str]:
        """Return the extensions of all readers."""
        parsers = cls.load_parser_implementations().values()
        return set(itertools.chain.from_iterable(one.get_file_extensions() for one in parsers))

    @classmethod
    def load(cls, file: Any) -> tuple[Any, Parser]:
        """Return the root of a file and the reader that made sense of it.

        Args:
            file: a path, or an open file.

        Raises:
            OSError: the file cannot be read.
            InvalidFrontendLaunchFileError: no reader can make sense of it.
        """
        if isinstance(file, str | bytes | os.PathLike):
            return cls._load_stream(_opened(os.fsdecode(file)))
        return cls._load_stream(file)

    @classmethod
    def _load_stream(cls, stream: Any) -> tuple[Any, Parser]:
        name = str(getattr(stream, "name", ""))
        likely = cls.get_parsers_from_filename(name)
        others = [] if likely else list(cls.load_parser_implementations().values())
        errors: list[Exception] = []
        for parser in [*likely, *others]:
            try:
                return parser.load(stream)
            except Exception as error:  # noqa: BLE001 - told together when no reader succeeds
                errors.append(error)
                stream.seek(0)
        extension = Path(name).suffix[1:] if likely else ""
        raise InvalidFrontendLaunchFileError(extension, likely_errors=errors)

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the extensions of files that this reader takes."""
        return set()


def _opened(path: str) -> io.StringIO:
    """Return a file's text, which has an end, as an open file."""
    try:
        stream = io.StringIO(read_text_limited(path))
    except UnicodeDecodeError as error:
        extension = Path(path).suffix[1:]
        raise InvalidFrontendLaunchFileError(extension, likely_errors=[error]) from error
    stream.name = path
    return stream


def _load(group: str) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for entry_point in importlib.metadata.entry_points(group=group):
        try:
            found[entry_point.name] = entry_point.load()
        except Exception:  # noqa: BLE001 - a stranger's code, and others go on
            warnings.warn(
                f"Failed to load the extension: {entry_point.name}\n{traceback.format_exc()}",
                stacklevel=2,
            )
    return found
