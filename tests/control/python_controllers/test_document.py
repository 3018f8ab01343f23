"""Files in the style of the PR2 tutorial as they are, with their controller written in Python."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.shared_files import SHARED, shared_cases

import gazelle
from gazelle.workspace import Workspace

TANDEM = Path(__file__).parents[3] / "examples/pr2_style_ws/src/tandem_controller"
DOCUMENT = SHARED / "workspaces/catkin_ws/src/tutorial_controller"
PACKAGE = """\
<package format="2"><name>my_controller</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license>
<buildtool_depend>catkin</buildtool_depend></package>
"""
CONTROLLER = """
from gazelle.control import Pid


class MyControllerPlugin:
    def init(self, robot, n):
        self.wheels = []
        for key in ("wheel1", "wheel2"):
            name = n.getParam(key)
            if name is None:
                n.log_error("No joint given in namespace: '%s'" % n.getNamespace())
                return False
            state = robot.getJointState(name)
            if state is None:
                n.log_error("MyController could not find joint named '%s'" % name)
                return False
            self.wheels.append(state)
        self.pid = Pid()
        return self.pid.init(n, "pid_steer")

    def starting(self):
        self.angle = self.wheels[0].position_
        self.pid.reset()

    def update(self, time, period):
        self.angle += 0.5 * period.to_sec()
        wheel = self.wheels[0]
        wheel.commanded_effort_ = self.pid.updatePid(wheel.position_ - self.angle, period)

    def stopping(self):
        self.wheels[0].commanded_effort_ = 0.0
"""


@pytest.mark.tutorial
@pytest.mark.parametrize(
    ("robot", "parameters", "namespace", "joints", "drift_rad_s"),
    [
        (
            TANDEM / "urdf/robot.xml",
            TANDEM / "config/controller.yaml",
            "tandem_controller",
            ("joint_front", "joint_rear"),
            # Its body of 6 kg gives way a little more.
            0.1,
        ),
        *shared_cases(
            (
                DOCUMENT / "robot.xml",
                DOCUMENT / "controller.yaml",
                "my_controller_ns",
                ("joint_w1", "joint_w2"),
                0.05,
            )
        ),
    ],
)
def test_the_type_of_the_yaml_is_the_class_in_python(
    robot: Path,
    parameters: Path,
    namespace: str,
    joints: tuple[str, str],
    drift_rad_s: float,
    tmp_path: Path,
) -> None:
    package = tmp_path / "src" / "my_controller"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text(PACKAGE)
    (package / "scripts" / "controller.py").write_text(CONTROLLER)
    workspace = Workspace.discover(extra=[tmp_path / "src"], environ={}, cwd=tmp_path)
    with gazelle.Simulation.load(
        robot,
        world=None,
        workspace=workspace,
        parameters=parameters,
    ) as sim:
        record = sim.controller_manager().spawn(namespace)
        assert record.type == "MyControllerPlugin"
        assert record.commands == tuple(f"{name}/effort" for name in joints)
        gains = record.controller.user.pid.gains
        assert (gains.p, gains.i, gains.d, gains.i_max) == (150.0, 2.0, 30.0, 1.0)
        sim.run(seconds=1.0)
        assert sim.joint(joints[0]).velocity == pytest.approx(0.5, abs=0.01)
        assert sim.joint(joints[1]).velocity == pytest.approx(0.0, abs=drift_rad_s)
