"""The service ``NODE/get_type_description`` (rclpy.type_description_service)."""

from __future__ import annotations

from typing import Any

from gazelle.graph import Node
from gazelle.interfaces import (
    definition,
    find_source,
    message_type,
    service_type,
    type_description,
    type_hash,
)
from gazelle.interfaces.definition import FORMATS, Field, RosVersion

__all__ = ["START_TYPE_DESCRIPTION_SERVICE_PARAM", "describe_type", "offer_type_descriptions"]

START_TYPE_DESCRIPTION_SERVICE_PARAM = "start_type_description_service"
_SERVICE = "type_description_interfaces/srv/GetTypeDescription"
_HASH_START = "RIHS01_"
_HASH_LENGTH = len(_HASH_START) + 64


def offer_type_descriptions(node: Node) -> None:
    """Answer questions about the types that a node uses, until the node ends."""
    node.create_service(
        f"{node.name}/get_type_description",
        service_type(_SERVICE),
        lambda request: describe_type(_types_of(node), request),
    )


def describe_type(used: set[str], request: Any) -> Any:
    """Return the answer to ``GetTypeDescription``, with rcl's reasons for failure.

    Args:
        used: full names of topics', services' and actions' types.
        request: ``type_description_interfaces/srv/GetTypeDescription_Request``.
    """
    response = service_type(_SERVICE).Response()
    name, given = request.type_name, request.type_hash
    if not (given.startswith(_HASH_START) and len(given) == _HASH_LENGTH):
        response.failure_reason = "Failed to parse type hash"
        return response
    found = {part["type_name"]: part for one in used for part in _parts(type_description(one))}
    if name not in found or type_hash(name) != given:
        response.failure_reason = "Type not currently in use by this node"
        return response
    description = type_description(name)
    response.successful = True
    response.type_description.type_description = _individual(description["type_description"])
    response.type_description.referenced_type_descriptions = [
        _individual(part) for part in description["referenced_type_descriptions"]
    ]
    if request.include_type_sources:
        response.type_sources = [_source(part["type_name"]) for part in _parts(description)]
    return response


def _types_of(node: Node) -> set[str]:
    entities = node.graph.entities()
    return {one.type_name for one in entities if one.node == node.name and "/" in one.type_name}


def _parts(description: dict[str, Any]) -> list[dict[str, Any]]:
    return [description["type_description"], *description["referenced_type_descriptions"]]


def _individual(part: dict[str, Any]) -> Any:
    make_field, make_type = _message("Field"), _message("FieldType")
    defaults = _defaults(part["type_name"])
    fields = [
        make_field(
            name=item["name"],
            type=make_type(**item["type"]),
            default_value=defaults.get(item["name"], ""),
        )
        for item in part["fields"]
    ]
    return _message("IndividualTypeDescription")(type_name=part["type_name"], fields=fields)


def _defaults(name: str) -> dict[str, str]:
    if name.split("/")[1] != "msg":
        return {}
    fields = definition(name, RosVersion.ROS2).fields
    return {one.name: _default_text(one) for one in fields if one.default is not None}


def _default_text(field: Field) -> str:
    if isinstance(field.default, tuple):
        return f"({', '.join(map(repr, field.default))})"
    is_number = field.type.base in FORMATS
    return repr(field.default) if is_number else f"'{field.default}'"


def _source(name: str) -> Any:
    """Return a type's text; parts of services and actions have none of their own."""
    package, part, bare = name.split("/")
    found = find_source(package, part, bare, RosVersion.ROS2)
    encoding, text = ("implicit", "") if found is None else (part, found.text)
    make = _message("TypeSource")
    return make(type_name=name, encoding=encoding, raw_file_contents=text)


def _message(name: str) -> Any:
    return message_type(f"type_description_interfaces/msg/{name}")
