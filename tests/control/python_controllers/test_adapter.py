"""A user's class runs in the control loop."""

from __future__ import annotations

import math

import pytest

from gazelle.control.errors import ControllerError

MS = 1_000_000

PR2 = """
class MyControllerPlugin:
    def init(self, robot, node):
        self.node = node
        self.states = []
        for key in ("wheel1", "wheel2"):
            name = node.getParam(key)
            if name is None:
                node.log_error("No joint given in namespace: '%s'" % node.getNamespace())
                return False
            state = robot.getJointState(name)
            if state is None:
                node.log_error("MyController could not find joint named '%s'" % name)
                return False
            self.states.append(state)
        self.p = node.getParam("pid_steer/p")
        return True

    def starting(self):
        self.node.log_info("starting")

    def update(self):
        for state in self.states:
            state.commanded_effort_ = -self.p * state.position_

    def stopping(self):
        for state in self.states:
            state.commanded_effort_ = 0.0
"""

WHEELS = {"wheel1": "joint_w1", "wheel2": "joint_w2", "pid_steer": {"p": 150.0}}


def test_the_document_s_controller_runs_in_the_control_loop(bench):
    bench.package("tutorial", scripts__controller=PR2)
    manager = bench.run("MyControllerPlugin", **WHEELS)
    assert ("info", "starting") in bench.ports.lines
    assert manager.controllers["mine"].commands == ("joint_w1/effort", "joint_w2/effort")
    bench.state("joint_w1/position", 0.02)
    manager.update(MS, MS)
    assert bench.command("joint_w1/effort") == pytest.approx(-3.0)
    assert bench.command("joint_w2/effort") == 0.0
    manager.switch(stop=["mine"])
    assert bench.command("joint_w1/effort") == 0.0


@pytest.mark.parametrize(
    ("parameters", "line"),
    [
        ({"wheel2": "joint_w2"}, "No joint given in namespace: '/mine'"),
        ({"wheel1": "joint_w9"}, "MyController could not find joint named 'joint_w9'"),
    ],
)
def test_init_that_returns_false_refuses_as_the_document_does(bench, parameters, line):
    bench.package("tutorial", scripts__controller=PR2)
    with pytest.raises(ControllerError, match="Initializing controller 'mine' failed"):
        bench.run("MyControllerPlugin", **parameters)
    assert ("error", line) in bench.ports.lines


def test_time_and_period_are_ros_values_and_numbers(bench):
    bench.package(
        "a_pkg",
        scripts__c="""
        class C:
            def init(self, robot, node):
                self.node = node

            def starting(self, time):
                self.node.log_info(f"{time.to_sec()} {float(time)}")

            def update(self, time, period):
                self.node.log_info(f"{time.secs} {time.nsecs} {period.to_sec()} {float(period)}")

            def stopping(self, time):
                self.node.log_info(f"stopped {time.to_sec()}")
        """,
    )
    manager = bench.run("C")
    manager.update(1_500 * MS, 2 * MS)
    manager.switch(stop=["mine"])
    assert [text for _, text in bench.ports.lines] == [
        "0.0 0.0", "1 500000000 0.002 0.002", "stopped 1.5"]  # fmt: skip


def test_a_joint_is_claimed_by_effort_or_by_what_it_has(bench):
    bench.package(
        "a_pkg",
        scripts__c="""
        class C:
            def init(self, robot, node):
                self.wheel = robot.joint("joint_w1")
                self.slider = robot.joint("slider")

            def update(self, time, period):
                self.wheel.effort = 2.0
                self.slider.command = 0.5
        """,
    )
    manager = bench.run("C")
    assert manager.controllers["mine"].commands == ("joint_w1/effort", "slider/position")
    manager.update(MS, MS)
    assert (bench.command("joint_w1/effort"), bench.command("slider/position")) == (2.0, 0.5)


def test_a_class_chooses_its_interfaces(bench):
    bench.package(
        "a_pkg",
        scripts__c="""
        class C:
            command_interfaces = ("joint_w1/velocity",)

            def init(self, robot, node):
                self.wheel = robot.joint("joint_w1")

            def update(self, time, period):
                self.wheel.set_command(4.0)
        """,
    )
    manager = bench.run("C")
    assert manager.controllers["mine"].commands == ("joint_w1/velocity",)
    manager.update(MS, MS)
    assert bench.command("joint_w1/velocity") == 4.0
    assert math.isnan(bench.command("joint_w1/effort"))


def test_a_joint_that_is_not_there_names_the_nearest(bench):
    bench.package(
        "a_pkg",
        scripts__c="""
        class C:
            def init(self, robot, node):
                robot.joint("joint_w9")

            def update(self, time, period):
                pass
        """,
    )
    with pytest.raises(ControllerError, match=r"no joint or sensor 'joint_w9'; did you mean .*w1"):
        bench.run("C")


def test_a_joint_cannot_be_taken_after_init(bench):
    bench.package(
        "a_pkg",
        scripts__c="""
        class C:
            def init(self, robot, node):
                self.robot = robot

            def update(self, time, period):
                self.robot.joint("joint_w1")
        """,
    )
    manager = bench.run("C")
    manager.update(MS, MS)
    (found,) = bench.diagnostics.by_code("control.controller-failed")
    assert "joint 'joint_w1' must be taken in init()" in found.message


def test_effort_of_a_joint_commanded_by_position_is_refused(bench):
    bench.package(
        "a_pkg",
        scripts__c="""
        class C:
            def init(self, robot, node):
                robot.joint("slider").effort = 1.0

            def update(self, time, period):
                pass
        """,
    )
    with pytest.raises(ControllerError, match="'slider' is commanded by 'position', not by"):
        bench.run("C")


def test_an_error_in_update_stops_the_controller_and_names_file_and_line(bench):
    root = bench.package(
        "a_pkg",
        scripts__c="""
        class C:
            def init(self, robot, node):
                pass

            def update(self, time, period):
                self.later()

            def later(self):
                return 1 / 0
        """,
    )
    manager = bench.run("C")
    manager.update(MS, MS)
    assert not manager.controllers["mine"].is_active
    (found,) = bench.diagnostics.by_code("control.controller-failed")
    place = f"{root}/scripts/c.py:10 in later(): ZeroDivisionError: division by zero"
    assert place in found.message


@pytest.mark.parametrize(
    ("body", "phrase"),
    [
        ("def init(self, robot, node):\n        raise KeyError('x')",
         r"init\(\) of controller class 'C' failed: .*c.py:3 in init\(\): KeyError"),
        ("def __init__(self):\n        raise OSError('y')",
         r"__init__\(\) .* failed: .*OSError: y"),
        ("def init(self, robot):\n        pass", r"init\(\) of controller class 'C' takes 1 "
         "arguments, but is called with robot and node"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_class_is_said(bench, body, phrase):
    text = f"class C:\n    {body}\n\n    def update(self, time, period):\n        pass\n"
    bench.package("a_pkg", scripts__c=text)
    with pytest.raises(ControllerError, match=phrase):
        bench.run("C")


def test_a_class_without_update_is_refused(bench):
    bench.package("a_pkg", scripts__c="class C:\n    def init(self, robot, node):\n        pass\n")
    with pytest.raises(ControllerError, match=r"class 'C' has no update\(time, period\)"):
        bench.run("C")


def test_the_node_has_parameters_topics_and_log_of_the_controller(bench):
    bench.package(
        "a_pkg",
        scripts__c="""
        class C:
            def init(self, robot, node):
                self.node = node
                node.subscribe("command", "std_msgs/Float64", self.on_command)
                node.log_warn(f"{node.get_param('gains')} {node.get_param('x', 7)} {node.name}")

            def on_command(self, message):
                self.node.publish("/echo", message)

            def update(self, time, period):
                message = self.node.message("std_msgs/Float64", data=time.to_sec())
                self.node.publish("state", message)
        """,
    )
    manager = bench.run("C", gains={"p": 1.0})
    assert ("warn", "{'p': 1.0} 7 mine") in bench.ports.lines
    manager.update(MS, MS)
    (sent,) = bench.ports.sent["~/state"]
    assert sent.data == 0.001
    bench.ports.callbacks["~/command"](sent)
    assert bench.ports.sent["/echo"] == [sent]


def test_a_parameter_that_is_not_set_names_the_nearest(bench):
    bench.package(
        "a_pkg",
        scripts__c="""
        class C:
            def init(self, robot, node):
                node.get_param("wheel_1")

            def update(self, time, period):
                pass
        """,
    )
    with pytest.raises(ControllerError, match=r"'/mine/wheel_1' is not set; did you mean .*wheel1"):
        bench.run("C", wheel1="joint_w1")
