"""Contact values with effects that nobody wants."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.description.checks.pain import FIXTURES, examined, finding, place

from gazelle.diagnostics import Severity


def test_soft_contact_sinks_by_weight_over_stiffness() -> None:
    item = finding("pain_15_contact/soft.urdf")
    assert item.code == "robot.soft-contact"
    # 3.45 kg · 9.8 m/s² / (4 · 1000 N/m)
    assert "kp of 1000 N/m" in item.message
    assert "3.45 kg on 4 such contacts it sinks in by 8.45 mm" in item.message
    assert item.fix == "write kp 1e+05, or leave it out"


def test_damping_beyond_stiffness_is_a_notice() -> None:
    item = finding("pain_15_contact/damped.urdf")
    assert (item.code, item.severity) == ("robot.damped-contact", Severity.INFO)
    # h·kp / (h·kp + kd) = 1e3 / 1.001e6
    assert "ODE corrects only 0.1 % of a penetration" in item.message
    assert item.fix == "write kd 100, or leave it out"


def test_depth_and_speed_of_correction_are_reported() -> None:
    depth, speed = examined(FIXTURES / "pain_15_contact/broken/deep.urdf").by_code(
        "robot.contact-depth"
    )
    assert "minDepth of 0.05 m: it sinks in that deep" in depth.message
    assert depth.fix == "write minDepth 0.001"
    assert "maxVel of 0 m/s" in speed.message
    assert place(speed) == "<collision>"


ARM = """<robot name="arm"><link name="base"><inertial><mass value="40"/><inertia ixx="1" ixy="0"
 ixz="0" iyy="1" iyz="0" izz="1"/></inertial><collision><geometry><box size="1 1 0.5"/></geometry>
</collision></link><link name="finger"><inertial><mass value="0.1"/><inertia ixx="1e-4" ixy="0"
 ixz="0" iyy="1e-4" iyz="0" izz="1e-4"/></inertial><collision><geometry><box size="0.1 0.1 0.1"/>
</geometry></collision></link><joint name="j" type="continuous"><parent link="base"/>
<child link="finger"/><origin xyz="0 0 {}"/></joint>
<gazebo reference="finger"><kp>1e4</kp></gazebo></robot>"""


@pytest.mark.parametrize(("height", "codes"), [(1.0, []), (-0.5, ["robot.soft-contact"])])
def test_only_what_the_robot_stands_on_bears_its_weight(
    tmp_path: Path, height: float, codes: list[str]
) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(ARM.format(height), encoding="utf-8")
    found = [item.code for item in examined(path)]
    assert [code for code in found if code == "robot.soft-contact"] == codes
