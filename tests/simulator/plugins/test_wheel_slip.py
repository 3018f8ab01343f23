"""Wheel slip plug-ins against their law: slip ratio = compliance × force ratio."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from gazelle.interfaces import message_type, service_type
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

MASS_KG, FORCE_N, RADIUS_M = 10.0, 20.0, 0.1
NORMAL_N = MASS_KG * 9.8 / 4
NAMES = [f"{end}_{side}" for end in ("front", "rear") for side in ("left", "right")]


def cart(library: str, compliance: str, keys: str = "") -> str:
    parts = []
    for name in NAMES:
        x = 0.2 if "front" in name else -0.2
        y = 0.15 if "left" in name else -0.15
        parts.append(
            f"""<link name="{name}"><inertial><mass value="1"/><inertia ixx="0.005" ixy="0"
              ixz="0" iyy="0.005" iyz="0" izz="0.005"/></inertial>
              <collision><geometry><sphere radius="0.1"/></geometry></collision></link>
            <joint name="{name}_joint" type="continuous"><origin xyz="{x} {y} 0"/>
              <parent link="base"/><child link="{name}"/><axis xyz="0 1 0"/></joint>"""
        )
    wheels = "".join(
        f"""<wheel link_name="{name}">{compliance}
        <wheel_normal_force>{NORMAL_N}</wheel_normal_force></wheel>"""
        for name in NAMES
    )
    return f"""<robot name="cart"><link name="base"><inertial><mass value="6"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
      {"".join(parts)}<gazebo><plugin name="slip" filename="{library}">{wheels}{keys}</plugin>
      </gazebo></robot>"""


def compliances(lateral: float, longitudinal: float) -> str:
    return f"""<slip_compliance_lateral>{lateral}</slip_compliance_lateral>
      <slip_compliance_longitudinal>{longitudinal}</slip_compliance_longitudinal>"""


def pulled(
    sim: Simulation, force: tuple[float, float, float], rate: float = 5.0
) -> tuple[float, ...]:
    """Drive at a wheel rate with a force at the height of the ground; return the speed."""
    engine = sim.server.engine
    for name in NAMES:
        engine.joint(f"cart::{name}_joint").set_velocity_target(rate, 100.0)
    engine.link("cart::base").apply_wrench(force, point_link_m=(0, 0, -RADIUS_M))
    sim.run(seconds=2.0)
    return tuple(float(value) for value in sim.link("base").linear_velocity_m_s)


def slip_ratio(compliance: float) -> float:
    return compliance * (FORCE_N / 4) / NORMAL_N


@pytest.mark.parametrize(
    "library",
    ["libgazebo_ros_wheel_slip.so", "libWheelSlipPlugin.so", "gz-sim-wheel-slip-system"],
)
def test_wheels_slip_forward_by_compliance_times_force_ratio(load: Load, library: str) -> None:
    sim = load(cart(library, compliances(0.0, 0.7)))
    forward, sideways, _ = pulled(sim, (-FORCE_N, 0.0, 0.0))
    assert forward == pytest.approx(0.5 * (1 - slip_ratio(0.7)), rel=0.01)
    assert sideways == pytest.approx(0.0, abs=1e-3)


def test_wheels_slip_sideways_by_compliance_times_force_ratio(load: Load) -> None:
    sim = load(cart("libgazebo_ros_wheel_slip.so", compliances(0.7, 0.0)))
    forward, sideways, _ = pulled(sim, (0.0, FORCE_N, 0.0))
    assert forward == pytest.approx(0.5, rel=0.01)
    assert sideways == pytest.approx(0.5 * slip_ratio(0.7), rel=0.03)


def test_wheels_that_do_not_turn_do_not_slip(load: Load) -> None:
    sim = load(cart("libgazebo_ros_wheel_slip.so", compliances(1.0, 1.0)))
    _, sideways, _ = pulled(sim, (0.0, FORCE_N, 0.0), rate=0.0)
    assert sideways == pytest.approx(0.0, abs=1e-4)


def test_ros1_changes_compliances_live(load: Load) -> None:
    sim = load(cart("libgazebo_ros_wheel_slip.so", compliances(0.0, 0.0)))
    forward, _, _ = pulled(sim, (-FORCE_N, 0.0, 0.0))
    assert forward == pytest.approx(0.5, rel=0.01)
    request = service_type("dynamic_reconfigure/Reconfigure").Request()
    parameter = message_type("dynamic_reconfigure/DoubleParameter")
    request.config.doubles = [parameter(name="slip_compliance_unitless_longitudinal", value=0.8)]
    answer = sim.server.node.call("/cart/wheel_slip/set_parameters", request)
    values = {item.name: item.value for item in answer.config.doubles}
    assert values["slip_compliance_unitless_longitudinal"] == 0.8
    sim.run(seconds=2.0)
    forward = float(sim.link("base").linear_velocity_m_s[0])
    assert forward == pytest.approx(0.5 * (1 - slip_ratio(0.8)), rel=0.01)


def test_ros2_publishes_slip_and_takes_parameters_for_one_wheel(load: Load, listen: Listen) -> None:
    keys = "<ros><namespace>/robot</namespace></ros>"
    sim = load(cart("libgazebo_ros_wheel_slip.so", compliances(0.0, 0.5), keys))
    slips = listen(sim, "/robot/wheel_slip")
    pulled(sim, (-FORCE_N, 0.0, 0.0))
    assert slips[-1].name == NAMES
    assert slips[-1].longitudinal_slip == pytest.approx([slip_ratio(0.5)] * 4, rel=0.03)
    assert slips[-1].lateral_slip == pytest.approx([0.0] * 4, abs=1e-3)
    parameter = message_type("rcl_interfaces/Parameter")
    request = service_type("rcl_interfaces/SetParameters").Request()
    for name, value in (("slip_compliance_unitless_longitudinal", 1.0), ("nonsense", 1.0),
                        ("slip_compliance_unitless_lateral/front_left", -2.0)):  # fmt: skip
        item = parameter(name=name)
        item.value.type, item.value.double_value = 3, value
        request.parameters.append(item)
    results = sim.server.node.call("/robot/slip/set_parameters", request).results
    assert [result.successful for result in results] == [True, False, False]
    assert "cannot be negative" in results[2].reason
    sim.run(seconds=2.0)
    assert slips[-1].longitudinal_slip == pytest.approx([slip_ratio(1.0)] * 4, rel=0.03)


def test_wheels_without_normal_force_or_axle_are_reported(load: Load) -> None:
    keys = """<wheel link_name="front_left"/><wheel link_name="base"/>
      <wheel link_name="front_lefd"/>"""
    sim = load(cart("libWheelSlipPlugin.so", "", keys))
    found = [item.message for item in sim.diagnostics if item.code == "parameter.bad-value"]
    assert any("needs a positive <wheel_normal_force>" in text for text in found)
    assert any("has no parent joint that turns" in text for text in found)
    missing = [item for item in sim.diagnostics if item.code == "plugin.missing-link"]
    assert "front_left" in missing[0].fix
