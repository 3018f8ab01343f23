"""YAML files of generate_parameter_library, read: parameters, structures, and maps by keys."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.yaml import YamlDocument, YamlMapping, YamlNode, read_yaml_file
from gazelle.errors import UserFileError

__all__ = ["Leaf", "MapOf", "ParameterFile", "Structure", "Validation", "read_parameter_file"]

_CODE = "interfaces.parameter-file"
_FIXED = re.compile(r"(?P<base>\w+?)_fixed_(?P<size>\d+)")
_BASES = {
    "bool": "bool",
    "double": "double",
    "int": "int64_t",
    "string": "std::string",
    "byte": "uint8_t",
}
_MAP = "__map_"


@dataclass(frozen=True, slots=True)
class Validation:
    """One function that checks a value.

    Attributes:
        name: such as ``bounds``, or ``my_package::positive``.
        is_typed: whether the function gets the parameter's type.
        arguments: as YAML has them.
    """

    name: str
    is_typed: bool
    arguments: tuple[Any, ...]


@dataclass(frozen=True, slots=True)
class Leaf:
    """One parameter.

    Attributes:
        name: of the member.
        element: C++ type of one value.
        is_array: whether it holds several.
        size: the most that a fixed string or array holds, 0 for others.
        has_default: whether the file gives a value.
        default: the value.
        description: for people.
        additional_constraints: for people, too.
        read_only: whether it is set at the start only.
        validations: in the file's order.
    """

    name: str
    element: str
    is_array: bool
    size: int
    has_default: bool
    default: Any
    description: str
    additional_constraints: str
    read_only: bool
    validations: tuple[Validation, ...]


@dataclass(frozen=True, slots=True)
class MapOf:
    """A structure for each key that a parameter of texts holds.

    Attributes:
        keys: name of that parameter; the member is called ``<keys>_map``.
        inside: what each key has.
    """

    keys: str
    inside: Structure


@dataclass(frozen=True, slots=True)
class Structure:
    """Parameters, structures and maps, in the file's order.

    Attributes:
        name: of the member, empty for the outermost.
        leaves: its parameters.
        structures: inside of it.
        maps: inside of it.
    """

    name: str
    leaves: tuple[Leaf, ...]
    structures: tuple[Structure, ...]
    maps: tuple[MapOf, ...]


@dataclass(frozen=True, slots=True)
class ParameterFile:
    """A whole file.

    Attributes:
        namespace: in C++.
        root: all parameters.
    """

    namespace: str
    root: Structure


def read_parameter_file(file: Path) -> ParameterFile:
    """Read a file of generate_parameter_library.

    Raises:
        UserFileError: it is not one; says where.
    """
    document = read_yaml_file(file)
    reader = _Reader(document, str(file))
    if (problem := document.problem) is not None:
        reader.report(problem.what, problem.span, problem.fix)
    root = document.root
    if not isinstance(root, YamlMapping) or len(root.pairs) != 1:
        reader.report("it has one outermost key, the namespace in C++", SourceSpan(str(file), 1))
        raise UserFileError(tuple(reader.diagnostics))
    key, value = root.pairs[0]
    structure = reader.structure("", value, key)
    reader.diagnostics.raise_if_errors()
    return ParameterFile(key.text, structure)


class _Reader:
    """Collects what is wrong with a file while it is read."""

    def __init__(self, document: YamlDocument, file: str) -> None:
        self.diagnostics = Diagnostics()
        self._document = document
        self._file = file

    def report(self, text: str, span: SourceSpan, fix: str = "") -> None:
        """Collect an error; raise where nothing can be read any more."""
        self.diagnostics.report(_CODE, text, span, fix=fix)
        if not isinstance(self._document.root, YamlMapping):
            self.diagnostics.raise_if_errors()

    def structure(self, name: str, node: YamlNode, key: YamlNode) -> Structure:
        """Return what is below a key that is no parameter itself."""
        if not isinstance(node, YamlMapping):
            self.report(
                f"'{key.text}' is neither a parameter nor a group of parameters",
                key.span,
                "write 'type:' and the like below it",
            )
            return Structure(name, (), (), ())
        leaves: list[Leaf] = []
        structures: list[Structure] = []
        maps: list[MapOf] = []
        for inner_key, value in node.pairs:
            text = inner_key.text
            if text.startswith(_MAP):
                keys = text.removeprefix(_MAP)
                maps.append(MapOf(keys, self.structure(text, value, inner_key)))
            elif _is_leaf(value):
                leaves += self._leaf(text, value, inner_key)
            else:
                structures.append(self.structure(text, value, inner_key))
        return Structure(name, tuple(leaves), tuple(structures), tuple(maps))

    def _leaf(self, name: str, node: YamlNode, key: YamlNode) -> Iterator[Leaf]:
        said: dict[str, Any] = self._document.value_of(node)
        kind = str(said["type"])
        if kind == "none":
            return  # for people only
        fixed = _FIXED.fullmatch(kind)
        base = fixed["base"] if fixed else kind
        is_array = base.endswith("_array")
        element = _BASES.get(base.removesuffix("_array"))
        if element is None:
            self.report(f"'{name}': type '{kind}' is not known", key.span, _KNOWN_TYPES)
            return
        default = said.get("default_value")
        has_default = "default_value" in said
        if has_default and is_array != isinstance(default, list):
            what = "a list" if is_array else "one value"
            self.report(f"'{name}': the default_value of {kind} is {what}", key.span)
            return
        yield Leaf(
            name,
            element,
            is_array,
            int(fixed["size"]) if fixed else 0,
            has_default,
            default,
            str(said.get("description", "")),
            str(said.get("additional_constraints", "")),
            bool(said.get("read_only", False)),
            tuple(_validations(said.get("validation") or {})),
        )


_KNOWN_TYPES = "write bool, int, double, string, one of these with _array, or with _fixed_N"


def _is_leaf(node: YamlNode) -> bool:
    if not isinstance(node, YamlMapping):
        return False
    pair = node.pair("type")
    return pair is not None and not isinstance(pair[1], YamlMapping)


def _validations(said: dict[str, Any]) -> Iterator[Validation]:
    for name, value in said.items():
        is_typed = str(name).endswith("<>")
        arguments = value if isinstance(value, list) else [] if value is None else [value]
        yield Validation(str(name).removesuffix("<>"), is_typed, tuple(arguments))
