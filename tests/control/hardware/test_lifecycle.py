"""Which interfaces of the hardware there are, and what that means for controllers."""

from __future__ import annotations

import pytest

from gazelle.control.errors import ControllerError
from gazelle.control.hardware.lifecycle import HardwareLifecycle, HardwareState, initial_states

OWNERS = {"a/position": "arm", "a/effort": "arm", "b/position": "hand"}
NAMES = ("arm", "hand", "torso")


def _labels(tree: dict[str, object]) -> dict[str, str | None]:
    return {
        name: None if state is None else state.label for name, state in initial_states(tree, NAMES)
    }


def test_everything_is_active_at_first() -> None:
    lifecycle = HardwareLifecycle(OWNERS)
    assert lifecycle.available(OWNERS) == tuple(OWNERS)
    assert lifecycle.refusal("c", ["a/position"], ["b/position"]) == ""
    assert (lifecycle.reads("arm"), lifecycle.writes("arm")) == (True, True)


def test_inactive_hardware_gives_states_and_takes_no_commands() -> None:
    lifecycle = HardwareLifecycle(OWNERS)
    lifecycle.set("arm", HardwareState.INACTIVE)
    assert (lifecycle.reads("arm"), lifecycle.writes("arm")) == (True, False)
    assert lifecycle.refusal("c", [], ["a/position"]) == ""
    assert "command interface 'a/effort' belongs to hardware 'arm', which is inactive" in (
        lifecycle.refusal("c", ["a/effort"], [])
    )
    lifecycle.takes_inactive = True
    assert lifecycle.refusal("c", ["a/effort"], []) == ""


def test_unconfigured_hardware_gives_nothing() -> None:
    lifecycle = HardwareLifecycle(OWNERS)
    lifecycle.set("arm", HardwareState.UNCONFIGURED)
    assert lifecycle.available(OWNERS) == ("b/position",)
    assert "state interface with 'a/position' is not available: hardware 'arm' is unconfigured" in (
        lifecycle.refusal("c", [], ["b/position", "a/position"])
    )


def test_finalized_hardware_stays_so() -> None:
    lifecycle = HardwareLifecycle(OWNERS)
    lifecycle.set("arm", HardwareState.FINALIZED)
    with pytest.raises(ControllerError, match="'arm' is in finalized state and can be only"):
        lifecycle.set("arm", HardwareState.ACTIVE)


def test_parameters_name_first_states() -> None:
    tree: dict[str, object] = {
        "hardware_components_initial_state": {"unconfigured": ["arm"], "inactive": ["hnad"]}
    }
    assert _labels(tree) == {
        "arm": "unconfigured", "hnad": None, "hand": "active", "torso": "active"
    }  # fmt: skip


def test_humble_s_first_names_count_where_the_new_one_is_not() -> None:
    old: dict[str, object] = {
        "configure_components_on_start": ["arm"], "activate_components_on_start": ["hand"]
    }  # fmt: skip
    assert _labels(old) == {"arm": "inactive", "hand": "active", "torso": "unconfigured"}
    assert _labels({"configure_components_on_start": ["arm"]}) == {
        "arm": "inactive", "hand": "active", "torso": "active"
    }  # fmt: skip
    new = {"hardware_components_initial_state": {"inactive": ["hand"]}}
    assert _labels({**old, **new}) == {"hand": "inactive", "arm": "active", "torso": "active"}
