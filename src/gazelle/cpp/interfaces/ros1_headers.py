"""Headers of ROS 1 as gencpp names and lays them: ``std_msgs/String.h``, ``std_srvs/SetBool.h``."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.cpp.interfaces.description_text import message_description, service_description
from gazelle.cpp.interfaces.field_types import constant_lines, field_type, initial_value
from gazelle.cpp.interfaces.header_names import class_name, header_path
from gazelle.interfaces import Definition, RosVersion, TypeStore, split_name

__all__ = ["ros1_message_headers", "ros1_service_headers"]

_TOP = """// Made by Gazelle from the definition of {name}.
#pragma once

#include <gazelle/ros1_message.hpp>
"""


def ros1_message_headers(types: TypeStore, full: str) -> Iterator[tuple[str, str]]:
    """Yield path and text of a message's header.

    Args:
        types: where definitions come from.
        full: full name, also of a request or a response.
    """
    definition = types.definition(full, RosVersion.ROS1)
    package, _, _ = split_name(full)
    template = class_name(full, RosVersion.ROS1, "ContainerAllocator")
    bare = class_name(full, RosVersion.ROS1).rpartition("::")[2]
    lines = [_TOP.format(name=full)]
    bases = sorted({item.type.base for item in definition.fields if item.type.is_message})
    lines += [f"#include <{header_path(base, RosVersion.ROS1)}>" for base in bases]
    lines += [f"\nnamespace {package} {{\n", *_struct(definition, bare)]
    lines += [
        f"typedef ::{package}::{bare}_<std::allocator<void>> {bare};",
        f"typedef boost::shared_ptr<{bare}> {bare}Ptr;",
        f"typedef boost::shared_ptr<{bare} const> {bare}ConstPtr;",
        "",
        *_operators(definition, template),
        f"}}  // namespace {package}\n",
        "namespace gazelle {",
        message_description(types, definition),
        "}  // namespace gazelle",
    ]
    yield header_path(full, RosVersion.ROS1), "\n".join(lines) + "\n"


def ros1_service_headers(types: TypeStore, full: str) -> Iterator[tuple[str, str]]:
    """Yield path and text of the headers of a service, its request and its response.

    Args:
        types: where definitions come from.
        full: ``std_srvs/srv/SetBool``.
    """
    package, _, bare = split_name(full)
    for end in ("_Request", "_Response"):
        yield from ros1_message_headers(types, full + end)
    text = f"""{_TOP.format(name=full)}
#include <{package}/{bare}Request.h>
#include <{package}/{bare}Response.h>

namespace {package} {{

struct {bare} {{
  typedef {bare}Request Request;
  typedef {bare}Response Response;
  Request request;
  Response response;

  typedef Request RequestType;
  typedef Response ResponseType;
}};

}}  // namespace {package}

namespace gazelle {{
{service_description(types, full, RosVersion.ROS1)}
}}  // namespace gazelle
"""
    yield header_path(full, RosVersion.ROS1), text


def _struct(definition: Definition, bare: str) -> Iterator[str]:
    yield "template <class ContainerAllocator>"
    yield f"struct {bare}_ {{"
    yield f"  typedef {bare}_<ContainerAllocator> Type;"
    yield f"  {bare}_() = default;"
    yield f"  {bare}_(const ContainerAllocator &) {{}}"
    for item in definition.fields:
        kind = field_type(item.type, RosVersion.ROS1)
        value = initial_value(item, RosVersion.ROS1)
        yield f"  typedef {kind} _{item.name}_type;"
        yield f"  _{item.name}_type {item.name}{value};"
    for constant in definition.constants:
        yield f"  {constant_lines(constant, RosVersion.ROS1)}"
    yield f"  typedef boost::shared_ptr<{bare}_> Ptr;"
    yield f"  typedef boost::shared_ptr<{bare}_ const> ConstPtr;"
    yield "};\n"


def _operators(definition: Definition, template: str) -> Iterator[str]:
    equal = " && ".join(f"l.{item.name} == r.{item.name}" for item in definition.fields)
    yield "template <class ContainerAllocator>"
    yield f"std::ostream &operator<<(std::ostream &stream, const {template} &message) {{"
    layout = f"::gazelle::Description<{template}>::layout()"
    yield f"  ::gazelle::print_ros1(stream, {layout}, &message);"
    yield "  return stream;\n}"
    arguments = f"const {template} &l, const {template} &r"
    if not equal:
        arguments = f"const {template} &, const {template} &"
    yield "template <class ContainerAllocator>"
    yield f"bool operator==({arguments}) {{\n  return {equal or 'true'};\n}}"
    arguments = f"const {template} &l, const {template} &r"
    yield "template <class ContainerAllocator>"
    yield f"bool operator!=({arguments}) {{\n  return !(l == r);\n}}\n"
