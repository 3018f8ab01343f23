"""The ament index for C++: where packages are and what they have registered."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb
from gazelle.workspace import ament_index

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__ = ["packages", "prefix", "resource", "resources", "search_paths", "share"]


@verb("ament/prefix")
def prefix(host: HostContext, request: dict[str, Any]) -> str | None:
    """Return a package's prefix, null where there is none."""
    del host
    try:
        return ament_index.get_package_prefix(request["package"])
    except ament_index.PackageNotFoundError:
        return None


@verb("ament/share")
def share(host: HostContext, request: dict[str, Any]) -> str | None:
    """Return a package's share folder, null where there is none."""
    del host
    try:
        return ament_index.get_package_share_directory(request["package"])
    except ament_index.PackageNotFoundError:
        return None


@verb("ament/packages")
def packages(host: HostContext, request: dict[str, Any]) -> dict[str, str]:
    """Return the prefixes of all packages by name."""
    del host, request
    return ament_index.get_packages_with_prefixes()


@verb("ament/search_paths")
def search_paths(host: HostContext, request: dict[str, Any]) -> list[str]:
    """Return the prefixes that are looked into."""
    del host, request
    return ament_index.get_search_paths()


@verb("ament/resources")
def resources(host: HostContext, request: dict[str, Any]) -> dict[str, str]:
    """Return who has registered a resource of a type, with prefixes."""
    del host
    return ament_index.get_resources(request["type"])


@verb("ament/resource")
def resource(host: HostContext, request: dict[str, Any]) -> list[str] | None:
    """Return a resource's content and prefix, null where there is none."""
    del host
    try:
        return list(ament_index.get_resource(request["type"], request["name"]))
    except LookupError:
        return None
