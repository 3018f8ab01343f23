"""Parameters that a Python program gives a simulation, of ROS 1 or ROS 2."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from gazelle.documents.yaml import YamlError, load_yaml_file
from gazelle.errors import GazelleError
from gazelle.simulator.node_interfaces import ParameterPort
from gazelle.simulator.world_controller_managers import ControlRegistry

__all__ = ["Parameters", "give_parameters"]

Parameters = Mapping[str, Any] | str | os.PathLike[str] | Sequence[Any]
_MARK = "ros__parameters"


def give_parameters(
    parameters: Parameters, store: ParameterPort, controls: ControlRegistry
) -> None:
    """Put parameters where plug-ins and controllers look for them.

    Args:
        parameters: a mapping, a YAML file's path, or a list of such. What has a
            ``ros__parameters`` level is ROS 2's and read as a parameter file is; the rest goes
            into the ROS 1 store, by names that start at the root. A path as a value of a
            mapping is a file whose values lie below that name.
        store: the ROS 1 store.
        controls: receives ROS 2's.

    Raises:
        GazelleError: a file cannot be read, or holds no mapping.
    """
    if isinstance(parameters, Mapping):
        _give(parameters, store, controls)
    elif isinstance(parameters, str | os.PathLike):
        tree = _tree_of(Path(parameters), controls)
        _give(tree, store, controls)
    else:
        for one in parameters:
            give_parameters(one, store, controls)


def _give(tree: Mapping[str, Any], store: ParameterPort, controls: ControlRegistry) -> None:
    for name, value in tree.items():
        if isinstance(value, os.PathLike):
            found = _tree_of(Path(value), controls)
            if found:
                store.set(f"/{str(name).strip('/')}", dict(found))
        elif isinstance(value, Mapping) and _is_ros2(value):
            _give_nodes(str(name), value, controls)
        else:
            store.set(f"/{str(name).strip('/')}", value)


def _give_nodes(name: str, tree: Mapping[str, Any], controls: ControlRegistry) -> None:
    """Keep parameters of nodes by the nodes' own names: one robot is meant."""
    for key, value in tree.items():
        if key == _MARK:
            known = controls.overrides.setdefault(name.rpartition("/")[2], {})
            known.update(value or {})
        elif isinstance(value, Mapping):
            _give_nodes(str(key), value, controls)


def _tree_of(path: Path, controls: ControlRegistry) -> Mapping[str, Any]:
    """Return a file's values; nothing for ROS 2's, which are read by whoever has a namespace."""
    tree = _read(path)
    if not _is_ros2(tree):
        return tree
    controls.files.append(path)
    return {}


def _is_ros2(tree: Mapping[str, Any]) -> bool:
    return any(
        key == _MARK or (isinstance(value, Mapping) and _is_ros2(value))
        for key, value in tree.items()
    )


def _read(path: Path) -> Mapping[str, Any]:
    try:
        tree = load_yaml_file(path)
    except YamlError as error:
        raise GazelleError(f"parameter file '{path}' cannot be read: {error}") from error
    if not isinstance(tree, Mapping):
        kind = "nothing" if tree is None else f"a {type(tree).__name__}"
        raise GazelleError(f"parameter file '{path}' holds {kind}, not names with values")
    return tree
