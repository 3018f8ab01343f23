"""The frames of a buffer as text: YAML and graphviz, laid out as tf2 and view_frames do."""

from __future__ import annotations

from gazelle.graph.tf.buffer import FrameInfo, TransformBuffer

__all__ = ["frames_as_dot", "frames_as_string", "frames_as_yaml"]


def frames_as_string(buffer: TransformBuffer) -> str:
    """Return one line per frame (tf2 ``allFramesAsString``)."""
    return "".join(
        f"Frame {one.name} exists with parent {one.parent}.\n" for one in buffer.frames()
    )


def frames_as_yaml(buffer: TransformBuffer, now_ns: int = 0) -> str:
    """Return all about each frame (tf2 ``allFramesAsYAML``).

    Args:
        buffer: whose frames.
        now_ns: the time, for the delay of each frame; left out when 0.
    """
    blocks = []
    for one in buffer.frames():
        lines = [
            f"{one.name}: ",
            f"  parent: '{one.parent}'",
            f"  broadcaster: '{one.authority}'",
            f"  rate: {one.rate_hz:.3f}",
            f"  most_recent_transform: {one.latest_ns / 1e9:.3f}",
            f"  oldest_transform: {one.oldest_ns / 1e9:.3f}",
        ]
        if now_ns:
            lines.append(f"  transform_delay: {(now_ns - one.latest_ns) / 1e9:.3f}")
        lines.append(f"  buffer_length: {(one.latest_ns - one.oldest_ns) / 1e9:.3f}")
        blocks.append("\n".join(lines) + "\n")
    return "".join(blocks) or "{}"


def frames_as_dot(buffer: TransformBuffer, now_ns: int = 0) -> str:
    """Return a graphviz graph (what ``view_frames`` draws).

    Args:
        buffer: whose frames.
        now_ns: the time, for the legend.
    """
    frames = buffer.frames()
    if not frames:
        return 'digraph G {\n"no tf data recieved"\n}'
    lines = ["digraph G {", *(_edge(one) for one in frames)]
    children = {one.name for one in frames}
    for root in sorted({one.parent for one in frames} - children):
        lines += [
            "edge [style=invis];",
            ' subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";',
            f'"Recorded at time: {now_ns / 1e9:.3f}"[ shape=plaintext ] ;',
            f'}}->"{root}";',
        ]
    return "\n".join([*lines, "}"])


def _edge(one: FrameInfo) -> str:
    length_s = (one.latest_ns - one.oldest_ns) / 1e9
    return (
        f'"{one.parent}" -> "{one.name}"[label=" Broadcaster: {one.authority}\\n'
        f"Average rate: {one.rate_hz:.3f}\\nBuffer length: {length_s:.3f}\\n"
        f"Most recent transform: {one.latest_ns / 1e9:.3f}\\n"
        f'Oldest transform: {one.oldest_ns / 1e9:.3f}\\n"];'
    )
