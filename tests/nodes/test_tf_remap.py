"""Frames get other names on their way from /tf_old to /tf."""

from __future__ import annotations

from typing import Any

from gazelle.interfaces import message_type

_KIND = "tf2_msgs/msg/TFMessage"


def test_frames_of_the_list_are_renamed_and_others_kept(bench: Any) -> None:
    bench.start("tf/tf_remap", "_mappings:=[{old: base, new: base_link}, {old: lost}]")
    got = bench.listen("/tf", _KIND)
    out = bench.node.create_publisher("/tf_old", message_type(_KIND))
    bench.eventually(lambda: out.matched)
    transform = message_type("geometry_msgs/msg/TransformStamped")()
    transform.header.frame_id, transform.child_frame_id = "base", "laser"
    out.publish(message_type(_KIND)(transforms=[transform]))
    bench.eventually(lambda: got)
    (renamed,) = got[0].transforms
    assert (renamed.header.frame_id, renamed.child_frame_id) == ("base_link", "laser")
    assert bench.stop() == [0]
