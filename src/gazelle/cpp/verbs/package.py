"""Verbs of packages: where they are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext
    from gazelle.workspace import Workspace

__all__: list[str] = []

_WORKSPACE = "package/workspace"


@verb("package/path")
def path(host: HostContext, request: dict[str, Any]) -> str | None:
    """Return a package's folder, null where there is none of the name."""
    from gazelle.errors import NotFoundError

    try:
        return str(workspace_of(host).package(request["package"]).path)
    except NotFoundError:
        return None


@verb("package/all")
def every(host: HostContext, request: dict[str, Any]) -> list[str]:
    """Return the names of all packages, sorted."""
    del request
    return sorted(workspace_of(host).packages)


def workspace_of(host: HostContext) -> Workspace:
    """Return what the environment says where packages are, read once a process."""
    found: Workspace | None = host.state.get(_WORKSPACE)
    if found is None:
        from gazelle.workspace import Workspace

        found = host.state[_WORKSPACE] = Workspace.discover()
    return found
