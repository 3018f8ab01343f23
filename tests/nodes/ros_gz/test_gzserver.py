"""gzserver of ros_gz_sim: its parameters."""

from __future__ import annotations

from typing import Any


def test_a_world_that_is_not_there_ends_it_and_slips_are_told(bench: Any, capfd: Any) -> None:
    bench.start(
        "ros_gz_sim/gzserver", "--ros-args", "-p", "world_sdf_file:=nowhere.sdf",
        "-p", "world_sdf_strin:=x", "-p", "initial_sim_time:=5.0",
    )  # fmt: skip
    assert bench.wait() == [1]
    told = capfd.readouterr().err
    assert "/gazebo: parameter 'world_sdf_strin' is not one of gzserver (ros_gz_sim)" in told
    assert "'initial_sim_time' (5.0) has no effect here: time begins at 0" in told
    assert "nowhere.sdf" in told
