from __future__ import annotations

import numpy as np
import pytest

from gazelle.control.hardware.control_description import read_description
from gazelle.control.transmissions import Transmission
from gazelle.control.transmissions.transmission import read_transmission
from gazelle.diagnostics import Diagnostics

ROBOT = """<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<joint name="j1" type="continuous"><parent link="a"/><child link="b"/></joint>
<joint name="j2" type="continuous"><parent link="a"/><child link="c"/></joint>{}</robot>"""


def read(transmission: str) -> tuple[Transmission | None, Diagnostics]:
    description = read_description(ROBOT.format(transmission))
    assert description is not None
    diagnostics = Diagnostics()
    return read_transmission(description.transmissions[0], diagnostics), diagnostics


def pair(kind: str, swapped: bool = False, roles: bool = True, reduction: str = "10") -> str:
    parts = [
        f'<{part} name="{name}{number}">'
        + (f"<role>{part}{number}</role>" if roles else "")
        + f"<mechanicalReduction>{amount}</mechanicalReduction></{part}>"
        for part, name, amounts in (("actuator", "m", (reduction, 20)), ("joint", "j", (2, 4)))
        for number, amount in zip((1, 2), amounts, strict=True)
    ]
    order = [1, 0, 3, 2] if swapped else [0, 1, 2, 3]
    body = "".join(parts[index] for index in order)
    return f'<transmission name="t"><type>transmission_interface/{kind}</type>{body}</transmission>'


def test_simple_transmission_has_the_actuators_reduction_and_the_joints_offset() -> None:
    gear, diagnostics = read(
        '<transmission name="t"><type>transmission_interface/SimpleTransmission</type>'
        '<joint name="j1"><offset>0.5</offset></joint>'
        '<actuator name="m"><mechanicalReduction>50</mechanicalReduction></actuator></transmission>'
    )
    assert gear is not None
    assert gear.joint_positions(np.array([100.0])) == pytest.approx([2.5])
    assert not diagnostics


def test_transmission_of_the_pr2_has_its_reduction_beside_joint_and_actuator() -> None:
    gear, diagnostics = read(
        '<transmission name="t" type="SimpleTransmission"><actuator name="m"/><joint name="j1"/>'
        "<mechanicalReduction>8</mechanicalReduction></transmission>"
    )
    assert gear is not None
    assert gear.joint_velocities(np.array([16.0])) == pytest.approx([2.0])
    assert not diagnostics


@pytest.mark.parametrize("kind", ["DifferentialTransmission", "FourBarLinkageTransmission"])
def test_roles_decide_which_joint_is_the_first(kind: str) -> None:
    gear, _ = read(pair(kind))
    swapped, diagnostics = read(pair(kind, swapped=True))
    assert gear is not None
    assert swapped is not None
    assert not diagnostics
    assert swapped.ratios == pytest.approx(gear.ratios)


def test_missing_roles_are_reported_and_the_order_of_the_file_counts() -> None:
    gear, diagnostics = read(pair("DifferentialTransmission", roles=False))
    expected, _ = read(pair("DifferentialTransmission"))
    assert gear is not None
    assert expected is not None
    assert gear.ratios == pytest.approx(expected.ratios)
    (finding,) = diagnostics.by_code("control.transmission-roles")
    assert "joint1, joint2, actuator1, actuator2" in finding.message


def test_transmission_problems_are_reported() -> None:
    gear, diagnostics = read(pair("DifferentialTransmission", reduction="0"))
    assert gear is None
    (finding,) = diagnostics.by_code("control.transmission-reduction")
    assert "Transmission reduction ratios cannot be zero." in finding.message
    gear, diagnostics = read(pair("SimpleTransmission"))
    assert gear is None
    (finding,) = diagnostics.by_code("control.transmission-parts")
    assert "needs 1 joint(s) and 1 actuator(s); it has 2 and 2" in finding.message
    gear, diagnostics = read(pair("SimpelTransmission"))
    assert gear is None
    (finding,) = diagnostics.by_code("control.transmission-type")
    assert finding.fix.startswith("did you mean 'SimpleTransmission'")
