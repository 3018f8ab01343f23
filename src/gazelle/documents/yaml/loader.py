"""PyYAML's safe loader with bounds of length, nesting, aliases and numbers; for this package."""

from __future__ import annotations

import sys
from typing import Any

import yaml

from gazelle.documents.files import HOW_TO_RAISE, LimitError, scaled

__all__ = [
    "MAX_CHARACTERS",
    "LimitedLoader",
    "YamlDepthError",
    "YamlLengthError",
    "YamlLimitError",
]

MAX_CHARACTERS = 8 << 20
"""Length of the longest YAML text that is read."""

_MAX_NODES = 1_000_000
_MAX_DEPTH = 64
# Python prints no whole number that has more decimal digits.
_MAX_DIGITS = sys.int_info.default_max_str_digits
_BITS_OF_A_DIGIT = 3.32
# What PyYAML's constructors, and those of ROS's angles, let through.
_UNREADABLE: tuple[type[Exception], ...]
_UNREADABLE = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, SyntaxError)
_UNREADABLE += (LimitError, NameError)


class YamlLimitError(yaml.MarkedYAMLError):
    """What aliases stand for is too much, or goes on without end."""


class YamlLengthError(YamlLimitError):
    """The text is too long."""


class YamlDepthError(YamlLimitError):
    """Lists and mappings are nested too deep."""


class LimitedLoader(yaml.SafeLoader):
    """PyYAML's safe loader; whatever is wrong with a text is a ``yaml.YAMLError``."""

    def __init__(self, stream: str | bytes) -> None:
        """Check the length of a text; see ``yaml.SafeLoader``."""
        if len(stream) > scaled(MAX_CHARACTERS):
            text = _above(f"{len(stream)} characters", scaled(MAX_CHARACTERS))
            raise YamlLengthError(None, None, text)
        self._depth = 0
        self._most_nodes = scaled(_MAX_NODES)
        self._nodes = 0
        self._nodes_of_documents = 0
        super().__init__(stream)

    def fetch_more_tokens(self) -> None:
        """Scan on; a tab is called one."""
        try:
            super().fetch_more_tokens()
        except yaml.MarkedYAMLError as error:
            if "'\\t'" in (error.problem or ""):
                error.problem = f"{error.problem}: this is a tab, YAML is indented with spaces"
            raise

    def fetch_flow_collection_start(self, TokenClass: Any) -> None:
        """Scan ``[`` or ``{`` unless it is nested too deep: PyYAML looks far ahead, slowly."""
        if self.flow_level >= _MAX_DEPTH:
            raise _too_deep(self.get_mark())
        super().fetch_flow_collection_start(TokenClass)

    def compose_node(self, parent: Any, index: Any) -> Any:
        """Compose a node unless it is nested too deep, or one too many."""
        self._depth += 1
        self._nodes += 1
        if self._depth > _MAX_DEPTH:
            place = self.peek_event().start_mark  # type: ignore[no-untyped-call]
            raise _too_deep(place)
        if self._nodes > self._most_nodes:
            place = self.peek_event().start_mark  # type: ignore[no-untyped-call]
            text = _above(f"{self._nodes} values and more", self._most_nodes)
            raise YamlLengthError(None, None, text, place)
        node = super().compose_node(parent, index)
        self._depth -= 1
        return node

    def compose_document(self) -> Any:
        """Compose a document, and check what its aliases make of it and of those before."""
        root: Any = super().compose_document()
        self._nodes_of_documents += _size(root, {}, ())
        if self._nodes_of_documents > self._most_nodes:
            count = self._nodes_of_documents
            text = _above(f"{count} values, aliases followed", self._most_nodes)
            raise YamlLimitError(None, None, text, root.start_mark)
        return root

    def construct_object(self, node: yaml.Node, deep: bool = False) -> Any:
        """Construct a value; numbers and dates that are none are errors of the YAML."""
        try:
            return super().construct_object(node, deep=deep)
        except _UNREADABLE as error:
            text = f"this value cannot be read: {error}"
            raise yaml.constructor.ConstructorError(None, None, text, node.start_mark) from error

    def construct_yaml_int(self, node: yaml.ScalarNode) -> int:
        """Construct a whole number that can be printed again."""
        # One of base 60 takes the square of its length.
        if len(node.value) > 2 * _MAX_DIGITS and ":" in node.value:
            raise ValueError(f"a whole number of {len(node.value)} characters")
        found: int = super().construct_yaml_int(node)
        if found.bit_length() > _MAX_DIGITS * _BITS_OF_A_DIGIT:
            raise ValueError(f"a whole number of {found.bit_length()} binary digits")
        return found


LimitedLoader.add_constructor("tag:yaml.org,2002:int", LimitedLoader.construct_yaml_int)


def _size(node: Any, known: dict[int, int], around: tuple[int, ...]) -> int:
    """Return how many values a node stands for."""
    if not isinstance(node, yaml.CollectionNode):
        return 1
    own = id(node)
    if own in around:
        text = "an alias stands inside the very list or mapping that it names"
        raise YamlLimitError(None, None, text, node.start_mark)
    if own not in known:
        inner = (*around, own)
        pairs = (
            node.value if isinstance(node, yaml.MappingNode) else [(item,) for item in node.value]
        )
        known[own] = 1 + sum(_size(item, known, inner) for pair in pairs for item in pair)
    return known[own]


def _too_deep(place: Any) -> YamlDepthError:
    return YamlDepthError(
        None, None, f"lists and mappings are nested deeper than {_MAX_DEPTH}", place
    )


def _above(what: str, most: int) -> str:
    return f"{what} are above the limit of {most}; {HOW_TO_RAISE}"
