"""Feedback on joints far too light for it, as robot files in the wild have them."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from tests.control.hardware.rig import block, joint, ros1_rig, ros2_rig, transmission
from tests.sets import few

from gazelle.control.pid import Pid, PidGains

STEP_S = 0.001
TARGET = 0.5
LIMIT = 'lower="-1.57" upper="1.57" effort="100" velocity="100"'


def light(inertia, friction=0.0):
    return f"""<link name="j_link"><inertial><mass value="1e-5"/><inertia ixx="{inertia}"
    iyy="{inertia}" izz="{inertia}" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="j" type="revolute"><parent link="world"/><child link="j_link"/>
    <axis xyz="0 0 1"/><limit {LIMIT}/><dynamics friction="{friction}"/></joint>"""


def follow(rig, gains, target, steps):
    """Run a PID on the joint's effort as controllers do; return positions and efforts."""
    pid, interface_values = Pid(gains), rig.robot.interface_values
    place = interface_values.command_index["j/effort"]
    seen = []
    for _ in range(steps):
        now, step_ns = rig.engine.time_ns, rig.engine.step_ns
        rig.robot.read(now, step_ns)
        interface_values.commands[place] = pid.compute(target - rig.position("j"), STEP_S)
        interface_values.answer(place, gains.p, gains.d)
        rig.robot.write(now, step_ns)
        rig.engine.step()
        seen.append((rig.position("j"), rig.engine.joint("rig::j").effort))
    return np.array(seen).T


FRICTIONS, INERTIAS = (0.0, 1.0, 10.0), (1e-8, 1e-6, 1e-4)
GAINS = ((100.0, 10.0), (100.0, 1.0), (1000.0, 0.1))
# Any two of the three values meet in a part of them already.
SQUARE = [
    (FRICTIONS[k], INERTIAS[n], *GAINS[(k + n) % 3]) for k in range(3) for n in range(3)
]  # fmt: skip
CUBE = [(*some, *gains) for some in itertools.product(FRICTIONS, INERTIAS) for gains in GAINS]


@pytest.mark.parametrize("build", [ros1_rig, ros2_rig])
@pytest.mark.parametrize(("friction", "inertia", "p", "d"), few(SQUARE, CUBE))
def test_light_joint_reaches_its_target_and_stays(build, friction, inertia, p, d):
    drive = transmission("j") if build is ros1_rig else block(joint("j", ("effort",)))
    rig = build(light(inertia, friction), drive)
    rig.claim("j/effort")
    before, _ = follow(rig, PidGains(p=p, d=d), 0.0, 100)
    assert np.abs(before).max() < 1e-6
    position, effort = follow(rig, PidGains(p=p, d=d), TARGET, 300)
    assert np.abs(position).max() < 1.2 * TARGET
    assert np.abs(position[-200:] - TARGET).max() < 0.05
    assert np.abs(effort).max() <= 100.0 * (1 + 1e-6)


def test_effort_of_another_controller_acts_as_it_is():
    rig = ros1_rig(light(1e-3), transmission("j"))
    rig.claim("j/effort")
    follow(rig, PidGains(p=1000.0, d=10.0), 0.0, 10)
    rig.drop("j/effort")
    rig.claim("j/effort")
    rig.run(10, j_effort=0.01)
    assert rig.velocity("j") == pytest.approx(10 * STEP_S * 0.01 / 1e-3, rel=1e-6)


@pytest.mark.parametrize("friction", [0.0, 10.0])
@pytest.mark.parametrize("inertia", [1e-8, 1e-6, 1e-4, 1e-2])
def test_efforts_carry_no_joint_through_its_stops(friction, inertia):
    rig = ros1_rig(light(inertia, friction), transmission("j"))
    rig.claim("j/effort")
    chance = np.random.default_rng(1)
    positions = []
    for _ in range(60):
        effort = float(chance.choice([-100.0, 100.0, -20.0, 20.0, 5.0, 0.0]))
        for _ in range(10):
            rig.run(1, j_effort=effort)
            positions.append(rig.position("j"))
    # A stop is felt in the step after it was passed.
    assert np.abs(positions).max() < 1.57 + 0.12
    assert np.abs(positions).max() > 1.5
