"""What ``check_urdf`` and ``urdf_to_graphviz`` print about a robot that urdfdom accepts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from gazelle.description.urdfdom_emulation.model import Robot
from gazelle.description.urdfdom_emulation.values import rpy_from_quaternion

__all__ = ["EndlessTreeError", "graphviz_text", "tree_text"]

# A link with two parents is printed under both, with all below it: a few dozen such links in a
# row are more lines than there are atoms. Every step of indentation counts, 4 bytes each.
_MAX_STEPS = 20_000_000


class EndlessTreeError(ValueError):
    """More would be printed than anybody reads; the text says what the real programs would do."""


class _TreeNode(NamedTuple):
    """A link where it hangs: 1-based among its siblings, 1 below the root."""

    link: str
    parent: str
    number: int
    depth: int


def tree_text(robot: Robot) -> str:
    """Return the standard output of ``check_urdf``.

    Raises:
        EndlessTreeError: links with several parents make it too long, or a loop of joints hangs
            on the root.
    """
    count = len(robot.children.get(robot.root, ()))
    lines = [
        f"robot name is: {robot.name}",
        "---------- Successfully Parsed XML ---------------",
        f"root Link: {robot.root} has {count} child(ren)",
    ]
    for node in _below(robot):
        lines.append(f"{'    ' * node.depth}child({node.number}):  {node.link}")
    return "\n".join(lines) + "\n"


def graphviz_text(robot: Robot) -> str:
    """Return the ``.gv`` file that ``urdf_to_graphviz`` writes: links, joints, origins.

    Raises:
        EndlessTreeError: as in `tree_text`.
    """
    nodes = list(_below(robot))
    lines = ["digraph G {", "node [shape=box];"]
    for name in (robot.root, *(node.link for node in nodes)):
        lines.append(f'"{name}" [label="{name}"];')
    lines.append("node [shape=ellipse, color=blue, fontcolor=blue];")
    for node in nodes:
        lines += _edges(robot, node)
    return "\n".join([*lines, "}"]) + "\n"


def _edges(robot: Robot, node: _TreeNode) -> list[str]:
    joint = robot.joint_above[node.link]
    xyz = " ".join(f"{value:g}" for value in joint.T_parent_joint.xyz_m)
    rpy = " ".join(f"{v:g}" for v in rpy_from_quaternion(joint.T_parent_joint.quat_xyzw))
    return [
        f'"{node.parent}" -> "{joint.name}" [label="xyz: {xyz} \\nrpy: {rpy}"]',
        f'"{joint.name}" -> "{node.link}"',
    ]


def _below(robot: Robot) -> Iterator[_TreeNode]:
    """Yield what hangs on the root in the order of printing, without recursion."""
    waiting = _children(robot, robot.root, 1)
    steps = 0
    while waiting:
        node = waiting.pop()
        steps += node.depth
        if node.depth > len(robot.joint_above):
            text = f"the joints around link '{node.link}' form a loop"
            raise EndlessTreeError(f"{text}; the one of ROS would crash here")
        if steps > _MAX_STEPS:
            text = "the tree is too deep, or its links have too many parents"
            raise EndlessTreeError(f"{text}; the one of ROS would print gigabytes, or crash")
        yield node
        waiting += _children(robot, node.link, node.depth + 1)


def _children(robot: Robot, link: str, depth: int) -> list[_TreeNode]:
    """Return a link's children, the first one last."""
    names = enumerate(robot.children.get(link, ()), start=1)
    return [_TreeNode(name, link, number, depth) for number, name in names][::-1]
