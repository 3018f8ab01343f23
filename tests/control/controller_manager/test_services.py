"""The services answer with the messages of their generation."""

from __future__ import annotations

import pytest

from gazelle.control.controller_manager.services import offer_ros1, offer_ros2
from gazelle.interfaces import ros1_service_type, service_type

LEFT = {"joint": "left"}
RIGHT = {"joint": "right"}


def _ros1(bench, ports):
    def call(service, **fields):
        kind = ros1_service_type(ports.types[f"~/{service}"])
        response = kind._response_class()
        ports.services[f"~/{service}"](kind._request_class(**fields), response)
        return response

    return call


def _ros2(bench, ports):
    def call(service, **fields):
        kind = service_type(ports.types[f"~/{service}"])
        response = kind.Response()
        request = kind.Request()
        for key, value in fields.items():
            setattr(request, key, value)
        ports.services[f"~/{service}"](request, response)
        return response

    return call


@pytest.fixture
def ros1(make_bench):
    bench = make_bench(1, {"a": LEFT, "b": LEFT})
    ports = bench.manager._maker._make_ports("controller_manager")
    offer_ros1(bench.manager, ports)
    return bench, ports, _ros1(bench, ports)


@pytest.fixture
def ros2(make_bench):
    bench = make_bench(2, {"a": LEFT, "b": RIGHT, "c": LEFT})
    ports = bench.manager._maker._make_ports("controller_manager")
    offer_ros2(bench.manager, ports)
    return bench, ports, _ros2(bench, ports)


def test_ros1_offers_its_six_services(ros1):
    _, ports, _ = ros1
    assert set(ports.types.values()) == {
        f"controller_manager_msgs/{name}"
        for name in (
            "ListControllers",
            "ListControllerTypes",
            "LoadController",
            "UnloadController",
            "SwitchController",
            "ReloadControllerLibraries",
        )
    }


def test_ros1_life_of_a_controller_over_services(ros1):
    _, _, call = ros1
    assert call("load_controller", name="a").ok
    (state,) = call("list_controllers").controller
    assert (state.name, state.state, state.type) == (
        "a",
        "initialized",
        "test_controllers/Recorder",
    )
    (claimed,) = state.claimed_resources
    assert claimed.hardware_interface == "hardware_interface::EffortJointInterface"
    assert claimed.resources == ["left"]
    assert call("switch_controller", start_controllers=["a"], strictness=2).ok
    assert call("list_controllers").controller[0].state == "running"
    assert not call("unload_controller", name="a").ok
    assert call("switch_controller", stop_controllers=["a"], strictness=2).ok
    assert call("unload_controller", name="a").ok
    assert call("list_controllers").controller == []


def test_ros1_failures_are_logged_with_their_reason(ros1):
    _, ports, call = ros1
    assert not call("load_controller", name="x").ok
    assert ports.lines[-1][0] == "error"
    assert "Did you load the controller configuration on the parameter server" in ports.lines[-1][1]
    call("load_controller", name="a")
    call("load_controller", name="b")
    assert not call("switch_controller", start_controllers=["a", "b"], strictness=2).ok
    assert "Resource conflict on [left].  Controllers = [a, b]" in ports.lines[-1][1]


def test_ros1_switch_without_strictness_does_what_it_can_and_says_so(ros1):
    _, ports, call = ros1
    call("load_controller", name="a")
    assert call("switch_controller", start_controllers=["a", "x"]).ok
    assert "Defaulting to ::BEST_EFFORT" in ports.lines[0][1]


def test_ros1_lists_types_with_their_base_class(ros1):
    _, _, call = ros1
    answer = call("list_controller_types")
    assert answer.types == ["test_controllers/Recorder"]
    assert answer.base_classes == ["controller_interface::ControllerBase"]


def test_ros1_reload_unloads_only_with_force(ros1):
    bench, _, call = ros1
    call("load_controller", name="a")
    assert not call("reload_controller_libraries", force_kill=False).ok
    assert call("reload_controller_libraries", force_kill=True).ok
    assert not bench.manager.controllers


def test_findings_about_parameters_are_logged_when_a_service_loads(ros1):
    bench, ports, call = ros1
    bench.store.set("/mira/a/gian", 3)
    call("load_controller", name="a")
    assert any("'/mira/a/gian' is not one of this controller" in text for _, text in ports.lines)


def test_ros2_life_of_a_controller_over_services(ros2):
    _, ports, call = ros2
    assert call("load_controller", name="a").ok
    assert call("list_controllers").controller[0].state == "unconfigured"
    assert call("configure_controller", name="a").ok
    answer = call("switch_controller", activate_controllers=["a"], strictness=2)
    assert (answer.ok, answer.message) == (True, "Successfully switched controllers!")
    state = call("list_controllers").controller[0]
    assert (state.state, state.claimed_interfaces) == ("active", ["left/effort"])
    assert state.required_state_interfaces == ["left/position"]
    assert call("switch_controller", deactivate_controllers=["a"], strictness=2).ok
    assert call("cleanup_controller", name="a").ok
    assert call("unload_controller", name="a").ok
    assert ("info", "Loading controller 'a'") in ports.lines


def test_ros2_switch_answers_with_the_reason(ros2):
    _, _, call = ros2
    for name in ("a", "c"):
        call("load_controller", name=name)
        call("configure_controller", name=name)
    answer = call("switch_controller", activate_controllers=["a", "c"], strictness=2)
    assert not answer.ok
    assert "'left/effort' is already claimed by 'a'" in answer.message


def test_ros2_lists_hardware_with_what_is_claimed(ros2):
    _, _, call = ros2
    call("load_controller", name="a")
    call("configure_controller", name="a")
    call("switch_controller", activate_controllers=["a"], strictness=2)
    answer = call("list_hardware_interfaces")
    claimed = {one.name for one in answer.command_interfaces if one.is_claimed}
    assert claimed == {"left/effort"}
    assert len(answer.state_interfaces) == 6
    (component,) = call("list_hardware_components").component
    assert (component.name, component.type, component.plugin_name) == (
        "block", "system", "test/Hardware")  # fmt: skip
    assert (component.state.id, component.state.label) == (3, "active")
    assert len(component.command_interfaces) == 6


def _state(number, label):
    state = service_type("controller_manager_msgs/SetHardwareComponentState").Request().target_state
    state.id, state.label = number, label
    return state


def test_ros2_hardware_is_read_but_not_written_while_inactive(ros2):
    bench, _, call = ros2
    answer = call("set_hardware_component_state", name="block", target_state=_state(2, ""))
    assert (answer.ok, answer.state.id, answer.state.label) == (True, 2, "inactive")
    bench.manager.update(1_000_000, 1_000_000)
    assert bench.hardware.log == [("read", 1_000_000)]
    assert call("set_hardware_component_state", name="block", target_state=_state(0, "active")).ok
    bench.hardware.log.clear()
    bench.manager.update(2_000_000, 1_000_000)
    assert [word for word, _ in bench.hardware.log] == ["read", "write"]


def test_ros2_hardware_that_is_unconfigured_has_no_interfaces(ros2):
    bench, ports, call = ros2
    robot = bench.manager.robot
    names = (*robot.interface_values.command_index, *robot.interface_values.state_index)
    robot.lifecycle.owners = dict.fromkeys(names, "block")
    call("load_controller", name="a")
    call("configure_controller", name="a")
    call("set_hardware_component_state", name="block", target_state=_state(1, "unconfigured"))
    (component,) = call("list_hardware_components").component
    assert component.state.label == "unconfigured"
    assert not any(one.is_available for one in component.command_interfaces)
    answer = call("switch_controller", activate_controllers=["a"], strictness=2)
    assert not answer.ok
    assert (
        "command interface with 'left/effort' is not available: hardware 'block' is unconfigured"
        in answer.message
    )
    call("set_hardware_component_state", name="block", target_state=_state(3, "active"))
    assert call("switch_controller", activate_controllers=["a"], strictness=2).ok
    call("set_hardware_component_state", name="block", target_state=_state(2, "inactive"))
    assert any("no longer active while controllers command it: a" in text
               for level, text in ports.lines if level == "warn")  # fmt: skip


def test_ros2_wrong_hardware_and_states_are_named(ros2):
    _, ports, call = ros2
    assert not call("set_hardware_component_state", name="blok", target_state=_state(2, "")).ok
    assert "'blok' does not exist; did you mean 'block'" in ports.lines[-1][1]
    answer = call("set_hardware_component_state", name="block", target_state=_state(0, "activ"))
    assert (answer.ok, answer.state.label) == (False, "active")
    assert "no state 'activ'; there are: unconfigured, inactive, active" in ports.lines[-1][1]


def test_ros2_types_set_as_parameters_count_when_loading(ros2):
    bench, ports, _ = ros2
    assert ports.values["update_rate"] == 1000
    assert ports.on_set({"d.type": "test_controllers/Recorder"}) == ""
    assert bench.store.get("/mira/controller_manager/d/type") == "test_controllers/Recorder"
    assert "cannot be changed" in ports.on_set({"update_rate": 5})
