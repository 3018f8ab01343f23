"""Namespaces of the ROS 1 store as controllers' parameters."""

from __future__ import annotations

from gazelle.control.parameter_sources.ros1_parameter_server import StoreSource
from gazelle.simulator.intra_process_node import LocalParameters


def _store() -> LocalParameters:
    store = LocalParameters()
    store.set(
        "/mira",
        {
            "roll_controller": {"type": "effort_controllers/JointPositionController", "p": 1.0},
            "arm": {"grip": {"type": "a/B"}},
            "robot_description": "<robot/>",
        },
    )
    return store


def test_controllers_are_the_namespaces_with_a_type() -> None:
    source = StoreSource(_store(), "/mira")
    assert source.controllers() == ("roll_controller", "arm/grip")
    assert source.controller_type("roll_controller") == "effort_controllers/JointPositionController"
    assert source.controller_type("nobody") is None
    assert source.tree("roll_controller")["p"] == 1.0


def test_root_manager_leaves_the_namespaces_of_others_alone() -> None:
    assert StoreSource(_store(), "/").controllers() == ()


def test_full_names_and_setting() -> None:
    store = _store()
    source = StoreSource(store, "mira")
    assert source.full_name("roll_controller", "pid.p") == "/mira/roll_controller/pid/p"
    source.set("roll_controller", "pid.p", 3.0)
    assert store.get("/mira/roll_controller/pid/p") == 3.0
    assert source.tree("roll_controller")["pid"] == {"p": 3.0}


def test_ros2_layout_in_the_store_is_looked_through() -> None:
    store = LocalParameters()
    store.set("/ctrl", {"ros__parameters": {"type": "a/B", "joints": ["j"]}})
    source = StoreSource(store, "")
    assert source.controllers() == ("ctrl",)
    assert source.tree("ctrl")["joints"] == ["j"]
