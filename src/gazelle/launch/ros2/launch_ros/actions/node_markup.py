"""``<node>`` and what is in it, for XML and YAML alike."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, List  # noqa: UP035

from gazelle.launch.ros2.frontend import Entity, Parser
from gazelle.launch.ros2.frontend.type_utils import get_data_type_from_identifier
from gazelle.launch.ros2.launch_ros.parameter_descriptions import ParameterFile, ParameterValue

__all__ = ["node_arguments", "parameters_of", "remaps_of"]

_ENTITIES: Any = List[Entity]  # noqa: UP006
_TEXTS = {
    "name": "name",
    "exec_name": "exec_name",
    "pkg": "package",
    "namespace": "namespace",
    # Foxy's.
    "node-name": "name",
}


def node_arguments(
    entity: Entity, parser: Parser, words_of: Callable[[str, Parser], Any]
) -> dict[str, Any]:
    """Return the arguments of `Node` that an element gives."""
    found: dict[str, Any] = {"executable": parser.parse_substitution(entity.get_attr("exec"))}
    for attribute, name in _TEXTS.items():
        text = entity.get_attr(attribute, optional=True)
        if text is not None:
            found[name] = parser.parse_substitution(text)
    for attribute, name in (("args", "arguments"), ("ros_args", "ros_arguments")):
        text = entity.get_attr(attribute, optional=True)
        if text is not None:
            found[name] = words_of(text, parser)
    remaps = remaps_of(entity, parser)
    if remaps is not None:
        found["remappings"] = remaps
    parameters = entity.get_attr("param", data_type=_ENTITIES, optional=True)
    if parameters is not None:
        found["parameters"] = parameters_of(parameters, parser)
    return found


def remaps_of(entity: Entity, parser: Parser) -> list[tuple[Any, Any]] | None:
    """Return the pairs of an element's ``<remap from= to=>``, None without any."""
    remaps = entity.get_attr("remap", data_type=_ENTITIES, optional=True)
    if remaps is None:
        return None
    found = []
    for one in remaps:
        ends = (parser.parse_substitution(one.get_attr(key)) for key in ("from", "to"))
        found.append((*ends,))
        one.assert_entity_completely_parsed()
    return found  # type: ignore[return-value]


def parameters_of(params: Iterable[Entity], parser: Parser) -> list[Any]:
    """Return what ``<param>`` elements mean: files, or dictionaries.

    Raises:
        RuntimeError: one has attributes that exclude each other.
        ValueError: one has neither ``name`` nor ``from``.
    """
    return [_parameter(param, parser) for param in params]


def _parameter(param: Entity, parser: Parser) -> Any:
    file = param.get_attr("from", optional=True)
    allow = param.get_attr("allow_substs", data_type=bool, optional=True)
    name = param.get_attr("name", optional=True)
    if file is not None and name is not None:
        raise RuntimeError("name and from attributes are mutually exclusive")
    if file is not None:
        allowed = parser.parse_substitution(allow) if isinstance(allow, str) else bool(allow)
        param.assert_entity_completely_parsed()
        return ParameterFile(parser.parse_substitution(file), allow_substs=allowed)
    if name is None:
        raise ValueError("param Entity should have name or from attribute")
    if allow is not None:
        raise RuntimeError("'allow_substs' can only be used together with 'from' attribute")
    return _nested([param], parser)


def _nested(params: Iterable[Entity], parser: Parser) -> dict[Any, Any]:
    found: dict[Any, Any] = {}
    for param in params:
        name = tuple(parser.parse_substitution(param.get_attr("name")))
        word = param.get_attr("type", data_type=None, optional=True)
        kind = None if word is None else get_data_type_from_identifier(word)
        value = param.get_attr("value", data_type=kind, optional=True)
        inner = param.get_attr("param", data_type=_ENTITIES, optional=True)
        param.assert_entity_completely_parsed()
        if inner and value is not None:
            raise RuntimeError("nested parameters and value attributes are mutually exclusive")
        if inner and kind is not None:
            raise RuntimeError("nested parameters and type attributes are mutually exclusive")
        if value is not None:
            made = parser.parse_if_substitutions(value)
            found[name] = ParameterValue(made, value_type=kind)
        elif inner:
            found[name] = _nested(inner, parser)
        else:
            raise RuntimeError("either a value attribute or nested params are needed")
    return found
