"""Reading YAML: a text becomes nodes with places, values, or the problem it has."""

from __future__ import annotations

import os
from functools import cached_property
from typing import Any

import yaml

from gazelle.documents.files import read_text_limited
from gazelle.documents.yaml.dialects import YAML_1_1, Dialect, loader_of
from gazelle.documents.yaml.nodes import YamlNode, node_of
from gazelle.documents.yaml.problems import YamlError, YamlProblem, problem_of

__all__ = [
    "YamlDocument",
    "load_yaml",
    "load_yaml_documents",
    "load_yaml_file",
    "read_yaml",
    "read_yaml_documents",
    "read_yaml_file",
    "value_of",
]

_TEXT = "<unicode string>"
_MERGE = "<<"


class YamlDocument:
    """One document of a YAML text.

    Attributes:
        file: the file's name, for places.
        dialect: how its plain texts become values.
        problem: what is wrong with the text, None for a document that is whole. Values are looked
            at when they are asked for.
    """

    def __init__(
        self,
        file: str,
        dialect: Dialect,
        composed: yaml.Node | None = None,
        problem: YamlProblem | None = None,
    ) -> None:
        self.file = file
        self.dialect = dialect
        self.problem = problem
        self._composed = composed

    @cached_property
    def root(self) -> YamlNode | None:
        """The outermost node; None for an empty document and one with a problem."""
        return None if self._composed is None else node_of(self._composed, self.file)

    @cached_property
    def value(self) -> Any:
        """The value of all of it, as ``yaml.safe_load`` has it.

        Raises:
            YamlError: the text has a problem, or a value that cannot be read.
        """
        if self.problem is not None:
            raise YamlError(self.problem)
        if self._composed is None:
            return None
        # PyYAML puts what is merged into its nodes; ours stay as they are written.
        _ = self.root if _has_merge(self._composed) else None
        loader = loader_of(self.dialect)("")
        try:
            return loader.construct_document(self._composed)
        except yaml.YAMLError as error:
            raise YamlError(problem_of(error, self.file)) from error

    def value_of(self, node: YamlNode) -> Any:
        """Return the value of one of its nodes; see `value_of`."""
        return value_of(node, self.dialect)


def read_yaml(
    text: str | bytes, file: str = _TEXT, dialect: Dialect = YAML_1_1, *, name: str = _TEXT
) -> YamlDocument:
    """Read a text that holds one document; whatever is wrong with it is told in the result.

    Args:
        text: YAML; bytes are UTF-8 or UTF-16.
        file: the file's name, for places.
        dialect: how plain texts become values.
        name: the text's name where a problem is printed as PyYAML does.
    """
    loader = loader_of(dialect)
    try:
        reader = loader(text)
        reader.name = name if isinstance(text, str) else reader.name
        return YamlDocument(file, dialect, reader.get_single_node())
    except yaml.YAMLError as error:
        return YamlDocument(file, dialect, problem=problem_of(error, file))


def read_yaml_documents(
    text: str, file: str = _TEXT, dialect: Dialect = YAML_1_1
) -> tuple[YamlDocument, ...]:
    """Read all documents of a text; the first one with a problem is the last one read.

    Args:
        text: YAML.
        file: the file's name, for places.
        dialect: how plain texts become values.
    """
    found: list[YamlDocument] = []
    try:
        reader = loader_of(dialect)(text)
        while reader.check_node():
            found.append(YamlDocument(file, dialect, reader.get_node()))
    except yaml.YAMLError as error:
        found.append(YamlDocument(file, dialect, problem=problem_of(error, file)))
    return tuple(found)


def read_yaml_file(path: str | os.PathLike[str], dialect: Dialect = YAML_1_1) -> YamlDocument:
    """Read a file that holds one document; whatever is wrong with it is told in the result."""
    file = os.fspath(path)
    try:
        text = read_text_limited(path)
    except (OSError, UnicodeDecodeError) as error:
        return YamlDocument(file, dialect, problem=problem_of(error, file))
    return read_yaml(text, file, dialect)


def load_yaml(text: str | bytes, dialect: Dialect = YAML_1_1) -> Any:
    """Return the value of a YAML text, as ``yaml.safe_load`` does.

    Raises:
        YamlError: it is not YAML, or above a limit.
    """
    return read_yaml(text, dialect=dialect).value


def load_yaml_documents(text: str, dialect: Dialect = YAML_1_1) -> list[Any]:
    """Return the values of all documents of a YAML text, as ``yaml.safe_load_all`` does.

    Raises:
        YamlError: it is not YAML, or above a limit.
    """
    return [one.value for one in read_yaml_documents(text, dialect=dialect)]


def load_yaml_file(path: str | os.PathLike[str], dialect: Dialect = YAML_1_1) -> Any:
    """Return the value of a YAML file.

    Raises:
        YamlError: it cannot be read, is not UTF-8, not YAML, or above a limit.
    """
    return read_yaml_file(path, dialect).value


def value_of(node: YamlNode, dialect: Dialect = YAML_1_1) -> Any:
    """Return the value that a node has by itself.

    Raises:
        YamlError: it has none.
    """
    loader = loader_of(dialect)("")
    try:
        return loader.construct_object(node.composed, deep=True)
    except yaml.YAMLError as error:
        raise YamlError(problem_of(error, node.span.file)) from error


def _has_merge(composed: yaml.Node) -> bool:
    text = composed.start_mark.buffer
    return text is None or _MERGE in text
