"""Controllers that parameter files describe, whatever namespace they are in."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from gazelle.control.controller_parameters import controller_parameters
from gazelle.control.controllers.registry import controller_class, known_types
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean, nearest_names
from gazelle.doctor.parameters.parameter_file import (
    MARK,
    Document,
    Layout,
    is_controller_type,
    plain,
)
from gazelle.documents.yaml import YamlMapping, YamlNode, YamlScalar, YamlSequence, entries
from gazelle.parameters.trees import flattened, nested

__all__ = [
    "FoundController",
    "FoundControllers",
    "check_controllers",
    "check_untyped",
    "controllers_in",
]

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
    ros_version: int
    tree: Mapping[str, Any]
    nodes: Mapping[str, tuple[YamlNode, SourceSpan]] = field(repr=False)
    span: SourceSpan

    def place_of(self, key: str, word: str) -> SourceSpan:
        """Return where a word stands in the list of a key, else the key's or the type's place."""
        node, span = self.nodes.get(key, (None, self.span))
        items = node.items if isinstance(node, YamlSequence) else ()
        found = (one for one in items if isinstance(one, YamlScalar) and one.text == word)
        return next((one.span for one in found), span)


def controllers_in(document: Document, layout: Layout) -> tuple[FoundController, ...]:
    """Return the controllers of a file, in its order."""
    if layout is Layout.ROS2:
        return tuple(_of_ros2(document))
    if layout is Layout.ROS1:
        return tuple(_of_ros1(document, document.root, ()))
    return ()


def check_controllers(found: Iterable[FoundController], diagnostics: Diagnostics) -> None:
    """Report types of controllers that nobody has, keys unknown, values that ROS 2 refuses."""
    for item in found:
        kind = controller_class(item.type)
        if kind is None:
            _check_kind(item, diagnostics)
            continue
        prefix = f"{item.full_name}/" if item.ros_version == 1 else ""
        parameters = controller_parameters(
            item.name,
            item.tree,
            kind.TABLE.parameters,
            diagnostics,
            full_name=partial(_full, prefix),
            span=partial(_span, item.nodes),
        )
        parameters.report_unknown()
        if item.ros_version == 2:
            _check_types(item, diagnostics)


def check_untyped(document: Document, layout: Layout, diagnostics: Diagnostics) -> None:
    """Report controllers of a manager whose ``type`` is spelt otherwise."""
    if layout is not Layout.ROS2:
        for name, mapping in _mappings(document.root):
            _check_untyped(name, mapping, diagnostics, of_class=True)
        return
    for place, section in _sections(document.root, ""):
        rows = section.pairs if place.endswith(_MANAGER) else ()
        for key, value in rows:
            if isinstance(value, YamlMapping):
                _check_untyped(key, value, diagnostics)


def _check_untyped(
    key: YamlNode, value: YamlMapping, diagnostics: Diagnostics, *, of_class: bool = False
) -> None:
    names = [one.text for one, _ in value.pairs]
    near = nearest_names("type", names, count=1) if "type" not in names else ()
    if not near:
        return
    place, found = next((one.span, two) for one, two in value.pairs if one.text == near[0])
    if of_class and not (isinstance(found, YamlScalar) and is_controller_type(found.text)):
        return
    text = f"controller '{key.text}' has no 'type' and has '{near[0]}' (The 'type' "
    text += f"param was not defined for '{key.text}')"
    fix = f"did you mean 'type' for '{near[0]}'?"
    diagnostics.report("parameters.controller-type", text, place, fix=fix)


def _mappings(node: YamlMapping) -> Iterator[tuple[YamlNode, YamlMapping]]:
    for key, value in node.pairs:
        if isinstance(value, YamlMapping):
            yield key, value
            yield from _mappings(value)


def _check_kind(item: FoundController, diagnostics: Diagnostics) -> None:
    """Report a type that is nearly one of ours; others may be a package's own."""
    if is_controller_type(item.type):
        hint = did_you_mean(item.type, known_types())
        text = f"there is no controller type '{item.type}' (Could not load class '{item.type}': "
        text += "According to the loaded plugin descriptions the class does not exist)"
        diagnostics.report("parameters.controller-type", text, item.span, fix=hint)


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

    def span(self, controller: str, key: str) -> SourceSpan | None:
        """Return where a parameter stands; the controller's type when it is not there."""
        item = self._found.get(controller)
        return None if item is None else item.nodes.get(key, (None, item.span))[1]


def _span(nodes: Mapping[str, tuple[YamlNode, SourceSpan]], key: str) -> SourceSpan | None:
    return nodes[key][1] if key in nodes else None


def _full(prefix: str, key: str) -> str:
    return prefix + key.replace(".", "/") if prefix else key


def _of_ros2(document: Document) -> Iterator[FoundController]:
    sections = list(_sections(document.root, ""))
    types: dict[str, tuple[str, YamlNode]] = {}
    for node_name, section in sections:
        for key, value in section.pairs:
            kind = _type_of(value)
            if kind is not None:
                types.setdefault(key.text.strip("/"), (kind.text, kind))
        own = _type_of(section)
        if own is not None and not node_name.endswith(_MANAGER):
            types.setdefault(node_name.rpartition("/")[2], (own.text, own))
    for name, (type_name, place) in types.items():
        tree: dict[str, Any] = {}
        nodes: dict[str, tuple[YamlNode, SourceSpan]] = {}
        for node_name, section in sections:
            if node_name.rpartition("/")[2] == name:
                tree.update(plain(section))
                nodes.update(_leaves(section))
        tree.pop("type", None)
        kind_name = type_name.replace("::", "/")
        yield FoundController(name, name, kind_name, 2, tree, nodes, place.span)


def _of_ros1(
    document: Document, node: YamlMapping, above: tuple[str, ...]
) -> Iterator[FoundController]:
    kind = _type_of(node)
    if kind is not None and is_controller_type(kind.text):
        tree = dict(plain(node))
        tree.pop("type", None)
        name = above[-1] if above else document.file.stem
        nodes = _leaves(node)
        full = "/" + "/".join(above)
        yield FoundController(name, full, kind.text, 1, tree, nodes, kind.span)
        return
    for key, value in node.pairs:
        if isinstance(value, YamlMapping):
            yield from _of_ros1(document, value, (*above, *key.text.strip("/").split("/")))


def _sections(node: YamlMapping, name: str) -> Iterator[tuple[str, YamlMapping]]:
    for key, value in node.pairs:
        if not isinstance(value, YamlMapping):
            continue
        if key.text == MARK:
            yield name, value
        else:
            yield from _sections(value, f"{name}/{key.text.strip('/')}")


def _type_of(node: YamlNode) -> YamlScalar | None:
    """Return the ``type`` of a mapping, None when it has none that names a class."""
    pairs = node.pairs if isinstance(node, YamlMapping) else ()
    found = next((value for key, value in pairs if key.text == "type"), None)
    is_class = isinstance(found, YamlScalar) and ("/" in found.text or "::" in found.text)
    return found if is_class and isinstance(found, YamlScalar) else None


def _leaves(node: YamlNode) -> dict[str, tuple[YamlNode, SourceSpan]]:
    return {
        ".".join(path).replace("/", "."): (value, key.span) for path, key, value, _ in entries(node)
    }


def _check_types(item: FoundController, diagnostics: Diagnostics) -> None:
    """Report whole numbers for doubles and the other way round: ROS 2 takes neither."""
    kind = controller_class(item.type)
    assert kind is not None
    for key, _ in flattened(nested(item.tree)):
        row = kind.TABLE.parameters.row_for(key)
        node, span = item.nodes.get(key, (None, None))
        if row is None or node is None or row.kind not in _KINDS or 2 not in row.ros_versions:
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


def _given(node: YamlNode) -> str:
    """Return ``integer``, ``double`` or ``integer_array`` of plain numbers, empty for others."""
    if isinstance(node, YamlSequence):
        inner = {_given(item) for item in node.items}
        return "integer_array" if inner == {"integer"} else ""
    if not isinstance(node, YamlScalar) or not node.is_plain:
        return ""
    return {"int": "integer", "float": "double"}.get(node.tag, "")


def _shown(node: YamlNode, *, with_point: bool = False) -> str:
    if isinstance(node, YamlSequence):
        return f"[{', '.join(_shown(item, with_point=with_point) for item in node.items)}]"
    return f"{node.text.lstrip('0') or 0}.0" if with_point else node.text
