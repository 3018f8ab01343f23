"""Plug-ins for C++'s pluginlib: which classes packages declare, and their libraries."""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb
from gazelle.cpp.verbs.package import workspace_of
from gazelle.errors import GazelleError

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__ = ["declared", "library"]


@verb("plugins/declared")
def declared(host: HostContext, request: dict[str, Any]) -> dict[str, Any]:
    """Return the classes that packages declare for a package's base class.

    Args:
        host: whose workspace is asked.
        request: ``package``, ``base``, ``attribute``, ``xml_paths``.
    """
    from gazelle.cpp.plugins import declared_plugins

    found = declared_plugins(
        workspace_of(host),
        request["package"],
        request["base"],
        attribute=request.get("attribute") or "plugin",
        files=[Path(path) for path in request.get("xml_paths", ())],
    )
    answer: dict[str, Any] = {
        "xml_paths": [str(path) for path in found.files],
        "classes": [
            {
                "name": one.name,
                "type": one.type,
                "package": one.package.name,
                "description": one.description,
                "library": one.library,
                "manifest": str(one.manifest),
            }
            for one in found.classes
        ],
    }
    if found.problems:
        answer["error"] = "\n".join(found.problems)
    return answer


@verb("plugins/library")
def library(host: HostContext, request: dict[str, Any]) -> dict[str, str]:
    """Return the file of a plug-in's library, compiled first where it is source.

    What it is linked with of Gazelle's own is loaded here, as nothing else would find it.

    Args:
        host: whose workspace is asked.
        request: ``package``, ``library`` as the description has it, ``manifest``.

    Raises:
        GazelleError: it cannot be compiled; the message has the compiler's words.
    """
    from gazelle.cpp.building.runtime import libraries_for
    from gazelle.cpp.host.signal_mask import signals_for_children
    from gazelle.cpp.plugins import library_file
    from gazelle.diagnostics import Diagnostics, SourceSpan, render_text

    workspace, diagnostics = workspace_of(host), Diagnostics()
    package = workspace.package(request["package"])
    with signals_for_children():
        found = library_file(
            package,
            request["library"],
            workspace=workspace,
            diagnostics=diagnostics,
            span=SourceSpan(request["manifest"]),
        )
        needed = [] if found is None else libraries_for(found)
    told = "\n".join(render_text(item) for item in diagnostics)
    if found is None:
        raise GazelleError(told or "the library is not there")
    if told:
        host.log(0, 30, told, "", ("", 0, ""))
    for path in needed:
        ctypes.CDLL(str(path), mode=ctypes.RTLD_GLOBAL)
    return {"path": str(found)}
