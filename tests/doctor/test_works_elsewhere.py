"""What only Gazelle lacks is a warning in a user's package."""

from __future__ import annotations

import pytest
from tests.doctor.conftest import Examine, Write

from gazelle.diagnostics import Diagnostic, Severity
from gazelle.doctor.works_elsewhere import as_warnings_of_parts_elsewhere

NODE = "Cannot locate node of type [{}] in package [{}]; the package has: ekf_node"
CLASS = "'/spawner' cannot load controller 'c': Could not load class '{}/Own': it does not exist"


def severity(code: str, message: str, fix: str = "", *others: str) -> Severity:
    found = [Diagnostic(code, Severity.ERROR, message, fix=fix)]
    found += [Diagnostic(other, Severity.INFO, "") for other in others]
    return as_warnings_of_parts_elsewhere(found, ["bot"])[0].severity


def test_compiled_node_of_a_package_is_a_warning(written: Write, examined: Examine) -> None:
    launch = '<launch><node pkg="bot" type="drive" name="drive"/></launch>'
    folder = written(**{"launch__one.launch": launch, "src__drive.cpp": "int main() {}"})
    (found,) = (i for i in examined(folder, "bot").findings if i.code == "launch.compiled-node")
    assert found.severity is Severity.WARNING


def test_program_of_ros_that_is_not_here_is_a_warning_and_a_slip_an_error() -> None:
    code, message = "launch.executable-missing", NODE.format("tf_node", "robot_localization")
    assert severity(code, message) is Severity.WARNING
    assert severity(code, message, "did you mean 'ekf_node'?") is Severity.ERROR
    assert severity(code, NODE.format("drive", "bot")) is Severity.ERROR


def test_controller_in_the_users_own_cpp_is_a_warning() -> None:
    assert severity("doctor.controller-fails", CLASS.format("bot")) is Severity.WARNING
    assert severity("doctor.controller-fails", CLASS.format("effort_control")) is Severity.ERROR


def test_controllers_of_hardware_in_cpp_are_warnings() -> None:
    message = "'/spawner' cannot load controller 'c': it needs command interface 'j/effort'"
    assert severity("doctor.controller-fails", message) is Severity.ERROR
    found = severity("doctor.controller-fails", message, "", "control.robot-sim-type")
    assert found is Severity.WARNING


@pytest.mark.parametrize(
    ("include", "expected"),
    [('<xacro:include filename="$(find arms)/a.xacro"/>', Severity.WARNING), ("", Severity.ERROR)],
)
def test_macro_of_a_package_that_is_not_here_is_a_warning(
    written: Write, examined: Examine, include: str, expected: Severity
) -> None:
    text = f'<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">{include}<link name="a"/>'
    folder = written(**{"urdf__r.xacro": f"{text}<xacro:arm/></robot>"})
    found = [i for i in examined(folder, "bot").findings if i.code == "xacro.unknown-macro"]
    assert [item.severity for item in found] == [expected]


def test_description_that_only_lacks_such_a_macro_is_a_warning(
    written: Write, examined: Examine
) -> None:
    text = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><link name="a"/>'
    text += '<xacro:include filename="$(find arms)/a.xacro"/><xacro:arm/></robot>'
    launch = '<launch><param name="robot_description" command="xacro $(dirname)/r.xacro"/></launch>'
    folder = written(**{"launch__r.xacro": text, "launch__r.launch": launch})
    found = [i for i in examined(folder, "bot").findings if i.severity is Severity.ERROR]
    assert found == []


def test_mecanum_controller_of_ros1_is_a_warning() -> None:
    message = (
        "'/s' cannot load controller 'c': ROS 1's mecanum_drive_controller is compiled code of"
    )
    assert severity("doctor.controller-fails", message) is Severity.WARNING
