"""``-b`` of rostopic and rosmsg."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cli import rosmsg, rostopic

pytestmark = pytest.mark.reference


def test_rostopic_lists_and_echoes_a_bag(
    ros1_dir: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag = str(ros1_dir / "t.bag")
    assert rostopic.main(["list", "-b", bag]) == 0
    assert capsys.readouterr().out == "/tf_static\n/joint_states\n/tf\n"
    assert rostopic.main(["echo", "-b", bag, "-n", "1", "-p", "/joint_states/position"]) == 0
    assert capsys.readouterr().out == (
        "%time,field0,field1,field2\n1795226405809618176,0.0,0.0,0.0\n"
    )
    assert rostopic.main(["echo", "-b", bag, "/joint_stats"]) == 1
    assert "did you mean '/joint_states'" in capsys.readouterr().err


def test_rosmsg_shows_a_type_of_a_bag(ros1_dir: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bag = str(ros1_dir / "t.bag")
    assert rosmsg.main(["rosmsg", "show", "-b", bag, "sensor_msgs/JointState"]) == 0
    assert capsys.readouterr().out.startswith("std_msgs/Header header\n  uint32 seq\n")


def test_rostopic_measures_a_bag(ros1_dir: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bag = str(ros1_dir / "t.bag")
    assert rostopic.main(["hz", "-b", bag, "/joint_states"]) == 0
    rate = "average rate: 10.000\n\tmin: 0.099s max: 0.100s std dev: 0.00018s window: 38\n"
    assert capsys.readouterr().out == rate
    assert rostopic.main(["hz", "-b", bag, "/tf", "--filter", "len(m.transforms) > 9"]) == 0
    assert capsys.readouterr().out == "no new messages\n"
    assert rostopic.main(["bw", "-b", bag, "/joint_states"]) == 0
    assert capsys.readouterr().out == (
        "average: 1.03KB/s\n\tmean: 0.10KB min: 0.10KB max: 0.10KB window: 38\n"
    )
    assert rostopic.main(["bw", "-b", bag, "/joint_stats"]) == 1
    assert "topic [/joint_stats] is not in bag file" in capsys.readouterr().err
