"""``rosbag/record`` and ``rosbag/play`` in a launch file; ``--clock`` is the others' time."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from tests.patience import stretched

from gazelle.bag import Storage, create_bag, open_bag, ros1_connection
from gazelle.interfaces import ros1_message_type, to_ros1

_LAUNCH = """
<launch>
  <param name="/use_sim_time" value="true"/>
  <node pkg="rosbag" type="record" name="recorder" args="-O {folder}/out /word"/>
  <node pkg="rosbag" type="play" name="player" required="true"
        args="--clock --wait-for-subscribers {folder}/in.bag"/>
</launch>
"""


def test_a_launched_recorder_stamps_with_the_clock_that_a_bag_plays(
    gazelle: Callable, tmp_path: Path
) -> None:
    start_ns = 1_000_000_000_000
    writer = create_bag(tmp_path / "in.bag", Storage.ROS1)
    words = writer.add(ros1_connection("/word", "std_msgs/String"))
    kind = ros1_message_type("std_msgs/String")
    for place in range(10):
        writer.write(words, start_ns + place * 100_000_000, to_ros1(kind(f"{place}")))
    writer.close()
    (tmp_path / "a.launch").write_text(_LAUNCH.format(folder=tmp_path))
    run = gazelle("roslaunch", "a.launch")
    run.wait_for_line("REQUIRED process")
    run.wait()
    messages = list(open_bag(tmp_path / "out.bag").messages())
    assert len(messages) == 10
    assert messages[0].connection.callerid == "/player"
    offsets = [one.stamp_ns - start_ns - place * 10**8 for place, one in enumerate(messages)]
    # The wall's clock is decades away from the bag's.
    assert max(map(abs, offsets[1:])) < stretched(1.0) * 1e9
