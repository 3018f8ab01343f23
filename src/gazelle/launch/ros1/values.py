"""Parameter values: roslaunch's typing of texts and the YAML of ``<rosparam>``."""

from __future__ import annotations

from typing import Any

from gazelle.documents.yaml import ROSPARAM, load_yaml

__all__ = ["PARAM_TYPES", "bool_value", "param_value"]

PARAM_TYPES = ("auto", "str", "string", "int", "double", "bool", "boolean", "yaml")


def param_value(text: str, type_name: str) -> Any:
    """Return the typed value of a ``<param>``.

    ``auto`` tries int, float (only with a dot: ``1e-3`` stays a string, as in roslaunch), bool.

    Raises:
        ValueError: the text does not fit the type, or the type is unknown.
        YamlError: it is no YAML, for the type ``yaml``.
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
        return load_yaml(text, ROSPARAM)
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


def _auto_value(text: str) -> Any:
    try:
        return float(text) if "." in text else int(text)
    except ValueError:
        lowered = text.lower()
        return lowered == "true" if lowered in {"true", "false"} else text
