"""Which attributes each roslaunch element knows (wiki: roslaunch/XML)."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["ELEMENTS", "Element"]


class Element(NamedTuple):
    """Attributes of an element; ``if`` and ``unless`` go with every one."""

    required: tuple[str, ...]
    optional: tuple[str, ...] = ()

    @property
    def attributes(self) -> tuple[str, ...]:
        """All attributes the element may have."""
        return (*self.required, *self.optional, "if", "unless")


_NODE_OPTIONS = ("args", "machine", "ns", "clear_params", "cwd", "launch-prefix")

ELEMENTS: dict[str, Element] = {
    "arg": Element(("name",), ("default", "value", "doc")),
    "env": Element(("name", "value")),
    "group": Element((), ("ns", "clear_params")),
    "include": Element(("file",), ("ns", "clear_params", "pass_all_args")),
    "machine": Element(
        ("name", "address"),
        ("env-loader", "ssh-port", "user", "password", "default", "timeout"),
    ),
    "node": Element(
        ("pkg", "type", "name"),
        (*_NODE_OPTIONS, "respawn", "respawn_delay", "required", "output"),
    ),
    "param": Element(("name",), ("value", "type", "textfile", "binfile", "command")),
    "remap": Element(("from", "to")),
    "rosparam": Element((), ("command", "file", "param", "ns", "subst_value")),
    "test": Element(("test-name", "pkg", "type"), ("name", *_NODE_OPTIONS, "time-limit", "retry")),
}  # fmt: skip
