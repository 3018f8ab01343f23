"""A switch is decided before anything changes."""

from __future__ import annotations

import pytest

from gazelle.control.errors import ControllerError

LEFT = {"joint": "left"}


def _loaded(make_bench, ros_version, controllers):
    bench = make_bench(ros_version, controllers)
    for name in controllers:
        bench.manager.load(name)
        bench.manager.configure(name)
    return bench


def test_ros1_gives_a_joint_to_one_controller_whatever_the_interface(make_bench):
    bench = _loaded(make_bench, 1, {"a": LEFT, "b": {**LEFT, "interface": "position"}})
    bench.manager.switch(start=["a"])
    with pytest.raises(
        ControllerError, match=r"Resource conflict on \[left\].  Controllers = \[a, b\]"
    ):
        bench.manager.switch(start=["b"])
    assert bench.words("a") == ["start"]
    assert bench.words("b") == []


def test_ros1_conflicts_fail_a_best_effort_switch_too(make_bench):
    bench = _loaded(make_bench, 1, {"a": LEFT, "b": LEFT})
    with pytest.raises(ControllerError, match="due to resource conflict"):
        bench.manager.switch(start=["a", "b"], strict=False)


def test_ros2_gives_an_interface_to_one_controller(make_bench):
    bench = _loaded(make_bench, 2, {"a": LEFT, "b": {**LEFT, "interface": "position"}, "c": LEFT})
    bench.manager.switch(start=["a", "b"])
    with pytest.raises(
        ControllerError,
        match=r"Resource conflict for controller 'c'. Command interface 'left/effort' is already "
        r"claimed by 'a'",
    ):
        bench.manager.switch(start=["c"])


def test_ros2_best_effort_leaves_out_the_controller_in_conflict(make_bench):
    bench = _loaded(make_bench, 2, {"a": LEFT, "b": LEFT, "c": {"joint": "right"}})
    notes = bench.manager.switch(start=["a", "b", "c"], strict=False)
    assert [one.name for one in bench.manager.controllers.values() if one.is_active] == ["a", "c"]
    assert len(notes) == 1
    assert "controller 'b'" in notes[0]


def test_an_interface_is_free_when_its_owner_stops_in_the_same_switch(make_bench):
    bench = _loaded(make_bench, 1, {"a": LEFT, "b": LEFT})
    bench.manager.switch(start=["a"])
    bench.manager.switch(start=["b"], stop=["a"])
    assert bench.manager.controllers["b"].is_active


@pytest.mark.parametrize(
    ("ros_version", "start", "stop", "phrase"),
    [
        (1, ["x"], [], "Could not start controller with name 'x' because no controller with this"),
        (1, [], ["x"], "Could not stop controller with name 'x' because no controller with this"),
        (1, [], ["a"], "Could not stop controller 'a' since it is not running"),
        (2, ["x"], [], "Could not activate controller with name 'x' because no controller with"),
        (2, [], ["a"], "Could not deactivate controller 'a' since it is not active"),
    ],
)
def test_a_strict_switch_names_what_is_wrong_and_best_effort_goes_on(
    make_bench, ros_version, start, stop, phrase
):
    bench = _loaded(make_bench, ros_version, {"a": LEFT, "b": {"joint": "right"}})
    with pytest.raises(ControllerError, match=phrase):
        bench.manager.switch([*start, "b"], stop)
    assert not bench.manager.controllers["b"].is_active
    (note,) = bench.manager.switch([*start, "b"], stop, strict=False)
    assert phrase in note
    assert bench.manager.controllers["b"].is_active


def test_a_running_controller_is_not_started_again(make_bench):
    bench = _loaded(make_bench, 1, {"a": LEFT})
    bench.manager.switch(start=["a"])
    with pytest.raises(ControllerError, match="Controller 'a' is already running"):
        bench.manager.switch(start=["a"])


def test_an_unconfigured_controller_cannot_be_activated(make_bench):
    bench = make_bench(2, {"a": LEFT})
    bench.manager.load("a")
    with pytest.raises(ControllerError, match="unconfigured, not inactive; configure it first"):
        bench.manager.switch(start=["a"])


@pytest.mark.parametrize(
    ("ros_version", "phrase"),
    [(1, "combination for the requested controllers is unfeasible"), (2, "mode switch was reject")],
)
def test_the_hardware_can_refuse_a_switch(make_bench, ros_version, phrase):
    bench = _loaded(make_bench, ros_version, {"a": LEFT})
    bench.hardware.refusal = "left can do one thing at a time"
    with pytest.raises(ControllerError, match=f"{phrase}.*one thing at a time"):
        bench.manager.switch(start=["a"])
    assert not bench.manager.controllers["a"].is_active
