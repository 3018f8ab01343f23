"""Verbs of what rospack tells of packages beside where they are."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__: list[str] = []


@verb("rospack/exports")
def exports(host: HostContext, request: dict[str, Any]) -> list[list[str]]:
    """Return what packages export for ``package``: their names and values of ``attribute``."""
    from gazelle.cpp.verbs.package import workspace_of

    name, attribute = request["package"], request["attribute"]
    return [
        [package.name, value.replace("${prefix}", str(package.path))]
        for package in workspace_of(host).user_packages
        for export in package.exports
        if export.name == name and (value := export.get(attribute))
    ]


@verb("rospack/depends")
def depends(host: HostContext, request: dict[str, Any]) -> list[str]:
    """Return what a package needs (``depends``, ``depends1``), or who needs it (``depends-on``)."""
    from gazelle.cpp.verbs.package import workspace_of

    command, name = request["command"], request["package"]
    packages = workspace_of(host).packages
    needs = {one: set(package.depends) & set(packages) for one, package in packages.items()}
    if command.startswith("depends-on"):
        needs = {one: {by for by, them in needs.items() if one in them} for one in needs}
    found = set(needs.get(name, ()))
    while not command.endswith("1"):
        further = set().union(*(needs[one] for one in found)) - found if found else set()
        if not further:
            break
        found |= further
    return sorted(found - {name})
