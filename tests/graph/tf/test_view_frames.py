from __future__ import annotations

from gazelle.geometry import Pose
from gazelle.graph.tf import TransformBuffer, frames_as_dot, frames_as_string, frames_as_yaml

S = 1_000_000_000


def _buffer() -> TransformBuffer:
    buffer = TransformBuffer()
    for stamp_s in (1.0, 1.5, 2.0):
        buffer.set_transform("odom", "base", round(stamp_s * S), Pose(), authority="/drive")
    buffer.set_transform("base", "laser", 7 * S, Pose(), is_static=True, authority="/rsp")
    return buffer


def test_yaml_is_laid_out_as_by_tf2() -> None:
    assert frames_as_yaml(_buffer()) == (
        "base: \n  parent: 'odom'\n  broadcaster: '/drive'\n  rate: 3.000\n"
        "  most_recent_transform: 2.000\n  oldest_transform: 1.000\n  buffer_length: 1.000\n"
        "laser: \n  parent: 'base'\n  broadcaster: '/rsp'\n  rate: 10000.000\n"
        "  most_recent_transform: 0.000\n  oldest_transform: 0.000\n  buffer_length: 0.000\n"
    )
    assert "  transform_delay: 1.250\n" in frames_as_yaml(_buffer(), now_ns=3_250_000_000)
    assert frames_as_yaml(TransformBuffer()) == "{}"


def test_dot_has_an_edge_per_frame() -> None:
    text = frames_as_dot(_buffer(), now_ns=4 * S)
    assert (
        '"odom" -> "base"[label=" Broadcaster: /drive\\nAverage rate: 3.000\\nBuffer length: 1.000'
        '\\nMost recent transform: 2.000\\nOldest transform: 1.000\\n"];'
    ) in text
    assert '"Recorded at time: 4.000"[ shape=plaintext ] ;\n}->"odom";' in text
    assert "no tf data recieved" in frames_as_dot(TransformBuffer())


def test_string_has_a_line_per_frame() -> None:
    assert frames_as_string(_buffer()) == (
        "Frame base exists with parent odom.\nFrame laser exists with parent base.\n"
    )
