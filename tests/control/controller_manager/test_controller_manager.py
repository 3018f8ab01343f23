"""Life of controllers: loaded, started, updated, stopped, unloaded."""

from __future__ import annotations

import pytest

from gazelle.control.errors import ControllerError

MS = 1_000_000
LEFT = {"joint": "left"}
RIGHT = {"joint": "right"}


def test_ros1_controllers_are_initialized_then_run_then_stopped(make_bench):
    bench = make_bench(1, {"a": LEFT})
    manager = bench.manager
    record = manager.load("a")
    assert (record.ros1_word, record.commands) == ("initialized", ("left/effort",))
    manager.switch(start=["a"])
    assert record.ros1_word == "running"
    manager.switch(stop=["a"])
    assert record.ros1_word == "stopped"
    manager.unload("a")
    assert not manager.controllers
    assert bench.ports["a"].closed


def test_ros2_controllers_read_their_parameters_when_configured(make_bench):
    bench = make_bench(2, {"a": {}})
    manager = bench.manager
    record = manager.load("a")
    assert (record.state, record.controller) == ("unconfigured", None)
    with pytest.raises(ControllerError, match="parameter /mira/a/joint"):
        manager.configure("a")
    assert record.state == "unconfigured"
    assert bench.ports["a"].closed
    bench.store.set("/mira/a/joint", "left")
    manager.configure("a")
    assert record.state == "inactive"
    manager.cleanup("a")
    assert (record.state, record.controller) == ("unconfigured", None)


def test_update_reads_runs_controllers_in_the_order_loaded_and_writes(make_bench):
    bench = make_bench(1, {"a": LEFT, "b": RIGHT})
    manager = bench.manager
    manager.load("b")
    manager.load("a")
    manager.switch(start=["a"])
    manager.switch(start=["b"])
    order = []
    for name in ("a", "b"):
        bench.controller(name).update = lambda t, p, name=name: order.append(name)
    bench.hardware.log.clear()
    manager.update(5 * MS, MS)
    assert order == ["b", "a"]
    assert bench.hardware.log == [("read", 5 * MS), ("write", 5 * MS)]


def test_only_active_controllers_are_updated_with_time_and_period(make_bench):
    bench = make_bench(1, {"a": LEFT, "b": RIGHT})
    manager = bench.manager
    manager.load("a")
    manager.load("b")
    manager.switch(start=["a"])
    manager.update(MS, MS)
    assert bench.controller("a").calls == [("start", 0), ("update", MS, MS)]
    assert bench.controller("b").calls == []


def test_start_hears_the_time_of_now_while_the_loop_stands(make_bench):
    bench = make_bench(1, {"a": LEFT}, clock=lambda: 7 * MS)
    bench.manager.load("a")
    bench.manager.switch(start=["a"])
    assert bench.controller("a").calls == [("start", 7 * MS)]
    assert ("read", 7 * MS) in bench.hardware.log


def test_a_switch_tells_the_hardware_then_stops_then_starts(make_bench):
    bench = make_bench(1, {"a": LEFT, "b": LEFT})
    manager = bench.manager
    manager.load("a")
    manager.load("b")
    claimed = frozenset({"left/effort"})
    manager.switch(start=["a"])
    assert bench.hardware.log[0] == ("switch", claimed, frozenset())
    bench.hardware.log.clear()
    manager.switch(start=["b"], stop=["a"])
    assert bench.hardware.log[0] == ("switch", claimed, claimed)
    assert bench.words("a") == ["start", "stop"]
    assert bench.words("b") == ["start"]


def test_a_controller_that_is_started_and_stopped_is_restarted(make_bench):
    bench = make_bench(1, {"a": LEFT})
    bench.manager.load("a")
    bench.manager.switch(start=["a"])
    bench.manager.switch(start=["a"], stop=["a"])
    assert bench.words("a") == ["start", "stop", "start"]


def test_a_controller_that_raises_is_stopped_and_the_others_go_on(make_bench):
    bench = make_bench(1, {"a": {**LEFT, "fails_in": "update"}, "b": RIGHT})
    manager = bench.manager
    manager.load("a")
    manager.load("b")
    manager.switch(start=["a", "b"])
    manager.update(MS, MS)
    manager.update(2 * MS, MS)
    assert bench.words("a") == ["start", "update", "stop"]
    assert bench.words("b") == ["start", "update", "update"]
    (found,) = bench.diagnostics.by_code("control.controller-failed")
    assert "controller 'a'" in found.message
    assert "ValueError: broken on purpose" in found.message
    assert ("switch", frozenset(), frozenset({"left/effort"})) in bench.hardware.log
    assert bench.ports["a"].lines[0][0] == "error"


def test_a_controller_that_fails_to_start_releases_its_interfaces(make_bench):
    bench = make_bench(2, {"a": {**LEFT, "fails_in": "start"}, "b": RIGHT})
    manager = bench.manager
    for name in ("a", "b"):
        manager.load(name)
        manager.configure(name)
    with pytest.raises(ControllerError, match=r"Unable to activate controllers: \[ a \]"):
        manager.switch(start=["a", "b"])
    assert manager.controllers["a"].state == "inactive"
    assert manager.controllers["b"].state == "active"
    assert bench.hardware.log[-1] == ("switch", frozenset(), frozenset({"left/effort"}))


def test_a_slower_controller_is_updated_at_its_own_rate(make_bench):
    bench = make_bench(2, {"a": {**LEFT, "update_rate": 100}}, rate_hz=1000.0)
    manager = bench.manager
    manager.load("a")
    manager.configure("a")
    manager.switch(start=["a"])
    for tick in range(1, 31):
        manager.update(tick * MS, MS)
    updates = [call for call in bench.controller("a").calls if call[0] == "update"]
    assert updates == [("update", t * 10 * MS, 10 * MS) for t in (1, 2, 3)]


def test_wishes_about_rate_and_thread_that_cannot_be_met_are_reported(make_bench):
    bench = make_bench(2, {"a": {**LEFT, "update_rate": 500, "is_async": True}}, rate_hz=100.0)
    record = bench.manager.load("a")
    assert record.update_rate_hz == 100.0
    texts = [item.message for item in bench.diagnostics.by_code("control.update-rate")]
    assert any("less than or equal to controller manager's update rate" in text for text in texts)
    assert any("'/mira/a/is_async' has no effect" in text for text in texts)


def test_unknown_parameters_are_reported_when_a_controller_is_made(make_bench):
    bench = make_bench(1, {"a": {**LEFT, "gian": 2.0}})
    bench.manager.load("a")
    (found,) = bench.diagnostics.by_code("parameter.unknown")
    assert "'/mira/a/gian'" in found.message
    assert "gain" in found.fix


def test_live_parameters_reach_the_controller_and_others_are_refused(make_bench):
    bench = make_bench(2, {"a": LEFT})
    bench.manager.load("a")
    bench.manager.configure("a")
    ports = bench.ports["a"]
    assert ports.values["joint"] == "left"
    assert ports.on_set({"gain": 3.0}) == ""
    assert bench.controller("a").gain == 3.0
    assert ports.on_set({"gain": -1.0}) == "gain must not be negative"
    assert "'joint' cannot be changed" in ports.on_set({"joint": "right"})


def test_reset_restarts_what_runs_with_the_new_time(make_bench):
    now = [5 * MS]
    bench = make_bench(1, {"a": LEFT, "b": RIGHT}, clock=lambda: now[0])
    manager = bench.manager
    manager.load("a")
    manager.load("b")
    manager.switch(start=["a"])
    manager.update(5 * MS, MS)
    now[0] = 0
    manager.reset()
    assert bench.controller("a").calls[-2:] == [("stop", 0), ("start", 0)]
    assert bench.controller("b").calls == []
    assert bench.hardware.log[-1] == ("read", 0)


def test_close_stops_and_closes_everything_once(make_bench):
    bench = make_bench(1, {"a": LEFT})
    manager = bench.manager
    manager.load("a")
    manager.switch(start=["a"])
    controller = bench.controller("a")
    manager.close()
    manager.close()
    assert [call[0] for call in controller.calls] == ["start", "stop", "close"]
    assert bench.ports["a"].closed


def test_unload_all_wants_force_while_anything_is_loaded(make_bench):
    bench = make_bench(1, {"a": LEFT})
    bench.manager.load("a")
    bench.manager.switch(start=["a"])
    with pytest.raises(ControllerError, match="there are still 1 controllers running"):
        bench.manager.unload_all(force=False)
    bench.manager.unload_all(force=True)
    assert not bench.manager.controllers


@pytest.mark.parametrize(
    ("ros_version", "phrase"),
    [
        (
            1,
            r"Could not load controller 'rool' because the type was not specified. Did you load "
            r"the controller configuration on the parameter server \(namespace: '/mira/rool'\)\? "
            r"did you mean .*roll",
        ),
        (2, r"The 'type' param was not defined for 'rool'; did you mean .*roll"),
    ],
)
def test_a_controller_without_type_names_the_nearest(make_bench, ros_version, phrase):
    bench = make_bench(ros_version, {"roll": LEFT})
    with pytest.raises(ControllerError, match=phrase):
        bench.manager.load("rool")


@pytest.mark.parametrize(
    ("ros_version", "phrase"),
    [
        (1, r"Could not load class 'test_controllers/Recoder': Could not load controller 'a'"),
        (2, r"Loader for controller 'a' \(type 'test_controllers/Recoder'\) not found"),
    ],
)
def test_an_unknown_type_names_the_nearest(make_bench, ros_version, phrase):
    bench = make_bench(ros_version, {"a": LEFT})
    with pytest.raises(ControllerError, match=phrase + ".*test_controllers/Recorder"):
        bench.manager.load("a", "test_controllers/Recoder")


def test_a_controller_is_loaded_once(make_bench):
    bench = make_bench(1, {"a": LEFT})
    bench.manager.load("a")
    with pytest.raises(ControllerError, match="A controller named 'a' was already loaded inside"):
        bench.manager.load("a")


def test_what_runs_cannot_be_unloaded_configured_or_cleaned(make_bench):
    bench = make_bench(2, {"a": LEFT})
    manager = bench.manager
    manager.load("a")
    manager.configure("a")
    manager.switch(start=["a"])
    with pytest.raises(ControllerError, match="'a' because it is still active"):
        manager.unload("a")
    with pytest.raises(ControllerError, match="can not be configured from 'active' state"):
        manager.configure("a")
    with pytest.raises(ControllerError, match="can not be cleaned-up from 'active' state"):
        manager.cleanup("a")


def test_unloading_what_is_not_loaded_names_what_is(make_bench):
    bench = make_bench(1, {"roll": LEFT})
    bench.manager.load("roll")
    with pytest.raises(ControllerError, match="no controller with this name exists; did you mean"):
        bench.manager.unload("rolll")


def test_a_broken_parameter_closes_the_ports_again(make_bench):
    bench = make_bench(1, {"a": {"joint": "lfet"}})
    with pytest.raises(ControllerError, match=r"no joint or sensor 'lfet'; did you mean .*left"):
        bench.manager.load("a")
    assert bench.ports["a"].closed
    assert not bench.manager.controllers
