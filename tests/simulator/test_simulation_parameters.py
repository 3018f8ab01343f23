"""Parameters that a program gives reach the ROS 1 store, or ROS 2's controllers."""

from __future__ import annotations

import pytest

from gazelle.errors import GazelleError
from gazelle.simulator.intra_process_node import LocalParameters
from gazelle.simulator.simulation_parameters import give_parameters
from gazelle.simulator.world_controller_managers import ControlRegistry


def _given(*parameters):
    store, controls = LocalParameters(), ControlRegistry()
    give_parameters(parameters[0] if len(parameters) == 1 else parameters, store, controls)
    return store, controls


def test_a_mapping_goes_into_the_store_by_global_names():
    store, _ = _given({"mira": {"roll": {"p": 1.0}}, "/use_sim_time": True})
    assert store.get("/mira/roll/p") == 1.0
    assert store.get("/use_sim_time") is True


def test_a_file_is_read_as_rosparam_load_does(tmp_path):
    file = tmp_path / "control.yaml"
    file.write_text("mira:\n  roll: {p: 2.0}\n")
    store, controls = _given(file, {"other": 1})
    assert (store.get("/mira/roll/p"), store.get("/other")) == (2.0, 1)
    assert not controls.files


def test_a_file_can_be_put_below_a_name(tmp_path):
    file = tmp_path / "joints.yaml"
    file.write_text("type: a/B\npublish_rate: 50\n")
    store, _ = _given({"base/joints": file})
    assert store.get("/base/joints/publish_rate") == 50


def test_ros2_files_and_mappings_are_kept_for_controllers(tmp_path):
    file = tmp_path / "controllers.yaml"
    file.write_text("controller_manager:\n  ros__parameters: {update_rate: 50}\n")
    own = {"/robot/arm": {"ros__parameters": {"joints": ["a"]}}, "plain": 3}
    store, controls = _given(str(file), own)
    assert controls.files == [file]
    assert controls.overrides == {"arm": {"joints": ["a"]}}
    assert store.get("/plain") == 3


@pytest.mark.parametrize(
    ("text", "phrase"),
    [(None, "cannot be read"), ("a: [", "cannot be read"), ("- 1\n", "holds a list, not names")],
)
def test_a_bad_file_is_named(tmp_path, text, phrase):
    file = tmp_path / "bad.yaml"
    if text is not None:
        file.write_text(text)
    with pytest.raises(GazelleError, match=f"parameter file '{file}' {phrase}"):
        _given(file)
