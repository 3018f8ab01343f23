"""The specialisation of `gazelle::Description` that every message and service class has."""

from __future__ import annotations

from gazelle.cpp.interfaces.header_names import class_name
from gazelle.cpp.interfaces.member_rows import member_tables
from gazelle.errors import GazelleError
from gazelle.interfaces import Definition, RosVersion, TypeStore, ros1_name, split_name, wire_type
from gazelle.interfaces.definition import Array

__all__ = ["message_description", "raw_string", "service_description"]

_LONGEST_LITERAL = 16_000  # what every compiler takes in one piece


def message_description(types: TypeStore, definition: Definition) -> str:
    """Return the specialisation of a message's class.

    Args:
        types: where definitions come from.
        definition: by the rules of the generation whose class it is.
    """
    is_ros1 = definition.ros_version is RosVersion.ROS1
    tables = member_tables(types, definition)
    template = "template <class ContainerAllocator>" if is_ros1 else "template <>"
    self_name = class_name(definition.name, definition.ros_version, "ContainerAllocator")
    visits = " ".join(f'v("{item.name}", m.{item.name});' for item in definition.fields)
    cdr = "members" if tables.is_cdr_own else "cdr_members"
    cdr_count = len(tables.own) if tables.is_cdr_own else len(tables.cdr)
    own = "members" if tables.own else "nullptr"
    lines = [
        template,
        f"struct Description<{self_name}> {{",
        f"  using Self = {self_name};",
        *(f"  {line}" for line in _names(types, definition.name, is_ros1=is_ros1)),
        *(f"  {line}" for line in _traits(types, definition)),
        "  static const char *definition() {",
        "    static const char *const found = full_definition(layout());",
        "    return found;",
        "  }",
        "  template <class Message, class Visitor>",
        f"  static void fields({'Message &m, Visitor &&v' if visits else 'Message &, Visitor &&'})"
        f" {{ {visits} }}",
        *(f"  {line}" for line in tables.functions),
        "  static const Layout &layout() {",
        *_array("members", tables.own),
        *_array("cdr_members", tables.cdr),
        f"    static const Layout found{{type, ros1_type, md5, hash, "
        f"{raw_string(_own_text(types, definition))}, {str(is_ros1).lower()}, sizeof(Self), "
        f"{own}, {len(tables.own)}, {cdr if cdr_count else 'nullptr'}, {cdr_count}}};",
        "    return found;",
        "  }",
        "};",
    ]
    return "\n".join(lines)


def service_description(types: TypeStore, full: str, ros_version: RosVersion) -> str:
    """Return the specialisation of a service's class, and who its parts belong to.

    Args:
        types: where definitions come from.
        full: ``std_srvs/srv/SetBool``; services of actions are ``pkg/action/Name_SendGoal``.
        ros_version: whose class.
    """
    name = class_name(full, ros_version)
    request, response = (
        class_name(full + end, ros_version, "ContainerAllocator")
        for end in ("_Request", "_Response")
    )
    is_ros1 = ros_version is RosVersion.ROS1
    lines = [
        "template <>",
        f"struct Description<{name}> {{",
        *(f"  {line}" for line in _names(types, full, is_ros1=is_ros1)),
        f"  using Request = {class_name(full + '_Request', ros_version)};",
        f"  using Response = {class_name(full + '_Response', ros_version)};",
        f"  static constexpr bool is_ros1 = {str(is_ros1).lower()};",
        "};",
    ]
    for part in (request, response):
        template = "template <class ContainerAllocator>" if is_ros1 else "template <>"
        lines += [template, f"struct ServiceOf<{part}> {{", f"  using type = {name};", "};"]
    return "\n".join(lines)


def raw_string(text: str) -> str:
    """Return a text as raw string literals of C++."""
    mark = "D"
    while f'){mark}"' in text:
        mark += "D"
    pieces = [text[at : at + _LONGEST_LITERAL] for at in range(0, len(text), _LONGEST_LITERAL)]
    return " ".join(f'R"{mark}({piece}){mark}"' for piece in pieces) or '""'


def _array(name: str, rows: tuple[str, ...]) -> list[str]:
    if not rows:
        return []
    return [
        f"    static const Member {name}[] = {{",
        *(f"        {row}," for row in rows),
        "    };",
    ]


def _names(types: TypeStore, full: str, *, is_ros1: bool) -> list[str]:
    _, part, name = split_name(full)
    is_service = (part == "srv" and not name.endswith(("_Request", "_Response"))) or (
        part == "action" and name.endswith(("_SendGoal", "_GetResult"))
    )
    wire = wire_type(full, part) if is_ros1 else full
    values = {
        "type": wire,
        "ros1_type": ros1_name(full),
        "md5": _sum(types, full, is_service=is_service),
        "hash": _hash(types, wire, part),
    }
    return [f'static constexpr const char *{name} = "{value}";' for name, value in values.items()]


def _sum(types: TypeStore, full: str, *, is_service: bool) -> str:
    try:
        return types.service_md5sum(full) if is_service else types.md5sum(full)
    except GazelleError:
        return ""  # a type of ROS 2 alone, which no program of ROS 1 asks for


def _hash(types: TypeStore, full: str, part: str) -> str:
    try:
        return types.type_hash(full, part)
    except GazelleError:
        return ""  # a type of ROS 1 alone


def _traits(types: TypeStore, definition: Definition) -> list[str]:
    fields = definition.fields
    has_header = bool(fields) and (
        fields[0].name == "header"
        and fields[0].type.base == "std_msgs/msg/Header"
        and fields[0].type.array is Array.ONE
    )
    values = {
        "has_header": has_header,
        "is_fixed_size": _is_fixed(types, definition),
        "is_bounded_size": _is_bounded(types, definition),
    }
    return [
        f"static constexpr bool {name} = {str(value).lower()};" for name, value in values.items()
    ]


def _is_fixed(types: TypeStore, definition: Definition) -> bool:
    return all(
        item.type.array is not Array.SEQUENCE
        and not item.type.is_string
        and (
            not item.type.is_message
            or _is_fixed(types, types.definition(item.type.base, definition.ros_version))
        )
        for item in definition.fields
    )


def _is_bounded(types: TypeStore, definition: Definition) -> bool:
    return all(
        (item.type.array is not Array.SEQUENCE or item.type.size > 0)
        and (not item.type.is_string or item.type.string_bound > 0)
        and (
            not item.type.is_message
            or _is_bounded(types, types.definition(item.type.base, definition.ros_version))
        )
        for item in definition.fields
    )


def _own_text(types: TypeStore, definition: Definition) -> str:
    package, part, name = split_name(definition.name)
    source = None
    if part == "msg":
        source = types.find_source(package, part, name, definition.ros_version)
    if source is not None and source.is_own:
        return source.text
    return definition.text + "\n" if definition.text else ""
