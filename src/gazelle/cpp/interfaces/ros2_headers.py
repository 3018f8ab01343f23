"""Headers of ROS 2: ``std_msgs/msg/string.hpp`` …, as rosidl names and lays them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from gazelle.cpp.interfaces.description_text import message_description, service_description
from gazelle.cpp.interfaces.field_types import constant_lines, field_type, initial_value
from gazelle.cpp.interfaces.header_names import class_name, header_path
from gazelle.interfaces import Definition, RosVersion, TypeStore, split_name

__all__ = ["ros2_action_headers", "ros2_message_headers", "ros2_service_headers"]

_TOP = """// Made by Gazelle from the definition of {name}.
#pragma once

#include <gazelle/ros2_message.hpp>
"""
_DETAILS = ("struct", "builder", "traits", "type_support")
_ACTION_PARTS = (
    "_Goal",
    "_Result",
    "_Feedback",
    "_SendGoal_Request",
    "_SendGoal_Response",
    "_GetResult_Request",
    "_GetResult_Response",
    "_FeedbackMessage",
)
_ACTION_INCLUDES = ("action_msgs/msg/goal_status_array.hpp", "action_msgs/srv/cancel_goal.hpp")


def ros2_message_headers(types: TypeStore, full: str) -> Iterator[tuple[str, str]]:
    """Yield path and text of a message's headers."""
    yield from _headers(full, _messages(types, full, (full,), ()))


def ros2_service_headers(types: TypeStore, full: str) -> Iterator[tuple[str, str]]:
    """Yield path and text of a service's headers."""
    text = _messages(types, full, (f"{full}_Request", f"{full}_Response"), ())
    yield from _headers(full, text + _service(types, full))


def ros2_action_headers(types: TypeStore, full: str) -> Iterator[tuple[str, str]]:
    """Yield path and text of an action's headers."""
    package, part, bare = split_name(full)
    own = tuple(full + end for end in _ACTION_PARTS)
    text = _messages(types, full, own, _ACTION_INCLUDES)
    text += _service(types, f"{full}_SendGoal") + _service(types, f"{full}_GetResult")
    text += f"""
namespace {package} {{
namespace {part} {{
struct {bare} {{
  using Goal = {bare}_Goal;
  using Result = {bare}_Result;
  using Feedback = {bare}_Feedback;
  struct Impl {{
    using SendGoalService = {bare}_SendGoal;
    using GetResultService = {bare}_GetResult;
    using FeedbackMessage = {bare}_FeedbackMessage;
    using CancelGoalService = ::action_msgs::srv::CancelGoal;
    using GoalStatusMessage = ::action_msgs::msg::GoalStatusArray;
  }};
}};
}}  // namespace {part}
}}  // namespace {package}

namespace gazelle {{
template <>
struct ActionDescription<::{package}::{part}::{bare}> {{
  static constexpr const char *type = "{full}";
}};
}}  // namespace gazelle
"""
    yield from _headers(full, text)


def _headers(full: str, text: str) -> Iterator[tuple[str, str]]:
    path = header_path(full, RosVersion.ROS2)
    yield path, text
    folder, _, file = path.rpartition("/")
    for detail in _DETAILS:
        where = f"{folder}/detail/{file.removesuffix('.hpp')}__{detail}.hpp"
        yield where, f"#pragma once\n\n#include <{path}>\n"


def _messages(
    types: TypeStore, full: str, names: tuple[str, ...], includes: tuple[str, ...]
) -> str:
    """Return the text of a header up to the last of these messages."""
    package, part, _ = split_name(full)
    definitions = [types.definition(name, RosVersion.ROS2) for name in names]
    bases = {item.type.base for one in definitions for item in one.fields if item.type.is_message}
    paths = {header_path(base, RosVersion.ROS2) for base in bases} | set(includes)
    lines = [_TOP.format(name=full)]
    lines += [f"#include <{path}>" for path in sorted(paths - {header_path(full, RosVersion.ROS2)})]
    lines += [f"\nnamespace {package} {{", f"namespace {part} {{\n"]
    for definition in definitions:
        lines += _struct(definition)
    lines += [
        *(line for definition in definitions for line in _builder(definition)),
        "using ::rosidl_generator_traits::to_block_style_yaml;",
        "using ::rosidl_generator_traits::to_flow_style_yaml;",
        "using ::rosidl_generator_traits::to_yaml;",
        f"}}  // namespace {part}\n",
        *_build_functions(package, definitions),
        f"}}  // namespace {package}\n",
        "namespace gazelle {",
        *(message_description(types, definition) for definition in definitions),
        "}  // namespace gazelle",
    ]
    return "\n".join(lines) + "\n"


def _struct(definition: Definition) -> Iterator[str]:
    bare = split_name(definition.name)[2]
    name = class_name(definition.name, RosVersion.ROS2)
    fields = definition.fields
    yield f"struct {bare} {{"
    yield f"  using Type = {bare};"
    yield f"  {bare}() = default;"
    yield f"  explicit {bare}(rosidl_runtime_cpp::MessageInitialization) {{}}"
    for item in fields:
        kind = field_type(item.type, RosVersion.ROS2)
        yield f"  using _{item.name}_type = {kind};"
        yield f"  _{item.name}_type {item.name}{initial_value(item, RosVersion.ROS2)};"
    if not fields:
        yield "  using _structure_needs_at_least_one_member_type = uint8_t;"
        yield "  uint8_t structure_needs_at_least_one_member{};"
    for item in fields:
        yield f"  Type &set__{item.name}(const _{item.name}_type &_arg) {{"
        yield f"    this->{item.name} = _arg;\n    return *this;\n  }}"
    for constant in definition.constants:
        yield f"  {constant_lines(constant, RosVersion.ROS2)}"
    yield f"  GAZELLE_ROS2_POINTERS({bare})"
    equal = " && ".join(f"{item.name} == _other.{item.name}" for item in fields)
    argument = f"const {bare} &_other" if fields else f"const {bare} &"
    yield f"  bool operator==({argument}) const {{ return {equal or 'true'}; }}"
    yield f"  bool operator!=(const {bare} &_other) const {{ return !(*this == _other); }}"
    yield "};"
    yield f"template <class ContainerAllocator>\nusing {bare}_ = {name};\n"


def _builder(definition: Definition) -> Iterator[str]:
    """Yield the class whose functions set a message's fields, the last one giving the message."""
    bare = split_name(definition.name)[2]
    if not definition.fields:
        return
    *fields, last = definition.fields
    yield "namespace builder {"
    yield f"struct Init_{bare} {{"
    for item in fields:
        argument = f"{bare}::_{item.name}_type _arg"
        yield f"  Init_{bare} &&{item.name}({argument}) && {{"
        yield f"    _made.{item.name} = std::move(_arg);\n    return std::move(*this);\n  }}"
    yield f"  {bare} {last.name}({bare}::_{last.name}_type _arg) && {{"
    yield f"    _made.{last.name} = std::move(_arg);\n    return std::move(_made);\n  }}"
    yield f"  {bare} _made;\n}};"
    yield "}  // namespace builder\n"


def _build_functions(package: str, definitions: Sequence[Definition]) -> Iterator[str]:
    yield "template <typename MessageType>\nauto build();\n"
    for definition in definitions:
        _, part, bare = split_name(definition.name)
        made = f"{part}::builder::Init_{bare}" if definition.fields else f"{part}::{bare}"
        name = class_name(definition.name, RosVersion.ROS2)
        yield f"template <>\ninline auto build<{name}>() {{\n  return {made}();\n}}\n"


def _service(types: TypeStore, full: str) -> str:
    package, part, bare = split_name(full)
    return f"""
namespace {package} {{
namespace {part} {{
struct {bare} {{
  using Request = {bare}_Request;
  using Response = {bare}_Response;
}};
}}  // namespace {part}
}}  // namespace {package}

namespace gazelle {{
{service_description(types, full, RosVersion.ROS2)}
}}  // namespace gazelle
"""
