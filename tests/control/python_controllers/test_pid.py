"""The PID of a user's controller."""

from __future__ import annotations

import pytest

from gazelle.control import Pid
from gazelle.control.pid import Pid as ControlPid
from gazelle.control.pid import PidGains
from gazelle.control.python_controllers.controller_api import ControlPeriod


def test_it_computes_as_control_toolbox_does():
    ours, theirs = Pid(150.0, 2.0, 30.0, 1.0), ControlPid(PidGains(150.0, 2.0, 30.0, 1.0, -1.0))
    for error in (0.1, 0.2, -0.3, 0.05):
        assert ours.compute(error, 0.001) == theirs.compute(error, 0.001)
    assert ours.command == theirs.command


def test_pr2s_update_takes_the_error_the_other_way_round():
    now, then = Pid(p=2.0, d=0.5), Pid(p=2.0, d=0.5)
    for error in (0.1, 0.4):
        assert then.updatePid(-error, 0.01) == now.computeCommand(error, 0.01)


@pytest.mark.parametrize("period", [0.25, ControlPeriod.of(250_000_000)])
def test_a_period_is_seconds_or_a_duration(period):
    assert Pid(p=1.0, i=4.0, i_clamp=10.0).compute(1.0, period) == pytest.approx(2.0)


def test_gains_can_be_changed_and_the_integral_forgotten():
    pid = Pid(i=1.0, i_clamp=5.0)
    pid.compute(1.0, 1.0)
    pid.set_gains(i=2.0)
    assert pid.compute(0.0, 1.0) == pytest.approx(2.0)
    pid.reset()
    assert pid.compute(0.0, 1.0) == 0.0
    assert pid.gains.i == 2.0


CONTROLLER = """
from gazelle.control import Pid

class Steer:
    def init(self, robot, node):
        self.pid = Pid()
        self.wheel = robot.joint("joint_w1")
        return self.pid.init(node, "pid_steer")

    def update(self, time, period):
        self.wheel.effort = self.pid.compute(0.1 - self.wheel.position, period)
"""


def test_gains_of_the_document_are_read_and_can_be_changed_live(bench):
    bench.package("a_pkg", scripts__c=CONTROLLER)
    manager = bench.run("Steer", pid_steer={"p": 150.0, "i": 2.0, "d": 30.0, "i_clamp": 1.0})
    pid = manager.controllers["mine"].controller.user.pid
    assert pid.gains == PidGains(150.0, 2.0, 30.0, 1.0, -1.0)
    group, rows, change = bench.ports.live[0]
    assert group == "pid_steer"
    assert {row.name: row.value for row in rows}["p"] == 150.0
    manager.update(1_000_000, 1_000_000)
    values = {row.name: row.value for row in rows}
    change({**values, "p": 10.0, "d": 0.0, "i": 0.0})
    manager.update(2_000_000, 1_000_000)
    assert bench.command("joint_w1/effort") == pytest.approx(1.0)


def test_gains_without_p_are_refused_with_control_toolbox_words(bench):
    bench.package("a_pkg", scripts__c=CONTROLLER)
    with pytest.raises(Exception, match="Initializing controller 'mine' failed"):
        bench.run("Steer", pid_steer={"i": 2.0})
    assert (
        "error",
        "No p gain specified for pid.  Namespace: /mine/pid_steer",
    ) in bench.ports.lines
