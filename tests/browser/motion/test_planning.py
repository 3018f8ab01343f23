"""Start and goal, planning, executing and stopping from the page; move_group is what is asked."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from tests.nodes.move_group.conftest import JOINTS, READY

pytestmark = pytest.mark.slow

_UP = [0.0] * 6


def _state(request: Any) -> dict[str, float]:
    joints = request.start_state.joint_state
    return dict(zip(joints.name, map(float, joints.position), strict=True))


def _goal(request: Any) -> list[float]:
    rows = {one.joint_name: one.position for one in request.goal_constraints[0].joint_constraints}
    return [float(rows[name]) for name in JOINTS]


def _is_valid(desk: Any, positions: list[float]) -> bool:
    state = {"joint_state": {"name": JOINTS, "position": positions}, "is_diff": True}
    words = {"group_name": "arm", "robot_state": state}
    return bool(desk.arm.call("check_state_validity", "GetStateValidity", **words).valid)


def test_choices_arrive_in_the_request(desk: Any) -> None:
    ui = desk.ui
    ui.choose("Goal state", "up")
    ui.choose("Planner", "pilz_industrial_motion_planner/PTP")
    for field, text in (
        ("Planning time (s)", "3.5"),
        ("Planning attempts", "2"),
        ("Velocity scaling", "0.25"),
        ("Acceleration scaling", "0.125"),
    ):
        ui.type(field, text)
    ui.press("Plan")
    ui.says("Planned: SUCCESS (1)")
    asked = desk.requests[-1]
    assert (asked.group_name, asked.planner_id) == ("arm", "PTP")
    assert asked.pipeline_id == "pilz_industrial_motion_planner"
    assert (asked.allowed_planning_time, asked.num_planning_attempts) == (3.5, 2)
    assert asked.max_velocity_scaling_factor == 0.25
    assert asked.max_acceleration_scaling_factor == 0.125
    assert _goal(asked) == _UP

    # The path as a trail, from its beginning to its end, and gone again.
    assert ui.counts()["path"] > 0 and ui.counts()["trail"] == 0
    ui.check("Trail")
    ui.eventually(lambda: ui.counts()["trail"] > 5)
    place = ui.panel.get_by_label("Place in the planned path")
    place.focus()
    for key, share in (("End", 1.0), ("Home", 0.0)):
        ui.page.keyboard.press(key)
        now, whole = place.get_attribute("aria-valuetext").removesuffix(" s").split(" / ")
        assert float(now) == pytest.approx(share * float(whole))
    ui.rviz.seen.shot("trail")
    ui.press("Clear")
    ui.shows(path=0, trail=0)
    assert ui.button("Clear").is_disabled() and ui.button("Execute").is_disabled()

    # A start of its own is a green ghost, drawn where nothing collides, and arrives.
    ui.panel.get_by_title("Show the start as a ghost").get_by_role("checkbox").check()
    ui.choose("Start state", "<random valid>")
    ui.eventually(lambda: ui.counts()["start"] > 0)
    ui.choose("Planner", "")
    ui.choose("Goal state", "<random valid>")
    ui.press("Plan")
    ui.says("Planned: SUCCESS (1)")
    asked = desk.requests[-1]
    start = [_state(asked)[name] for name in JOINTS]
    assert _is_valid(desk, start) and _is_valid(desk, _goal(asked))
    assert start != pytest.approx(READY) and _goal(asked) != pytest.approx(_UP)
    assert (asked.pipeline_id, asked.planner_id) == ("", "")
    ui.choose("Start state", "<current>")
    ui.choose("Goal state", "<previous>")
    ui.tab("Joints")
    assert ui.place_of(JOINTS) == pytest.approx(start, abs=1e-3)
    assert desk.positions["joint_3"] == READY[2], "planning moves nothing"


def test_execute_once_and_both_at_once(desk: Any) -> None:
    ui = desk.ui
    assert ui.button("Execute").is_disabled()
    ui.choose("Goal state", "up")
    ui.press("Plan")
    ui.says("Planned: SUCCESS (1)")
    ui.press("Execute")
    ui.says("Executed: SUCCESS (1)")
    assert [desk.positions[name] for name in JOINTS] == pytest.approx(_UP, abs=1e-6)
    # As in RViz: what was executed begins where the robot is no more.
    assert ui.button("Execute").is_disabled()

    # Plan & Execute begins where the robot is, whatever start is asked about.
    ui.choose("Start state", "<random valid>")
    ui.choose("Goal state", "ready")
    ui.press("Plan & Execute")
    ui.says("Executed: SUCCESS (1)")
    assert not _state(desk.requests[-1])
    assert [desk.positions[name] for name in JOINTS] == pytest.approx(READY, abs=1e-3)
    ui.press("Plan & Execute")
    ui.says("The robot is where it shall go.")


def test_stop_reaches_the_controller(open_desk: Callable[..., Any]) -> None:
    running: list[Any] = []
    desk = open_desk(end=running.append)
    ui = desk.ui
    ui.choose("Goal state", "up")
    ui.press("Plan & Execute")
    ui.says("Planning and executing")
    (goal,) = ui.eventually(lambda: running)
    assert goal.is_active and ui.button("Plan").is_disabled()
    ui.press("Stop")
    ui.says("Stopped.")
    ui.eventually(lambda: not goal.is_active)
    # The panel is ready for the next one.
    ui.press("Plan")
    ui.says("Planned: SUCCESS (1)")
    ui.press("Execute")
    ui.says("Executing")
    ui.eventually(lambda: len(running) == 2)
    ui.press("Stop")
    ui.eventually(lambda: not running[1].is_active)
    ui.says("Stopped.")
    assert [desk.positions[name] for name in JOINTS] == READY


def test_tip_goes_straight_or_as_near_as_it_gets(desk: Any) -> None:
    ui = desk.ui
    ui.choose("Goal state", "ready")
    ui.tab("Joints")
    before = ui.place_of(JOINTS)
    ui.drag("x", -0.7)
    ui.eventually(lambda: ui.place_of(JOINTS) != before)
    wanted = ui.place_of(JOINTS)
    ui.tab("Planning")
    ui.check("Use Cartesian Path")
    ui.press("Plan")
    ui.says("Planned 100.0 % of the Cartesian path: SUCCESS (1)")
    assert not desk.requests, "no planner is asked"
    ui.press("Execute")
    ui.says("Executed: SUCCESS (1)")
    assert [desk.positions[name] for name in JOINTS] == pytest.approx(wanted, abs=5e-3)

    # Out of reach: why, and the ghost stays; approximate solutions follow on request.
    ui.tab("Joints")
    ui.page.evaluate("gazelle.look({distance: 8})")
    ui.drag("x", -12)
    words = ui.says("NO_IK_SOLUTION (-31)", "Inverse kinematics")
    assert "tool_link" in words and "out of reach" in words
    ui.rviz.seen.shot("out of reach")
    stayed = ui.place_of(JOINTS)
    ui.tab("Planning")
    ui.check("Approx IK Solutions")
    ui.drag("x", -1)
    ui.says("approximate: NO_IK_SOLUTION (-31)", "Inverse kinematics")
    ui.tab("Joints")
    assert _reach(desk, ui.place_of(JOINTS)) > _reach(desk, stayed) + 0.1
    ui.rviz.seen.shot("approximate")


def test_move_group_of_ros_1(open_desk: Callable[..., Any]) -> None:
    desk = open_desk(ros_version=1, theme="light")
    ui = desk.ui
    ui.choose("Goal state", "up")
    ui.choose("Planner", "ompl/RRTConnect")
    ui.press("Plan")
    ui.says("Planned: SUCCESS (1)")
    assert desk.requests[-1].planner_id == "RRTConnect"
    ui.press("Execute")
    ui.says("Executed: SUCCESS (1)")
    assert [desk.positions[name] for name in JOINTS] == pytest.approx(_UP, abs=1e-6)
    ui.tab("Scene Objects")
    ui.add_solid("Box", x=0.3, y=0.3, z=0.3)
    ui.place_object(x=0.3, z=0.4)
    ui.eventually(lambda: desk.objects()["Box"].pose.position.z == 0.4)
    ui.tab("Planning")
    ui.choose("Goal state", "ready")
    assert "collides with Box" in ui.says("Goal: ", "Collisions")
    ui.press("Plan")
    assert "'Box'" in ui.says("GOAL_IN_COLLISION (-12)")
    ui.rviz.seen.shot("light")


def test_page_waits_for_a_move_group_and_tells_when_it_ends(
    bench: Any, look: Any, open_desk: Callable[..., Any]
) -> None:
    seen = look(bench.url, "motion_planning", size=(1000, 800))
    panel = seen.panel("motion_planning")
    line = panel.get_by_role("status", name="Result")
    line.filter(has_text="no move_group is running on this graph").wait_for()
    assert "ros2 launch PACKAGE move_group.launch.py" in line.inner_text()
    assert "roslaunch PACKAGE move_group.launch" in line.inner_text()
    assert panel.get_by_role("button", name="Plan", exact=True).is_disabled()
    seen.shot("nobody")
    # Without a view the panel offers one; the display comes by itself.
    panel.get_by_role("button", name="Open RViz").click()
    seen.panel("rviz").wait_for()
    panel.get_by_role("button", name="Open RViz").wait_for(state="hidden")
    desk = open_desk()
    group = panel.get_by_label("Planning group")
    bench.eventually(lambda: seen.page.wait_for_timeout(50) or group.input_value() == "arm")
    assert panel.get_by_role("button", name="Plan", exact=True).is_enabled()
    displays = seen.page.evaluate("gazelle.scene('rviz').displays")
    assert "MotionPlanning" in displays
    desk.arm.bench.stop()
    line.filter(has_text="no move_group is running on this graph").wait_for()
    assert panel.get_by_role("button", name="Plan", exact=True).is_disabled()


def _reach(desk: Any, positions: list[float]) -> float:
    state = {"joint_state": {"name": JOINTS, "position": positions}, "is_diff": True}
    answer = desk.arm.call(
        "compute_fk", "GetPositionFK", fk_link_names=["tool_link"], robot_state=state
    )
    return float(answer.pose_stamped[0].pose.position.x)
