"""Parameters of filters: those without effect are one line a node, unknown ones are told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.nodes.parameters import node_reader
from gazelle.nodes.robot_localization.parameters import (
    POSE_EKF,
    ekf_inputs,
    ekf_table,
    threshold_owners,
)

_CONFIG = "[" + ", ".join(["false"] * 6 + ["true"] * 6 + ["false"] * 3) + "]"


def _codes(found: Diagnostics) -> list[tuple[str, str]]:
    return [(item.code, item.message.split("'")[1]) for item in found]


def test_settings_of_the_filters_inside_are_idle_and_slips_are_unknown() -> None:
    found = Diagnostics()
    tree = {
        "frequency": 30, "sensor_timeout": 0.1, "use_control": False, "debug": True,
        "odom0": "/odom", "odom0_config": [], "odom0_queue_size": 2, "odom0_relativ": True,
        "odom0_pose_rejection_threshold": 5.0, "pose0": "/p", "pose0_rejection_threshold": 2.0,
        "imu3": "/imu", "imu3_linear_acceleration_rejection_threshold": 1.0, "two_d_mod": True,
    }  # fmt: skip
    node_reader(ekf_table(tree), tree, "/ekf", found).report_unknown()
    idle, unknown = "parameter.idle", "parameter.unknown"
    assert _codes(found) == [
        (idle, "sensor_timeout"), (idle, "debug"), (idle, "odom0_queue_size"),
        (unknown, "odom0_relativ"), (idle, "imu3_linear_acceleration_rejection_threshold"),
        (unknown, "two_d_mod"),
    ]  # fmt: skip
    assert "odom0_relative" in found.by_code(unknown)[0].fix
    found = Diagnostics()
    tree = {"gps_used": True, "vo_used": False, "debug": False}
    node_reader(POSE_EKF, tree, "/ekf", found).report_unknown()
    assert _codes(found) == [(idle, "gps_used")]


def test_inputs_are_the_topics_of_a_tree_in_the_order_of_their_numbers() -> None:
    tree = {"imu0": "/i", "odom10": "/b", "odom2": "/a", "odom3_config": [], "odom_frame": "odom"}
    assert ekf_inputs(tree) == ["odom2", "odom10", "imu0"]


def test_thresholds_of_a_pose_or_twist_have_no_part_in_their_names() -> None:
    assert threshold_owners("pose0") == {"pose0": "pose"}
    assert threshold_owners("twist1") == {"twist1": "twist"}
    assert threshold_owners("imu0") == {"imu0_pose": "pose", "imu0_twist": "twist"}


@pytest.mark.parametrize(
    ("node", "words", "count"),
    [
        (
            "robot_localization/ekf_localization_node",
            ["_odom0:=/odom", f"_odom0_config:={_CONFIG}", "_sensor_timeout:=0.1", "_debug:=true",
             "_use_control:=true"],
            3,
        ),
        ("robot_pose_ekf/robot_pose_ekf", ["_gps_used:=true", "_sensor_timeout:=1.0"], 2),
    ],
)  # fmt: skip
def test_settings_without_effect_are_one_line_a_node(
    bench: Any,
    node: str,
    words: list[str],
    count: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    bench.start(node, *words)
    assert bench.stop() == [0]
    told = "".join(capfd.readouterr())
    assert told.count("no effect here") == 2 and f"{count} settings are known" in told
    (log,) = tmp_path.glob("*.log")
    assert log.read_text().count("has no effect here") == count
