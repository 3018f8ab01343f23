"""Controllers that parameter files describe, whatever namespace they are in."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import yaml

from gazelle.control.controllers.registry import controller_class
from gazelle.control.parameters import ControllerParameters, flattened, nested
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.parameters.document import Document, plain
from gazelle.doctor.parameters.layouts import MARK, Layout

__all__ = ["FoundController", "FoundControllers", "check_controllers", "controllers_in"]

_MANAGER = "controller_manager"
_KINDS = {"number": "double", "integer": "integer", "numbers": "double_array"}


@dataclass(frozen=True, slots=True)
class FoundController:
    """A controller in a file.

    Attributes:
        name: without namespace.
        full_name: with the names above it, for messages about ROS 1 parameters.
        tree: its parameters.
        nodes: where each leaf stands, by its name with dots.
        span: where its type stands.
    """

    name: str
    full_name: str
    type: str
    generation: int
    tree: Mapping[str, Any]
    nodes: Mapping[str, tuple[yaml.Node, SourceSpan]] = field(repr=False)
    span: SourceSpan


def controllers_in(document: Document, layout: Layout) -> tuple[FoundController, ...]:
    """Return the controllers of a file, in its order."""
    if layout is Layout.ROS2:
        return tuple(_of_ros2(document))
    if layout is Layout.ROS1:
        return tuple(_of_ros1(document, document.root, ()))
    return ()


def check_controllers(found: Iterable[FoundController], diagnostics: Diagnostics) -> None:
    """Report keys that a controller does not know, and types that ROS 2 does not take."""
    for item in found:
        kind = controller_class(item.type)
        if kind is None:
            continue
        prefix = f"{item.full_name}/" if item.generation == 1 else ""
        parameters = ControllerParameters(
            item.name,
            item.tree,
            kind.TABLE,
            diagnostics,
            full_name=partial(_full, prefix),
            place=partial(_place, item.nodes),
        )
        parameters.report_unknown()
        if item.generation == 2:
            _check_types(item, diagnostics)


class FoundControllers:
    """The controllers found as a source of parameters, for the checks of the control layer."""

    def __init__(self, found: Iterable[FoundController]) -> None:
        self._found = {item.name: item for item in found}

    def controllers(self) -> tuple[str, ...]:
        """Return their names."""
        return tuple(self._found)

    def controller_type(self, controller: str) -> str | None:
        """Return a controller's type."""
        return self._found[controller].type if controller in self._found else None

    def tree(self, controller: str) -> Mapping[str, Any]:
        """Return a controller's parameters."""
        return self._found[controller].tree if controller in self._found else {}

    def manager_tree(self) -> Mapping[str, Any]:
        """Return nothing: the manager's own parameters are not looked at."""
        return {}

    def set(self, controller: str, key: str, value: Any) -> None:
        """Refuse: these are texts of files.

        Raises:
            TypeError: always.
        """
        raise TypeError("parameters that were read from files cannot be set")

    def full_name(self, controller: str, key: str) -> str:
        """Return the name a user knows a parameter by."""
        return key

    def place(self, controller: str, key: str) -> SourceSpan | None:
        """Return where a parameter stands; the controller's type when it is not there."""
        item = self._found.get(controller)
        return None if item is None else item.nodes.get(key, (None, item.span))[1]


def _place(nodes: Mapping[str, tuple[yaml.Node, SourceSpan]], key: str) -> SourceSpan | None:
    return nodes[key][1] if key in nodes else None


def _full(prefix: str, key: str) -> str:
    return prefix + key.replace(".", "/") if prefix else key


def _of_ros2(document: Document) -> Iterator[FoundController]:
    sections = list(_sections(document.root, ""))
    types: dict[str, tuple[str, yaml.Node]] = {}
    for node_name, section in sections:
        for key, value in section.value:
            kind = _type_of(value)
            if kind is not None:
                types.setdefault(str(key.value).strip("/"), (kind.value, kind))
        own = _type_of(section)
        if own is not None and not node_name.endswith(_MANAGER):
            types.setdefault(node_name.rpartition("/")[2], (own.value, own))
    for name, (type_name, place) in types.items():
        tree: dict[str, Any] = {}
        nodes: dict[str, tuple[yaml.Node, SourceSpan]] = {}
        for node_name, section in sections:
            if node_name.rpartition("/")[2] == name:
                tree.update(plain(section))
                nodes.update(_leaves(document, section, ""))
        tree.pop("type", None)
        kind_name = type_name.replace("::", "/")
        yield FoundController(name, name, kind_name, 2, tree, nodes, document.span(place))


def _of_ros1(
    document: Document, node: yaml.MappingNode, above: tuple[str, ...]
) -> Iterator[FoundController]:
    kind = _type_of(node)
    if kind is not None and controller_class(kind.value) is not None:
        tree = dict(plain(node))
        tree.pop("type", None)
        name = above[-1] if above else document.file.stem
        nodes = _leaves(document, node, "")
        full = "/" + "/".join(above)
        yield FoundController(name, full, kind.value, 1, tree, nodes, document.span(kind))
        return
    for key, value in node.value:
        if isinstance(value, yaml.MappingNode):
            yield from _of_ros1(document, value, (*above, *str(key.value).strip("/").split("/")))


def _sections(node: yaml.MappingNode, name: str) -> Iterator[tuple[str, yaml.MappingNode]]:
    for key, value in node.value:
        if not isinstance(value, yaml.MappingNode):
            continue
        if key.value == MARK:
            yield name, value
        else:
            yield from _sections(value, f"{name}/{str(key.value).strip('/')}")


def _type_of(node: yaml.Node) -> yaml.ScalarNode | None:
    """Return the ``type`` of a mapping, None when it has none that names a class."""
    pairs = node.value if isinstance(node, yaml.MappingNode) else []
    found = next((value for key, value in pairs if key.value == "type"), None)
    is_class = isinstance(found, yaml.ScalarNode) and ("/" in found.value or "::" in found.value)
    return found if is_class and isinstance(found, yaml.ScalarNode) else None


def _leaves(
    document: Document, node: yaml.Node, prefix: str
) -> dict[str, tuple[yaml.Node, SourceSpan]]:
    found: dict[str, tuple[yaml.Node, SourceSpan]] = {}
    for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
        name = f"{prefix}{key.value}".replace("/", ".")
        found[name] = (value, document.span(key))
        found.update(_leaves(document, value, f"{name}."))
    return found


def _check_types(item: FoundController, diagnostics: Diagnostics) -> None:
    """Report whole numbers for doubles and the other way round: ROS 2 takes neither."""
    kind = controller_class(item.type)
    assert kind is not None
    for key, _ in flattened(nested(item.tree)):
        row = kind.TABLE.row_for(key)
        node, span = item.nodes.get(key, (None, None))
        if row is None or node is None or row.kind not in _KINDS or 2 not in row.generations:
            continue
        wanted, given = _KINDS[row.kind], _given(node)
        if not given or given == wanted:
            continue
        text = f"controller '{item.name}': parameter '{key}' is of type {wanted}, and "
        text += f"{_shown(node)} is {given} (parameter '{key}' has invalid type: Wrong parameter "
        text += f"type, parameter {{{key}}} is of type {{{wanted}}}, setting it to {{{given}}} is "
        text += "not allowed); Gazelle takes it"
        fix = (
            _shown(node, with_point=True) if wanted != "integer" else _shown(node).partition(".")[0]
        )
        diagnostics.report("parameters.wrong-type", text, span, fix=f"write {fix}")


def _given(node: yaml.Node) -> str:
    """Return ``integer``, ``double`` or ``integer_array`` of plain numbers, empty for others."""
    if isinstance(node, yaml.SequenceNode):
        inner = {_given(item) for item in node.value}
        return "integer_array" if inner == {"integer"} else ""
    if not isinstance(node, yaml.ScalarNode) or node.style is not None:
        return ""
    tag = node.tag.rpartition(":")[2]
    return {"int": "integer", "float": "double"}.get(tag, "")


def _shown(node: yaml.Node, *, with_point: bool = False) -> str:
    if isinstance(node, yaml.SequenceNode):
        return f"[{', '.join(_shown(item, with_point=with_point) for item in node.value)}]"
    return f"{node.value.lstrip('0') or 0}.0" if with_point else str(node.value)
