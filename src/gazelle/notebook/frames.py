"""Trees of coordinate frames."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

from gazelle.notebook.html_parts import figure, tree
from gazelle.rich_display import Bundle

if TYPE_CHECKING:
    from gazelle.graph.tf.buffer import FrameInfo, TransformBuffer

__all__ = ["Edge", "buffer_bundle", "frame_tree"]


class Edge(NamedTuple):
    """A frame below another, with words about it."""

    parent: str
    child: str
    remark: str = ""


def buffer_bundle(buffer: TransformBuffer) -> Bundle:
    """Return the tree of a buffer."""
    edges = [Edge(one.parent, one.name, _rate_text(one)) for one in buffer.frames()]
    return {"text/html": figure(frame_tree(edges), f"{len(buffer.frame_names())} frames")}


def frame_tree(edges: Iterable[Edge]) -> str:
    """Return a tree of frames; what hangs in a loop is told at its first frame."""
    children: dict[str, list[Edge]] = {}
    below: dict[str, None] = {}
    for edge in edges:
        children.setdefault(edge.parent, []).append(edge)
        below.setdefault(edge.child)
    lines: list[tuple[int, str, str]] = []
    seen: set[str] = set()

    def grow(root: str, remark: str) -> None:
        waiting = [(0, root, remark)]
        while waiting:
            depth, name, words = waiting.pop()
            lines.append((depth, name, words))
            if name in seen:
                continue
            seen.add(name)
            for edge in reversed(children.get(name, [])):
                waiting.append((depth + 1, edge.child, edge.remark))

    for parent in children:
        if parent not in below:
            grow(parent, "")
    for child in below:
        if child not in seen:
            grow(child, "part of a loop")
    return tree(lines)


def _rate_text(frame: FrameInfo) -> str:
    if frame.is_static:
        return "static"
    # Of one sample tf2 says 10000 Hz.
    return f"{frame.rate_hz:.3g} Hz" if frame.latest_ns > frame.oldest_ns else "told once"
