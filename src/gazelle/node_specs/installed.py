"""Nodes of other people's pip packages, by entry points named ``package/executable``."""

from __future__ import annotations

from gazelle.node_specs.spec import NodeSpec

__all__ = ["installed_names", "installed_spec"]


def installed_names() -> tuple[tuple[str, str], ...]:
    """Return packages of ROS and executables that installed packages add; imports none."""
    from gazelle.extensions import ExtensionGroup, entry_points_of

    names = (point.name.partition("/") for point in entry_points_of(ExtensionGroup.NODES))
    return tuple((package, executable) for package, _, executable in names)


def installed_spec(package: str, executable: str) -> NodeSpec | None:
    """Return the row of an installed package's node, None when there is none of this name.

    Raises:
        ExtensionError: the row cannot be imported, or is something else.
    """
    from gazelle.extensions import ExtensionGroup, find_entry_point, load_extension

    point = find_entry_point(ExtensionGroup.NODES, f"{package}/{executable}")
    return None if point is None else load_extension(point, NodeSpec)
