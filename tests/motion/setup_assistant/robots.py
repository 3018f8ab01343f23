"""Robots as short URDFs."""

from __future__ import annotations

from itertools import pairwise

__all__ = ["chain", "joint", "link"]


def link(name: str, size: str = "0.05 0.05 0.05", at: str = "0 0 0") -> str:
    """A box; without a size a link that has no shape."""
    if not size:
        return f'<link name="{name}"/>'
    return (
        f'<link name="{name}"><collision><origin xyz="{at}"/>'
        f'<geometry><box size="{size}"/></geometry></collision></link>'
    )


def joint(
    name: str, parent: str, child: str, kind: str = "revolute", at: str = "0 0 0.2",
    axis: str = "0 1 0", limits: str = 'lower="-1" upper="1"',
) -> str:  # fmt: skip
    """A joint with limits."""
    limit = f'<limit {limits} effort="1" velocity="2"/>' if kind != "fixed" else ""
    return (
        f'<joint name="{name}" type="{kind}"><origin xyz="{at}"/><parent link="{parent}"/>'
        f'<child link="{child}"/><axis xyz="{axis}"/>{limit}</joint>'
    )


def chain(prefix: str, root: str, count: int) -> str:
    """Joints and links in a row below a link."""
    names = [root, *(f"{prefix}link_{number}" for number in range(1, count + 1))]
    joints = [
        joint(f"{prefix}joint_{number}", parent, child)
        for number, (parent, child) in enumerate(pairwise(names), start=1)
    ]
    return "".join([*(link(name) for name in names[1:]), *joints])
