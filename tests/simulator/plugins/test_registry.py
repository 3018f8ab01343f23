from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.diagnostics import Severity
from gazelle.simulator import Simulation
from gazelle.simulator.plugins.plugin_parameters import tables_as_markdown
from gazelle.simulator.plugins.registry import all_tables, known_names, plain_name
from gazelle.simulator.plugins.unsupported_plugins import NOTHING_TABLE
from gazelle.simulator.plugins.unsupported_plugins import TABLE as NAMED_TABLE

PAGE = Path(__file__).parents[3] / "docs" / "plugins.md"
LINK = "<link name='l'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0'"
LINK += " izz='1'/></inertial></link>"


def test_the_page_of_plug_ins_is_generated_from_the_tables() -> None:
    wanted = tables_as_markdown(all_tables())
    assert PAGE.read_text(encoding="utf-8") == wanted, (
        "docs/plugins.md is out of date: python -m gazelle.simulator.plugins > docs/plugins.md"
    )


@pytest.mark.parametrize(
    "filename",
    [
        "libgazebo_ros_diff_drive.so",
        "libgazebo_ros_laser.so",
        "libgazebo_ros_gpu_laser.so",
        "libgazebo_ros_ray_sensor.so",
        "libgazebo_ros_camera.so",
        "libgazebo_ros_openni_kinect.so",
        "libgazebo_ros_depth_camera.so",
        "libgazebo_ros_imu.so",
        "libgazebo_ros_imu_sensor.so",
        "libhector_gazebo_ros_imu.so",
        "libgazebo_ros_joint_state_publisher.so",
        "libgazebo_ros_p3d.so",
        "gz-sim-diff-drive-system",
        "libignition-gazebo-diff-drive-system.so",
        "gz-sim-joint-state-publisher-system",
        "gz-sim-physics-system",
        "libgazebo_ros_factory.so",
        "/opt/ros/noetic/lib/libgazebo_ros_camera.so",
        "gz-sim7-physics-system",
        "libignition-gazebo6-odometry-publisher-system.so",
        "ignition-gazebo-buoyancy-system",
    ],
)
def test_every_name_of_a_family_is_known(filename: str) -> None:
    assert plain_name(filename) in known_names()


def test_every_key_of_a_table_has_a_unique_name() -> None:
    for table in all_tables():
        names = [name for row in table.parameters.rows for name in row.names]
        assert len(names) == len(set(names)), table.parameters.family


def test_an_unknown_plug_in_is_named_once_with_its_place(load: Callable[..., Simulation]) -> None:
    plugin = "<gazebo>\n<plugin name='mine' filename='libgazebo_ros_diff_driv.so'/></gazebo>"
    sim = load(f"<robot name='r'>{LINK}{plugin}</robot>", world=None)
    (found,) = sim.diagnostics.by_code("plugin.unknown")
    assert "plug-in 'libgazebo_ros_diff_driv.so' (name 'mine') of model 'r'" in found.message
    assert "did you mean 'libgazebo_ros_diff_drive.so'" in found.fix
    assert found.phrase == "Failed to load plugin"
    assert found.span is not None
    assert found.span.line == 2
    sim.run(seconds=0.1)


@pytest.mark.parametrize(
    ("name", "fix"),
    [
        ("libgazebo_ros_time.so", "docs/plugins.md"),
        ("libLinkPlot3DPlugin.so", "docs/plugins.md"),
        ("libgazebo_ros_difdrive.so", "did you mean 'libgazebo_ros_diff_drive.so'?"),
        ("libbaxter_gazebo_ros_control.so", "did you mean 'libgazebo_ros_control.so' or "),
    ],
)
def test_only_names_that_are_alike_are_offered(
    load: Callable[..., Simulation], name: str, fix: str
) -> None:
    plugin = f"<gazebo><plugin name='mine' filename='{name}'/></gazebo>"
    sim = load(f"<robot name='r'>{LINK}{plugin}</robot>", world=None)
    (found,) = sim.diagnostics.by_code("plugin.unknown")
    assert fix in found.fix


def test_a_plug_in_of_the_world_is_said_to_be_the_worlds(load: Callable[..., Simulation]) -> None:
    unknown = "<plugin name='a' filename='libnobody.so'/>"
    drive = "<plugin name='b' filename='libgazebo_ros_p3d.so'><bodyName>lo</bodyName></plugin>"
    sim = load(f"<sdf version='1.6'><world name='w'>{unknown}{drive}</world></sdf>", world=None)
    (found,) = sim.diagnostics.by_code("plugin.unknown")
    assert "plug-in 'libnobody.so' (name 'a') of world 'w' is compiled code" in found.message
    (found,) = sim.diagnostics.by_code("plugin.missing-link")
    assert "plug-in 'b' needs link 'lo', which world 'w' does not have" in found.message


def test_a_plug_in_of_a_link_or_visual_is_named(load: Callable[..., Simulation]) -> None:
    plugin = "<plugin name='p' filename='libgazebo_ros_{}.so'/>"
    visual = f"<visual name='v'><geometry><empty/></geometry>{plugin.format('video')}</visual>"
    link = f"<link name='l'>{plugin.format('p3d')}{visual}</link>"
    sim = load(f"<sdf version='1.6'><model name='m'>{link}</model></sdf>", world=None)
    texts = [(one.message, one.fix) for one in sim.diagnostics.by_code("sdf.plugin-not-loaded")]
    assert texts == [
        (
            "plug-in 'libgazebo_ros_p3d.so' in <link> is not loaded: no Gazebo loads plug-ins of "
            "links",
            "move the <plugin> into the <model>, or into a <sensor> when it reads one",
        ),
        (
            "plug-in 'libgazebo_ros_video.so' in <visual> is not loaded: it would change what "
            "Gazebo's window shows",
            "nothing to do",
        ),
    ]


def test_systems_of_gz_sim_are_built_in(load: Callable[..., Simulation]) -> None:
    plugin = "<gazebo><plugin name='gz::sim::systems::Physics' filename='gz-sim-physics-system'/>"
    sim = load(f"<robot name='r'>{LINK}{plugin}</gazebo></robot>", world=None)
    (found,) = sim.diagnostics.by_code("plugin.built-in")
    assert "is part of Gazelle" in found.message


@pytest.mark.parametrize(
    ("filename", "needs"),
    [
        ("libgazebo_ros_laser.so", "needs a ray sensor around it"),
        ("libgazebo_ros_camera.so", "needs a camera around it"),
        ("libgazebo_ros_openni_kinect.so", "needs a camera around it"),
        ("libgazebo_ros_imu_sensor.so", "needs an imu sensor around it"),
        ("libgazebo_ros_bumper.so", "needs a contact sensor around it"),
        ("libgazebo_ros_gps_sensor.so", "needs a gps sensor around it"),
        ("libgazebo_ros_range.so", "needs a ray or sonar sensor around it"),
        ("libhector_gazebo_ros_sonar.so", "needs a ray or sonar sensor around it"),
        ("libgazebo_ros_multicamera.so", "needs a camera around it"),
        ("libgazebo_ros_block_laser.so", "needs a ray sensor around it"),
    ],
)
def test_a_sensor_plug_in_outside_its_sensor_is_reported(
    load: Callable[..., Simulation], filename: str, needs: str
) -> None:
    plugin = f"<gazebo><plugin name='p' filename='{filename}'/></gazebo>"
    sim = load(f"<robot name='r'>{LINK}{plugin}</robot>", world=None)
    (found,) = sim.diagnostics.by_code("plugin.wrong-place")
    assert needs in found.message


@pytest.mark.parametrize(
    "plugin",
    [
        "<plugin name='p' filename='libgazebo_ros_p3d.so'><bodyName>lo</bodyName></plugin>",
        "<plugin name='p' filename='libgazebo_ros_imu.so'><bodyName>lo</bodyName></plugin>",
        "<plugin name='p' filename='libhector_gazebo_ros_imu.so'><bodyName>lo</bodyName></plugin>",
        "<plugin name='p' filename='libhector_gazebo_ros_gps.so'><bodyName>lo</bodyName></plugin>",
        "<plugin name='p' filename='libgazebo_ros_f3d.so'><bodyName>lo</bodyName></plugin>",
    ],
)
def test_a_missing_link_is_reported(load: Callable[..., Simulation], plugin: str) -> None:
    sim = load(f"<robot name='r'>{LINK}<gazebo>{plugin}</gazebo></robot>", world=None)
    (found,) = sim.diagnostics.by_code("plugin.missing-link")
    assert "plug-in 'p' needs link 'lo', which model 'r' does not have" in found.message


@pytest.mark.parametrize(
    "plugin",
    [
        "<plugin name='p' filename='libgazebo_ros_diff_drive.so'><leftJoint>j</leftJoint></plugin>",
        "<plugin name='p' filename='libgazebo_ros_joint_state_publisher.so'>"
        "<jointName>j</jointName></plugin>",
        "<plugin name='p' filename='libgazebo_ros_ft_sensor.so'><jointName>j</jointName>"
        "<topicName>t</topicName></plugin>",
        "<plugin name='p' filename='gz-sim-diff-drive-system'><left_joint>j</left_joint>"
        "<right_joint>j</right_joint></plugin>",
    ],
)
def test_a_missing_joint_is_reported(load: Callable[..., Simulation], plugin: str) -> None:
    sim = load(f"<robot name='r'>{LINK}<gazebo>{plugin}</gazebo></robot>", world=None)
    found = sim.diagnostics.by_code("plugin.missing-joint")
    assert any("needs joint 'j', which model 'r' does not have" in item.message for item in found)
    sim.run(seconds=0.05)


def test_a_sensor_kind_that_is_not_simulated_is_reported(load: Callable[..., Simulation]) -> None:
    sensor = "<gazebo reference='l'><sensor name='s' type='logical_camera'/></gazebo>"
    sim = load(f"<robot name='r'>{LINK}{sensor}</robot>", world=None)
    (found,) = sim.diagnostics.by_code("simulator.sensor-not-simulated")
    assert "sensor 'r::l::s' is of type 'logical_camera', which is not simulated" in found.message


@pytest.mark.parametrize("filename", NAMED_TABLE.parameters.types)
def test_a_plug_in_known_by_name_says_what_does_not_happen(
    load: Callable[..., Simulation], filename: str
) -> None:
    plugin = f"<gazebo><plugin name='p' filename='lib{filename}.so'/></gazebo>"
    sim = load(f"<robot name='r'>{LINK}{plugin}</robot>", world=None)
    (found,) = sim.diagnostics.by_code("plugin.named-only")
    assert f"plug-in 'p' (lib{filename}.so): " in found.message
    assert not sim.diagnostics.by_code("plugin.unknown")


@pytest.mark.parametrize("filename", NOTHING_TABLE.parameters.types)
def test_a_library_that_does_nothing_is_a_remark(
    load: Callable[..., Simulation], filename: str
) -> None:
    plugin = f"<gazebo><plugin name='p' filename='lib{filename}.so'/></gazebo>"
    sim = load(f"<robot name='r'>{LINK}{plugin}</robot>", world=None)
    (found,) = sim.diagnostics.by_code("plugin.without-effect")
    assert found.severity is Severity.INFO


@pytest.mark.parametrize("name", ["contactPlugin", "gazebo_ros_imu", "elevatorPlugin"])
def test_what_a_user_calls_a_library_does_not_say_what_it_is(
    load: Callable[..., Simulation], name: str
) -> None:
    plugin = f"<gazebo><plugin name='{name}' filename='libshopFoot{name}.so'/></gazebo>"
    sim = load(f"<robot name='r'>{LINK}{plugin}</robot>", world=None)
    (found,) = (item for item in sim.diagnostics if item.code.startswith("plugin."))
    assert found.code == "plugin.unknown"
    assert "did you mean" not in found.fix
