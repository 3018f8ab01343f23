"""Verbs of rclcpp."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__ = ["parameter_file"]


@verb("rclcpp/parameter_file")
def parameter_file(host: HostContext, request: dict[str, Any]) -> dict[str, Any]:
    """Return what a file of parameters says for a node, below the node's name.

    Args:
        host: is not asked.
        request: ``path`` and the ``node``'s global name.

    Raises:
        UserFileError: the file has errors.
    """
    from gazelle.control.parameter_sources.ros2_parameter_file import read_parameters_of
    from gazelle.diagnostics import Diagnostics

    del host
    node, diagnostics = request["node"], Diagnostics()
    found = read_parameters_of(node, [Path(request["path"])], diagnostics)
    diagnostics.raise_if_errors()
    return {node: dict(found)} if found else {}
