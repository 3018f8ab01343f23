"""Headers of generate_parameter_library: ``<target>.hpp`` with ``Params`` and ``ParamListener``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from gazelle.cpp.interfaces.field_types import literal
from gazelle.cpp.interfaces.header_trees import write_headers
from gazelle.cpp.interfaces.parameter_files import (
    Leaf,
    MapOf,
    ParameterFile,
    Structure,
    Validation,
    read_parameter_file,
)
from gazelle.interfaces import RosVersion

__all__ = ["parameter_header"]

_DOUBLE_LIMITS = (
    "std::numeric_limits<double>::lowest()",
    "std::numeric_limits<double>::max()",
)
_INTEGER_LIMITS = (
    "std::numeric_limits<std::int64_t>::lowest()",
    "std::numeric_limits<std::int64_t>::max()",
)
_BOTH = ("bounds", "element_bounds")
_LOWER = ("gt_eq", "lower_bounds", "lower_element_bounds")
_UPPER = ("lt_eq", "upper_bounds", "upper_element_bounds")


def parameter_header(
    yaml: Path, target: str, folder: Path, package: str = "", validate_header: str = ""
) -> Path:
    """Write the header of a file of parameters.

    Args:
        yaml: the file.
        target: the CMake library, whose name the header has.
        folder: becomes an include folder.
        package: where the header is a second time, for ``#include <package/target.hpp>``.
        validate_header: the user's validators, as the header includes them.

    Returns:
        The header.

    Raises:
        UserFileError: the file has errors; says where.
    """
    text = _header(read_parameter_file(yaml), yaml.name, validate_header)
    headers = [(f"{target}.hpp", text)]
    if package:
        headers.append((f"{package}/{target}.hpp", f"#pragma once\n\n#include <{target}.hpp>\n"))
    return write_headers(folder, headers)[0]


def _header(file: ParameterFile, name: str, validate_header: str) -> str:
    root = file.root
    visits = [*_visits(root, "p", "", (("p", root),)), *_map_visits(root, "p", "", (("p", root),))]
    prunes = list(_prunes(root, "p", (("p", root),)))
    stack = list(_stack_copies(root, ""))
    lines = [
        f"// Made by Gazelle from {name}.",
        "#pragma once\n",
        "#include <gazelle/parameter_listener.hpp>",
        *([f'\n#include "{validate_header}"'] if validate_header else []),
        f"\nnamespace {file.namespace} {{\n",
        "using namespace ::parameter_traits;\n",
        "struct Params {",
        *_members(root, "  "),
        "  // Another one after every change.",
        "  rclcpp::Time __stamp;",
        "};\n",
        "struct StackParams {",
        *_stack_members(root, "  "),
        "};\n",
        "struct ParameterVisit {",
        "  using Spec = ::gazelle::parameters::Spec;",
        "  using Checked = ::gazelle::parameters::Checked;",
        "  using Descriptor = ::gazelle::parameters::Descriptor;",
        "  template <class Visitor>",
        f"  static void visit({'Params &p, Visitor &&v' if visits else 'Params &, Visitor &&'}) {{",
        *(f"    {line}" for line in visits),
        "  }",
        f"  static void prune(Params &{'p' if prunes else ''}) {{",
        *(f"    {line}" for line in prunes),
        "  }",
        f"  static StackParams stack(const Params &{'p' if stack else ''}) {{",
        "    StackParams made;",
        *(f"    {line}" for line in stack),
        "    return made;",
        "  }",
        "};\n",
        "class ParamListener",
        "    : public ::gazelle::parameters::Listener<Params, StackParams, ParameterVisit> {",
        " public:",
        "  using Listener::Listener;",
        "  template <class Node>",
        '  explicit ParamListener(Node node, const std::string &prefix = "")',
        "      : Listener(node->get_node_parameters_interface(), node->get_logger(), prefix) {}",
        '  explicit ParamListener(const Interface &interface, const std::string &prefix = "")',
        f'      : Listener(interface, rclcpp::get_logger("{file.namespace}"), prefix) {{}}',
        "};\n",
        f"}}  // namespace {file.namespace}",
    ]
    return "\n".join(lines) + "\n"


def _members(structure: Structure, indent: str) -> Iterator[str]:
    for leaf in structure.leaves:
        yield f"{indent}{_type(leaf)} {leaf.name}{_initial(leaf)};"
    for inner in structure.structures:
        yield f"{indent}struct {_pascal(inner.name)} {{"
        yield from _members(inner, indent + "  ")
        yield f"{indent}}} {inner.name};"
    for one in structure.maps:
        name = f"Map{_pascal(one.keys)}"
        yield f"{indent}struct {name} {{"
        yield from _members(one.inside, indent + "  ")
        yield f"{indent}}};"
        yield f"{indent}std::map<std::string, {name}> {one.keys}_map;"


def _stack_members(structure: Structure, indent: str) -> Iterator[str]:
    for leaf in structure.leaves:
        if _is_on_stack(leaf):
            yield f"{indent}{_type(leaf)} {leaf.name}{_initial(leaf)};"
    for inner in structure.structures:
        yield f"{indent}struct {_pascal(inner.name)} {{"
        yield from _stack_members(inner, indent + "  ")
        yield f"{indent}}} {inner.name};"


def _stack_copies(structure: Structure, path: str) -> Iterator[str]:
    for leaf in structure.leaves:
        if _is_on_stack(leaf):
            yield f"made.{path}{leaf.name} = p.{path}{leaf.name};"
    for inner in structure.structures:
        yield from _stack_copies(inner, f"{path}{inner.name}.")


_Scopes = tuple[tuple[str, Structure], ...]


def _visits(structure: Structure, owner: str, name: str, scopes: _Scopes) -> Iterator[str]:
    """Yield visits of parameters whose names are known.

    Args:
        structure: whose.
        owner: expression of its object.
        name: expression of the beginning of names, empty at the outermost.
        scopes: expressions and structures around it, where keys of maps are looked for.
    """
    for leaf in structure.leaves:
        yield f"v({_spec(leaf, name)}, {owner}.{leaf.name});"
    for inner in structure.structures:
        path = f"{owner}.{inner.name}"
        inside = (*scopes, (path, inner))
        yield from _visits(inner, path, _joined(name, f'"{inner.name}."'), inside)


def _map_visits(structure: Structure, owner: str, name: str, scopes: _Scopes) -> Iterator[str]:
    """Yield loops over maps, which come after all that may be keys."""
    for inner in structure.structures:
        path = f"{owner}.{inner.name}"
        inside = (*scopes, (path, inner))
        yield from _map_visits(inner, path, _joined(name, f'"{inner.name}."'), inside)
    for one in structure.maps:
        depth = len(scopes)
        key, entry = f"key{depth}", f"entry{depth}"
        yield f"for (const std::string &{key} : {_keys(one, scopes)}) {{"
        yield f"  auto &{entry} = {owner}.{one.keys}_map[{key}];"
        inner_name = _joined(name, f'{key} + "."')
        inside = (*scopes, (entry, one.inside))
        for line in (
            *_visits(one.inside, entry, inner_name, inside),
            *_map_visits(one.inside, entry, inner_name, inside),
        ):
            yield f"  {line}"
        yield "}"


def _prunes(structure: Structure, owner: str, scopes: _Scopes) -> Iterator[str]:
    for inner in structure.structures:
        path = f"{owner}.{inner.name}"
        yield from _prunes(inner, path, (*scopes, (path, inner)))
    for one in structure.maps:
        depth = len(scopes)
        entry = f"entry{depth}"
        keys, map_name = _keys(one, scopes), f"{owner}.{one.keys}_map"
        yield f"for (auto at = {map_name}.begin(); at != {map_name}.end();) {{"
        yield f"  const bool stays = ::gazelle::parameters::holds({keys}, at->first);"
        yield f"  at = stays ? std::next(at) : {map_name}.erase(at);"
        yield "}"
        inner_lines = list(_prunes(one.inside, entry, (*scopes, (entry, one.inside))))
        if inner_lines:
            yield f"for (auto &pair{depth} : {map_name}) {{"
            yield f"  auto &{entry} = pair{depth}.second;"
            yield from (f"  {line}" for line in inner_lines)
            yield "}"


def _keys(one: MapOf, scopes: _Scopes) -> str:
    """Return the expression of the parameter that holds a map's keys: the nearest of the name."""
    for owner, structure in reversed(scopes):
        if any(leaf.name == one.keys for leaf in structure.leaves):
            return f"{owner}.{one.keys}"
    return f"p.{one.keys}"


def _joined(name: str, more: str) -> str:
    if not name:
        return f"std::string({more})" if more.startswith('"') else more
    return f"{name} + {more}"


def _spec(leaf: Leaf, name: str) -> str:
    full = f'{name} + "{leaf.name}"' if name else f'"{leaf.name}"'
    values = [
        full,
        _text(leaf.description),
        _text(leaf.additional_constraints),
        str(leaf.read_only).lower(),
        str(leaf.has_default).lower(),
        _limits(leaf),
        _validator(leaf),
    ]
    return f"Spec{{{', '.join(values)}}}"


def _limits(leaf: Leaf) -> str:
    if leaf.element not in ("double", "int64_t"):
        return "nullptr"
    is_double = leaf.element == "double"
    lower, upper = _DOUBLE_LIMITS if is_double else _INTEGER_LIMITS
    usual = (lower, upper)
    for one in leaf.validations:
        values = [_literal(value, leaf.element) for value in one.arguments]
        if one.name in _BOTH and len(values) == 2:
            lower, upper = values
        elif one.name in _LOWER and len(values) == 1:
            lower = values[0]
        elif one.name in _UPPER and len(values) == 1:
            upper = values[0]
        elif one.name == "gt" and len(values) == 1:
            lower = _next(values[0], 1, is_double=is_double)
        elif one.name == "lt" and len(values) == 1:
            upper = _next(values[0], -1, is_double=is_double)
    if (lower, upper) == usual:
        return "nullptr"
    kind = "double" if is_double else "std::int64_t"
    return (
        "[](Descriptor &descriptor) { ::gazelle::parameters::limit(descriptor, "
        f"{kind}({lower}), {kind}({upper})); }}"
    )


def _next(value: str, step: int, *, is_double: bool) -> str:
    if not is_double:
        return f"({value} {'+' if step > 0 else '-'} 1)"
    sign = "" if step > 0 else "-"
    return f"std::nextafter({value}, {sign}std::numeric_limits<double>::infinity())"


def _validator(leaf: Leaf) -> str:
    checks = list(leaf.validations)
    if leaf.size:
        checks.append(Validation("size_lt", True, (leaf.size + 1,)))
    if not checks:
        return "nullptr"
    calls = "".join(
        f" if (Checked checked = {_call(one, leaf)}; !checked) return checked;" for one in checks
    )
    return f"[](const rclcpp::Parameter &parameter) -> Checked {{{calls} return {{}}; }}"


def _call(one: Validation, leaf: Leaf) -> str:
    element = leaf.element if one.is_typed else ""
    is_size = one.name in ("fixed_size", "size_gt", "size_lt")
    arguments = [_literal(value, "" if is_size else element) for value in one.arguments]
    kind = f"<{leaf.element}>" if one.is_typed else ""
    return f"{one.name}{kind}({', '.join(['parameter', *arguments])})"


def _literal(value: Any, element: str = "") -> str:
    """Return a value in C++.

    Args:
        value: as YAML has it.
        element: C++ type that it becomes; the value's own when empty.
    """
    if isinstance(value, list | tuple):
        kind = element or _kind_of(value)
        return f"std::vector<{kind}>{{{', '.join(_literal(item, kind) for item in value)}}}"
    if element == "double" or (not element and isinstance(value, float)):
        return literal("float64", float(value), RosVersion.ROS2)
    if isinstance(value, bool):
        return str(value).lower()
    if element == "std::string" or isinstance(value, str):
        return _text(str(value))
    return literal("int64", int(value), RosVersion.ROS2) if element == "int64_t" else str(value)


def _kind_of(values: Sequence[Any]) -> str:
    if any(isinstance(value, str) for value in values):
        return "std::string"
    if any(isinstance(value, float) for value in values):
        return "double"
    return "bool" if all(isinstance(value, bool) for value in values) and values else "int64_t"


def _type(leaf: Leaf) -> str:
    if leaf.size:
        if leaf.is_array:
            return f"rsl::StaticVector<{leaf.element}, {leaf.size}>"
        return f"rsl::StaticString<{leaf.size}>"
    return f"std::vector<{leaf.element}>" if leaf.is_array else leaf.element


def _initial(leaf: Leaf) -> str:
    if not leaf.has_default:
        return "" if leaf.is_array or leaf.element == "std::string" else "{}"
    if leaf.is_array:
        items = ", ".join(_literal(item, leaf.element) for item in leaf.default)
        return f" = {{{items}}}" if items else "{}"
    return f" = {_literal(leaf.default, leaf.element)}"


def _is_on_stack(leaf: Leaf) -> bool:
    """Whether a member needs no memory of its own, so that a loop in real time may copy it."""
    if leaf.element == "std::string":
        return leaf.size > 0 and not leaf.is_array
    return leaf.size > 0 or not leaf.is_array


def _pascal(name: str) -> str:
    return "".join(word[:1].upper() + word[1:] for word in name.split("_"))


def _text(value: str) -> str:
    return literal("string", value, RosVersion.ROS2)
