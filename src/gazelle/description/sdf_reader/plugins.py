"""SDF ``<plugin>``."""

from __future__ import annotations

from gazelle.description.model import PluginTag
from gazelle.description.xml import Tag

__all__ = ["read_plugin", "read_plugins"]


def read_plugin(tag: Tag, *, reference: str = "") -> PluginTag:
    """Return a plug-in's tag; what its parameters mean is for the plug-in.

    Args:
        tag: the ``<plugin>`` element.
        reference: link or joint of an enclosing ``<gazebo reference>``, or the scope of a
            nested model such as ``arm`` or ``arm::gripper``.
    """
    return PluginTag(
        name=tag.attributes.get("name", ""),
        filename=tag.attributes.get("filename", ""),
        parameters=tag,
        reference=reference,
    )


def read_plugins(tag: Tag, *, reference: str = "") -> tuple[PluginTag, ...]:
    """Return the plug-ins among a tag's children, in document order."""
    return tuple(read_plugin(child, reference=reference) for child in tag.find_all("plugin"))
