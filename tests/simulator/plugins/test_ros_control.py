"""``libgazebo_ros_control`` in a simulation: robots, namespaces, descriptions, periods, resets."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.simulator import Simulation
from gazelle.workspace import Workspace

Load = Callable[..., Simulation]

PLUGIN = '<gazebo><plugin name="control" filename="libgazebo_ros_control.so">{}</plugin></gazebo>'
NAMESPACE = "<robotNamespace>/bot</robotNamespace>"


def joint(name: str, interface: str = "Effort") -> str:
    return f"""<link name="{name}_link"><inertial><mass value="1"/>
    <inertia ixx="0.5" iyy="0.5" izz="0.5" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="{name}" type="revolute"><parent link="world"/><child link="{name}_link"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="10" velocity="4"/></joint>
    <transmission name="{name}_trans"><type>transmission_interface/SimpleTransmission</type>
    <joint name="{name}"><hardwareInterface>hardware_interface/{interface}JointInterface
    </hardwareInterface></joint><actuator name="m"/></transmission>"""


def robot(*parts: str, keys: str = NAMESPACE) -> str:
    return f'<robot name="bot"><link name="world"/>{"".join(parts)}{PLUGIN.format(keys)}</robot>'


def found(sim: Simulation, code: str) -> str:
    (finding,) = sim.diagnostics.by_code(code)
    return f"{finding.message} {finding.fix}"


def effort(name: str = "j") -> dict[str, Any]:
    return {"bot": {"go": {"type": "effort_controllers/JointEffortController", "joint": name}}}


def say(sim: Simulation, topic: str, value: float) -> None:
    sim.publish(topic, message_type("std_msgs/Float64")(data=value))


def test_a_command_on_a_topic_accelerates_the_joint(load: Load) -> None:
    sim = load(robot(joint("j")), parameters=effort())
    manager = sim.controller_manager("/bot")
    manager.load("go")
    manager.start("go")
    say(sim, "/bot/go/command", 2.0)
    sim.run(seconds=0.5)
    # The first step has no effort yet: controllers run after a step, for the next one.
    assert sim.joint("j").velocity == pytest.approx(2.0 / 0.5 * 0.499, rel=1e-9)


def test_a_pid_under_the_limits_of_mira_moves_as_an_independent_integration(load: Load) -> None:
    inertia, max_effort, max_velocity, step_s, target = 0.002, 0.1, 0.005, 0.001, 0.1
    part = joint("j").replace('effort="10" velocity="4"', 'effort="0.1" velocity="0.005"')
    part = part.replace('"0.5"', f'"{inertia}"')
    go = {"type": "effort_controllers/JointPositionController", "joint": "j"}
    sim = load(
        robot(part), parameters={"bot": {"go": {**go, "pid": {"p": 1.0, "i": 1.0, "d": 0.0}}}}
    )
    manager = sim.controller_manager()
    manager.load("go")
    manager.start("go")
    say(sim, "/bot/go/command", target)
    position, velocity, effort = 0.0, 0.0, 0.0
    measured, expected = [], []
    for _ in range(3000):
        sim.step()
        measured.append(sim.joint("j").position)
        velocity += effort / inertia * step_s
        position += velocity * step_s
        expected.append(position)
        # i without i_clamp has no effect; efforts stop where the velocity limit is passed.
        low = 0.0 if velocity < -max_velocity else -max_effort
        high = 0.0 if velocity > max_velocity else max_effort
        effort = min(max(target - position, low), high)
    assert measured == pytest.approx(expected, abs=1e-9)
    assert max(measured) > target


@pytest.mark.parametrize(
    ("keys", "namespace"),
    [
        (NAMESPACE, "/bot"),
        ("<robotNamespace>/</robotNamespace>", "/"),
        ("<robotNamespace>a/b</robotNamespace>", "/a/b"),
        ("", "/bot"),
    ],
)
def test_namespace_is_the_plugins_or_the_models_name(load: Load, keys: str, namespace: str) -> None:
    sim = load(robot(joint("j"), keys=keys))
    assert list(sim.server.controls.managers) == [namespace]
    services = sim.server.node.services
    assert f"{namespace.rstrip('/')}/controller_manager/list_controllers" in services


def test_the_plugin_of_2011_is_in_the_root_namespace(load: Load) -> None:
    old = robot(joint("j"), keys="<alwaysOn>true</alwaysOn><updateRate>1000.0</updateRate>")
    sim = load(old.replace("libgazebo_ros_control.so", "libgazebo_ros_controller_manager.so"))
    assert list(sim.server.controls.managers) == ["/"]


def test_the_description_in_the_parameter_store_counts(load: Load) -> None:
    bare = robot(joint("j").split("<transmission")[0])
    sim = load(bare, parameters={"robot_description": robot(joint("j", "Position"))})
    assert list(sim.controller_manager().controllers) == []
    interface_values = sim.server.controls.manager().robot.interface_values
    assert list(interface_values.command_index) == ["j/position"]


def test_the_description_of_another_robot_does_not_count(load: Load) -> None:
    sim = load(robot(joint("j")), parameters={"robot_description": robot(joint("other"))})
    assert list(sim.server.controls.manager().robot.interface_values.command_index) == ["j/effort"]
    assert "'/robot_description' is of another robot" in found(sim, "control.robot-description")


def test_controllers_run_once_in_a_control_period(load: Load) -> None:
    keys = NAMESPACE + "<controlPeriod>0.01</controlPeriod>"
    sim = load(robot(joint("j"), keys=keys), parameters=effort())
    manager = sim.controller_manager()
    manager.load("go")
    manager.start("go")
    say(sim, "/bot/go/command", 2.0)
    sim.step(9)
    assert sim.joint("j").velocity == 0.0
    sim.step(11)
    assert sim.joint("j").velocity == pytest.approx(2.0 / 0.5 * 0.010, rel=1e-9)
    assert sim.server.controls.manager().update_rate_hz == pytest.approx(100.0)


def test_a_period_that_does_not_fit_the_step_is_reported(load: Load) -> None:
    sim = load(robot(joint("j"), keys="<controlPeriod>0.0005</controlPeriod>"))
    assert "faster than the gazebo simulation" in found(sim, "control.period")
    assert sim.server.controls.manager().update_rate_hz == pytest.approx(1000.0)


def test_hardware_of_the_users_own_is_replaced_with_a_notice(load: Load) -> None:
    keys = NAMESPACE + "<robotSimType>hector/QuadrotorHardwareSim</robotSimType>"
    sim = load(robot(joint("j"), keys=keys))
    assert "'hector/QuadrotorHardwareSim' is compiled code" in found(sim, "control.robot-sim-type")
    assert list(sim.server.controls.manager().robot.joints) == ["j"]


def test_gains_of_joints_are_read_and_changed_live(load: Load) -> None:
    gains = {"gazebo_ros_control": {"pid_gains": {"j": {"p": 2.0, "d": 1.0}}}}
    sim = load(robot(joint("j", "Position")), parameters={"bot": gains})
    hardware: Any = sim.server.controls.manager().robot.components[0]
    (section,) = hardware.sections
    assert section.pids.gains[0].p == 2.0
    name = "/bot/gazebo_ros_control/pid_gains/j/set_parameters"
    assert name in sim.server.node.services
    config = message_type("dynamic_reconfigure/Config")()
    config.doubles = [message_type("dynamic_reconfigure/DoubleParameter")(name="p", value=7.0)]
    request = type("Request", (), {"config": config})()
    sim.server.node.call(name, request)
    sim.step()
    assert section.pids.gains[0].p == 7.0
    assert section.pids.gains[0].d == 1.0


@pytest.mark.parametrize(("keys", "expected"), [("true", 5.0), ("false", 2.0), (None, 2.0)])
def test_legacy_mode_reads_gains_outside_the_namespace(
    load: Load, keys: str | None, expected: float
) -> None:
    legacy = "" if keys is None else f"<legacyModeNS>{keys}</legacyModeNS>"
    tree = {
        "gazebo_ros_control": {"pid_gains": {"j": {"p": 5.0}}},
        "bot": {"gazebo_ros_control": {"pid_gains": {"j": {"p": 2.0}}}},
    }
    sim = load(robot(joint("j", "Position"), keys=NAMESPACE + legacy), parameters=tree)
    hardware: Any = sim.server.controls.manager().robot.components[0]
    assert hardware.sections[0].pids.gains[0].p == expected


def test_emergency_stop_comes_by_topic_and_ends(load: Load) -> None:
    keys = NAMESPACE + "<eStopTopic>e_stop</eStopTopic>"
    sim = load(robot(joint("j", "Velocity"), keys=keys), parameters={
        "bot": {"go": {"type": "velocity_controllers/JointVelocityController", "joint": "j"}}
    })  # fmt: skip
    manager = sim.controller_manager()
    manager.load("go")
    manager.start("go")
    say(sim, "/bot/go/command", 1.0)
    sim.run(seconds=0.2)
    assert sim.joint("j").velocity == pytest.approx(1.0, abs=1e-3)
    stop = message_type("std_msgs/Bool")
    sim.publish("/bot/e_stop", stop(data=True))
    sim.run(seconds=0.2)
    assert sim.joint("j").velocity == pytest.approx(0.0, abs=1e-3)
    sim.publish("/bot/e_stop", stop(data=False))
    say(sim, "/bot/go/command", 1.0)
    sim.run(seconds=0.2)
    assert sim.joint("j").velocity == pytest.approx(1.0, abs=1e-3)


def test_after_a_reset_everything_happens_again(load: Load) -> None:
    sim = load(robot(joint("j")), parameters=effort())
    manager = sim.controller_manager()
    manager.load("go")
    manager.start("go")

    def trial() -> list[float]:
        say(sim, "/bot/go/command", 2.0)
        sim.run(seconds=0.1)
        return [sim.joint("j").position, sim.joint("j").velocity]

    first = trial()
    sim.reset()
    assert sim.joint("j").position == 0.0
    assert trial() == first


def test_a_deleted_robot_takes_its_manager_along(load: Load) -> None:
    sim = load(robot(joint("j")))
    sim.delete("bot")
    assert sim.server.controls.managers == {}
    assert not [name for name in sim.server.node.services if "controller_manager" in name]
    sim.run(seconds=0.1)


def test_a_controller_of_a_wrong_joint_is_said_before_the_first_step(load: Load) -> None:
    sim = load(robot(joint("elbow")), parameters=effort("elbwo"))
    text = "\n".join(item.message for item in sim.diagnostics)
    assert "elbwo" in text
    assert "elbow" in text


def test_imus_of_the_model_are_there_for_controllers(load: Load) -> None:
    sensor = (
        '<gazebo reference="j_link"><sensor name="imu_sensor" type="imu"><update_rate>100'
        "</update_rate></sensor></gazebo>"
    )
    sim = load(robot(joint("j"), sensor))
    found_robot = sim.server.controls.manager().robot
    assert found_robot.sensor_frames == {"imu_sensor": "j_link"}
    (place,) = found_robot.interface_values.state_indices(["imu_sensor/linear_acceleration.z"])
    sim.run(seconds=0.1)
    assert found_robot.interface_values.states[place] == pytest.approx(9.8, rel=1e-3)


@pytest.fixture
def mira(load: Load, documents: Workspace) -> Callable[[], Simulation]:
    """MIRA of the document with its own parameters, standing as its launch file spawns it."""

    def bring_up() -> Simulation:
        package = documents.package("urdf_exam").path
        return load(
            package / "urdf" / "mira_gazebo_controller.urdf",
            name="mira",
            pose=Pose((0.0, 0.0, 0.045)),
            workspace=documents,
            parameters=package / "config" / "mira_control.yaml",
        )

    return bring_up


@pytest.mark.tutorial
def test_mira_holds_its_head_until_and_while_controllers_run(
    mira: Callable[[], Simulation],
) -> None:
    sim = mira()
    joints = ("roll_joint", "pitch_joint")
    sim.run(seconds=1.0)
    assert [sim.joint(name).position for name in joints] == pytest.approx([0.0, 0.0], abs=1e-4)
    manager = sim.controller_manager("/mira")
    names = [f"{name}_position_controller" for name in (*joints, "yaw_joint")]
    for name in names:
        manager.load(name)
    manager.start(*names)
    sim.run(seconds=2.0)
    # Uncontrolled they fall to −0.20 and 0.44 (its limits) within 1.5 s.
    assert abs(sim.joint("roll_joint").position) < 0.05
    assert sim.joint("pitch_joint").position < 0.15
    say(sim, "/mira/roll_joint_position_controller/command", 0.1)
    sim.run(seconds=3.0)
    assert sim.joint("roll_joint").position == pytest.approx(0.1, abs=0.05)


@pytest.mark.tutorial
def test_mira_droops_without_controllers(load: Load, documents: Workspace) -> None:
    package = documents.package("urdf_exam").path
    sim = load(
        package / "urdf" / "mira_gazebo_controller.urdf",
        name="mira",
        pose=Pose((0.0, 0.0, 0.045)),
        workspace=documents,
    )
    sim.run(seconds=2.0)
    assert sim.joint("pitch_joint").position == pytest.approx(0.44, abs=0.02)
