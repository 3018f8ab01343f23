"""YAML whose aliases, nesting and scalars do no harm."""

from __future__ import annotations

from typing import Any

import yaml

from gazelle.limits.scale import HOW_TO_RAISE, LimitError, scaled

__all__ = ["LimitedLoader", "YamlLimitError", "load_yaml", "load_yaml_documents"]

_MOST_CHARACTERS = 8 << 20
_MOST_NODES = 1_000_000
_DEEPEST = 64
# What PyYAML's constructors, and those of ROS's angles, let through.
_UNREADABLE: tuple[type[Exception], ...]
_UNREADABLE = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError, SyntaxError)
_UNREADABLE += (LimitError, NameError)


class YamlLimitError(yaml.MarkedYAMLError):
    """The text is too long, too deep, or its aliases stand for too much."""


class LimitedLoader(yaml.SafeLoader):
    """PyYAML's safe loader; whatever is wrong with a text is a ``yaml.YAMLError``."""

    def __init__(self, stream: Any) -> None:
        """Check the length of a text; see ``yaml.SafeLoader``."""
        if isinstance(stream, str | bytes) and len(stream) > scaled(_MOST_CHARACTERS):
            raise _error(f"{len(stream)} characters", scaled(_MOST_CHARACTERS), None)
        self._depth = 0
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
        if self.flow_level >= _DEEPEST:
            raise _too_deep(self.get_mark())
        super().fetch_flow_collection_start(TokenClass)

    def compose_node(self, parent: Any, index: Any) -> Any:
        """Compose a node unless it is nested too deep."""
        self._depth += 1
        if self._depth > _DEEPEST:
            place = self.peek_event().start_mark  # type: ignore[no-untyped-call]
            raise _too_deep(place)
        node = super().compose_node(parent, index)
        self._depth -= 1
        return node

    def compose_document(self) -> Any:
        """Compose a document, and check what its aliases make of it."""
        root: Any = super().compose_document()
        size = _size(root, {}, ())
        if size > scaled(_MOST_NODES):
            raise _error(f"{size} values, aliases followed", scaled(_MOST_NODES), root.start_mark)
        return root

    def construct_object(self, node: yaml.Node, deep: bool = False) -> Any:
        """Construct a value; numbers and dates that are none are errors of the YAML."""
        try:
            return super().construct_object(node, deep=deep)
        except _UNREADABLE as error:
            text = f"this value cannot be read: {error}"
            raise yaml.constructor.ConstructorError(None, None, text, node.start_mark) from error


def load_yaml(text: str | bytes) -> Any:
    """Return the value of a YAML text, as ``yaml.safe_load`` does.

    Raises:
        yaml.YAMLError: it is not YAML, or above a limit.
    """
    return yaml.load(text, Loader=LimitedLoader)  # noqa: S506 - a safe loader


def load_yaml_documents(text: str) -> list[Any]:
    """Return the values of all documents of a YAML text, as ``yaml.safe_load_all`` does.

    Raises:
        yaml.YAMLError: it is not YAML, or above a limit.
    """
    return list(yaml.load_all(text, Loader=LimitedLoader))


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


def _too_deep(place: Any) -> YamlLimitError:
    return YamlLimitError(
        None, None, f"lists and mappings are nested deeper than {_DEEPEST}", place
    )


def _error(what: str, most: int, place: Any) -> YamlLimitError:
    return YamlLimitError(
        None, None, f"{what} are above the limit of {most}; {HOW_TO_RAISE}", place
    )
