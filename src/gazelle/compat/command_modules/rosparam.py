"""rosparam's functions: parameters from and to YAML."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from gazelle.compat.rospy import client
from gazelle.compat.rospy.binary_params import as_bytes
from gazelle.documents.yaml import ROSPARAM, YamlError, dump_yaml, load_yaml
from gazelle.errors import GazelleError
from gazelle.graph.names import join, resolve

__all__ = [
    "NAME",
    "NS",
    "RosParamException",
    "RosParamIOException",
    "delete_param",
    "dump_params",
    "get_param",
    "list_params",
    "load_file",
    "load_str",
    "set_param",
    "set_param_raw",
    "upload_params",
]

_NAMESPACE_KEY = "_ns"
NAME = "rosparam"
NS = _NAMESPACE_KEY
Text = str


class RosParamException(Exception):  # noqa: N818 - rosparam's name
    """Parameters cannot be read or set."""


class RosParamIOException(RosParamException):
    """The graph or a file cannot be reached."""


def load_file(
    filename: str,
    default_namespace: str | None = None,
    verbose: bool = False,
) -> list[tuple[Any, str]]:
    """Return parameters and namespace of each document of a YAML file.

    Raises:
        RosParamException: the file cannot be read, or is no YAML of parameters.
    """
    if verbose:
        _print(f"reading parameters from [{filename}]")
    try:
        text = Path(filename).read_text(encoding="utf-8")
    except OSError as error:
        raise RosParamException(f"file [{filename}] does not exist: {error.strerror}") from error
    return load_str(text, filename, default_namespace, verbose)


def load_str(
    str: Text,
    filename: Text,
    default_namespace: Text | None = None,
    verbose: bool = False,
) -> list[tuple[Any, Text]]:
    """Return parameters and namespace of each document of a YAML text.

    Raises:
        RosParamException: it is no YAML of parameters.
    """
    start = resolve(default_namespace or "/", client.get_namespace())
    found = []
    for part in _documents(str):
        try:
            values = load_yaml(part, ROSPARAM)
        except (YamlError, GazelleError) as error:
            raise RosParamException(f"[{filename}] is no YAML of parameters: {error}") from error
        if values is None:
            continue
        space = start
        if isinstance(values, dict) and _NAMESPACE_KEY in values:
            space = resolve(f"{values.pop(_NAMESPACE_KEY)}", start)
        if verbose:
            sys.stdout.write(f"reading parameters into namespace [{space}]\n")
        found.append((values, space))
    return found


def upload_params(ns: str, values: Any, verbose: bool = False) -> None:
    """Set parameters below a namespace.

    Raises:
        RosParamException: the root namespace takes a dictionary only.
    """
    if ns == "/" and not isinstance(values, dict):
        raise RosParamException("global / can only be set to a dictionary")
    set_param_raw(ns, values, verbose)


def get_param(param: str) -> Any:
    """Return a parameter.

    Raises:
        RosParamException: it is not set.
    """
    try:
        return client.get_param(param)
    except KeyError as error:
        raise RosParamException(f"Parameter [{param}] is not set") from error


def set_param(param: str, value: str, verbose: bool = False) -> None:
    """Set a parameter to a YAML value.

    Raises:
        RosParamException: it is no YAML.
    """
    try:
        parsed = load_yaml(value, ROSPARAM)
    except (YamlError, GazelleError) as error:
        raise RosParamException(f"'{value}' is no YAML: {error}") from error
    set_param_raw(param, parsed, verbose)


def set_param_raw(param: str, value: Any, verbose: bool = False) -> None:
    """Set a parameter; a dictionary adds to the namespace and takes nothing away.

    Raises:
        RosParamException: a dictionary has keys that are no text.
    """
    if isinstance(value, dict) and value:
        for key, item in value.items():
            if not isinstance(key, str):
                text = f"YAML dictionaries must have string keys, and [{param}] has {key!r}"
                raise RosParamException(text)
            set_param_raw(join(param, key), item, verbose)
        return
    if verbose:
        _print(f"set parameter [{param}] to [{value}]")
    client.set_param(param, value)


def delete_param(param: str, verbose: bool = False) -> None:
    """Delete a parameter.

    Raises:
        RosParamException: it is not set.
    """
    try:
        client.delete_param(param)
    except KeyError as error:
        raise RosParamException(f"Parameter [{param}] is not set") from error
    if verbose:
        _print(f"deleted parameter [{param}]")


def list_params(ns: str) -> list[str]:
    """Return the names of all parameters below a namespace, sorted."""
    start = resolve(ns or "/", client.get_namespace()).rstrip("/")
    return sorted(one for one in client.get_param_names() if one.startswith(f"{start}/"))


def dump_params(filename: str, param: str, verbose: bool = False) -> None:
    """Write parameters to a YAML file.

    Raises:
        RosParamException: there are none of the name.
    """
    tree = get_param(param)
    if verbose:
        _print(f"dumping namespace [{param}] to file [{filename}]")
    Path(filename).write_text(dump_yaml(as_bytes(tree)), encoding="utf-8")


def _documents(text: str) -> Iterator[str]:
    lines: list[str] = []
    for line in text.splitlines(keepends=True):
        if line.split(maxsplit=1)[:1] == ["---"] and line.startswith("---"):
            yield "".join(lines)
            lines = []
        else:
            lines.append(line)
    yield "".join(lines)


def _print(text: str) -> None:
    sys.stdout.write(f"{text}\n")
