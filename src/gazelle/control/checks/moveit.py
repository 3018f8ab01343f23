"""What MoveIt believes about controllers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

__all__ = ["MoveItController", "moveit_controllers"]

_MANAGER = "moveit_simple_controller_manager"


@dataclass(frozen=True, slots=True)
class MoveItController:
    """A controller that MoveIt sends trajectories to."""

    name: str
    joints: tuple[str, ...]


def moveit_controllers(tree: Mapping[str, Any]) -> tuple[MoveItController, ...]:
    """Read the parameters of a ``move_group``, of ROS 1 or ROS 2.

    ROS 1 has a ``controller_list`` of dictionaries (``controllers.yaml``), ROS 2 names and a
    branch for each (``moveit_controllers.yaml``). An empty result means there are none.
    """
    listed = tree.get("controller_list")
    if isinstance(listed, list):
        return tuple(_from_list(listed))
    branch = tree.get(_MANAGER, tree)
    names = branch.get("controller_names") if isinstance(branch, Mapping) else None
    if not isinstance(names, list):
        return ()
    found = ((str(name), branch.get(str(name))) for name in names)
    return tuple(
        MoveItController(name, _texts(row.get("joints")) if isinstance(row, Mapping) else ())
        for name, row in found
    )


def _from_list(rows: list[Any]) -> Iterator[MoveItController]:
    for row in rows:
        if isinstance(row, Mapping) and isinstance(row.get("name"), str):
            yield MoveItController(row["name"].strip("/"), _texts(row.get("joints")))


def _texts(value: Any) -> tuple[str, ...]:
    return tuple(str(item) for item in value) if isinstance(value, list) else ()
