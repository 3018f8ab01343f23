"""Parameter values: roslaunch's typing of texts and the YAML of ``<rosparam>``."""

from __future__ import annotations

import math
import re
from typing import Any

import yaml

from gazelle.limits import Budget, compile_limited
from gazelle.limits.yaml_text import LimitedLoader

__all__ = ["PARAM_TYPES", "bool_value", "flatten", "load_yaml", "param_value"]

PARAM_TYPES = ("auto", "str", "string", "int", "double", "bool", "boolean", "yaml")
_ANGLE = re.compile(r"^(?P<unit>deg|rad)\((?P<expression>[^()]*)\)$")
_ANGLE_TEXT = re.compile(r"^[0-9pi\s.eE+*/-]*$")


def param_value(text: str, type_name: str) -> Any:
    """Return the typed value of a ``<param>``.

    ``auto`` tries int, float (only with a dot: ``1e-3`` stays a string, as in roslaunch), bool.

    Raises:
        ValueError: the text does not fit the type, or the type is unknown.
    """
    if type_name == "auto":
        return _auto_value(text)
    if type_name in {"str", "string"}:
        return text
    if type_name == "int":
        return int(text)
    if type_name == "double":
        return float(text)
    if type_name in {"bool", "boolean"}:
        return bool_value(text)
    if type_name == "yaml":
        return load_yaml(text)
    raise ValueError(f"type '{type_name}' is unknown; known are {', '.join(PARAM_TYPES)}")


def bool_value(text: str) -> bool:
    """Return roslaunch's truth value: true, 1, false or 0.

    Raises:
        ValueError: it is none of these.
    """
    lowered = text.lower().strip()
    if lowered in {"true", "1"}:
        return True
    if lowered in {"false", "0"}:
        return False
    raise ValueError(f"{text} is not a 'bool' type")


def load_yaml(text: str) -> Any:
    """Load YAML 1.1 with ROS's ``deg(…)`` and ``rad(…)``.

    Raises:
        yaml.YAMLError: the text is not YAML.
    """
    return yaml.load(text, Loader=_RosLoader)  # noqa: S506 - a safe loader with two number forms


def flatten(name: str, value: Any) -> dict[str, Any]:
    """Return the leaves of a parameter tree by absolute name; an empty dict is a leaf."""
    if not isinstance(value, dict) or not value:
        return {name or "/": value}
    leaves: dict[str, Any] = {}
    for key, item in value.items():
        leaves.update(flatten(f"{name.rstrip('/')}/{key}", item))
    return leaves


def _auto_value(text: str) -> Any:
    try:
        return float(text) if "." in text else int(text)
    except ValueError:
        lowered = text.lower()
        return lowered == "true" if lowered in {"true", "false"} else text


class _RosLoader(LimitedLoader):
    """A loader of its own, so that other users of PyYAML keep theirs."""


def _angle(loader: yaml.SafeLoader, node: yaml.ScalarNode) -> float:
    text = str(loader.construct_scalar(node))
    match = _ANGLE.match(text)
    expression = match.group("expression") if match else text
    if not _ANGLE_TEXT.match(expression):
        raise yaml.constructor.ConstructorError(
            None, None, f"invalid angle '{text}'", node.start_mark
        )
    value = _arithmetic(expression)
    return math.radians(value) if match and match.group("unit") == "deg" else value


def _arithmetic(expression: str) -> float:
    """Evaluate numbers, pi and + - * / (the regular expression let nothing else through)."""
    code, names = compile_limited(expression.strip() or "0"), {"__builtins__": Budget().names}
    return float(eval(code, names, {"pi": math.pi}))  # noqa: S307


_RosLoader.add_constructor("!angle", _angle)
_RosLoader.add_implicit_resolver("!angle", _ANGLE, ["d", "r"])
