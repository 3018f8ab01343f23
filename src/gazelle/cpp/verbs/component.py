"""Verbs of components: where they are, and what their libraries need."""

from __future__ import annotations

import ctypes
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb
from gazelle.cpp.verbs.package import workspace_of
from gazelle.errors import GazelleError

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__ = ["prepare", "resources"]


@verb("component/resources")
def resources(host: HostContext, request: dict[str, Any]) -> list[list[str]]:
    """Return classes and libraries of a package's components, compiled first where it is source.

    Args:
        host: whose workspace is asked.
        request: ``package`` and the ``index`` that it is registered in.

    Raises:
        GazelleError: there is no such package, or it cannot be compiled.
    """
    from gazelle.cpp.component_libraries import registered_components
    from gazelle.cpp.host.signal_mask import signals_for_children
    from gazelle.diagnostics import Diagnostics, render_text

    name, workspace, diagnostics = request["package"], workspace_of(host), Diagnostics()
    with signals_for_children():
        found = registered_components(
            workspace.package(name),
            workspace=workspace,
            diagnostics=diagnostics,
            index=request["index"],
        )
    if not found:
        told = "\n".join(render_text(one) for one in diagnostics)
        raise GazelleError(told or f"Could not find requested resource in ament index for '{name}'")
    return [[one.plugin, str(one.library)] for one in found]


@verb("component/prepare")
def prepare(host: HostContext, request: dict[str, Any]) -> None:
    """Load what a library needs of Gazelle's own, which nothing else would find."""
    from gazelle.cpp.building.runtime import libraries_for
    from gazelle.cpp.host.signal_mask import signals_for_children

    del host
    with signals_for_children():
        libraries = libraries_for(Path(request["library"]))
    for library in libraries:
        ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL | os.RTLD_NOW)
