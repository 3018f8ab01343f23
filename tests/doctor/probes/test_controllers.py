"""Controllers at their start."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import Any

from tests.doctor.probes.worlds import arm, probed

from gazelle.description.model import JointType, World
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity
from gazelle.doctor.probes.controllers import probe_controllers
from gazelle.simulator.simulation import Simulation

POSITION = "effort_controllers/JointPositionController"


def _started(
    p: float, d: float, *, kind: str = POSITION, joint: str = "hinge", effort: float = 50.0
) -> tuple[tuple[tuple[str, ...], ...], list[Diagnostic]]:
    servo = {"type": kind, "joint": joint, "pid": {"p": p, "i": 0.0, "d": d}}
    plain = {"type": "effort_controllers/JointEffortController", "joint": "hinge"}
    parameters: dict[str, Any] = {"arm": {"servo": servo, "second": plain}}
    found = Diagnostics()
    model = arm(effort)
    with Simulation(World(models=(model,)), parameters=parameters) as simulation:
        section = probe_controllers(simulation, (model,), found)
    return section.rows, list(found)


def test_stiff_servo_holds_the_lever_and_keeps_the_joint_for_itself() -> None:
    rows, found = _started(2000.0, 80.0)
    assert found == []
    servo, second = rows
    assert servo == ("/arm/servo", POSITION, "running", "hinge: 0.00245 rad", "good")
    assert second[2] == "in use by another"


def test_weak_servo_sags_by_weight_over_gain() -> None:
    rows, (item,) = _started(20.0, 3.0)
    assert item.code == "probe.controller-sags"
    # p · angle = m g l: 4.9 N·m / 20 N·m/rad
    assert "joint 'hinge' moves by 0.256 rad in the first second" in item.message
    assert "controller '/arm/servo', which is to hold it" in item.message
    assert item.fix.startswith("raise p (and i) of its gains")
    assert rows[0][4] == "sags"


def test_gains_without_damping_shake_the_joint() -> None:
    rows, (item,) = _started(2e4, 0.0)
    assert item.code == "probe.controller-shakes"
    assert "joint 'hinge' shakes under controller '/arm/servo'" in item.message
    assert item.fix == "lower p or raise d, or give the joint a damping"
    assert rows[0][4] == "shakes"


def test_controller_of_a_joint_that_is_not_there_is_told_with_the_nearest() -> None:
    rows, (item,) = _started(1.0, 0.0, joint="hnge")
    assert item.code == "probe.controller-start"
    assert item.message.startswith(f"controller '/arm/servo' ({POSITION}) cannot be started: ")
    assert "no joint or sensor 'hnge'; did you mean 'hinge'?" in item.message
    assert rows[0][2] == "failed"


def test_plain_efforts_are_not_expected_to_hold() -> None:
    rows, found = _started(1.0, 0.0, joint="hnge")
    name, _, state, motion, verdict = rows[1]
    assert (name, state, verdict) == ("/arm/second", "running", "good")
    assert motion.startswith("hinge: 2")  # it hangs on its limit
    assert [item.code for item in found] == ["probe.controller-start"]


def test_divergence_names_the_link_and_its_line() -> None:
    servo = {"type": POSITION, "joint": "hinge", "pid": {"p": 1e25, "i": 0.0, "d": 0.0}}
    model = arm(1e30)
    (hinge,) = model.joints
    assert hinge.axis is not None
    # No speed and no stop ends the efforts on it.
    free = replace(hinge.axis, xyz=(0.0, 0.0, 1.0), velocity=inf, lower=-inf, upper=inf)
    slide = replace(hinge, type=JointType.PRISMATIC, axis=free)
    _, found = probed(replace(model, joints=(slide,)), parameters={"arm": {"servo": servo}})
    (item,) = found
    assert (item.code, item.severity) == ("probe.diverged", Severity.ERROR)
    assert "link 'arm::lever'" in item.message
    assert "moves beyond all bounds at 'arm::hinge'" in item.message
    assert item.span is not None
    assert item.span.line == 4
