"""New packages: what is written is read without a word by our own readers."""

from __future__ import annotations

import ast
import os
import re
from collections import Counter
from pathlib import Path

import pytest

from gazelle import Simulation
from gazelle.description.loader import load_models, load_world
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import (
    box_mass_properties,
    cylinder_mass_properties,
    sphere_mass_properties,
)
from gazelle.interfaces import message_type
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.sensors.view_overlays import equivalent_box
from gazelle.workspace import Workspace
from gazelle.workspace.scaffold import KINDS, ScaffoldError, check_package_name, create_package
from gazelle.workspace.scaffold.create_package import FILES

EVERY = [(kind, ros_version) for kind in KINDS for ros_version in (1, 2)]


def _workspace(folder: Path) -> Workspace:
    return Workspace.discover(environ={}, cwd=folder)


@pytest.mark.parametrize(("kind", "ros_version"), EVERY)
def test_every_kind_is_a_package_of_its_generation(
    tmp_path: Path, kind: str, ros_version: int
) -> None:
    written = create_package(kind, "my_thing", tmp_path, ros_version=ros_version)
    assert all(path.is_file() for path in written)
    assert len(written) == len(FILES[kind, ros_version])
    workspace = _workspace(tmp_path)
    package = workspace.package("my_thing")
    assert package.path == tmp_path / "my_thing"
    assert package.ros_version == ros_version
    assert package.format == ros_version + 1
    assert package.build_type == ("catkin" if ros_version == 1 else "ament_python")
    assert not list(workspace.diagnostics)


@pytest.mark.parametrize(("kind", "ros_version"), EVERY)
def test_no_placeholder_is_left_and_python_is_well_formed(
    tmp_path: Path, kind: str, ros_version: int
) -> None:
    for path in create_package(kind, "my_thing", tmp_path, ros_version=ros_version):
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"@\w+@", f"{path} {text}"), path
        if path.suffix == ".py":
            ast.parse(text)
        assert os.access(path, os.X_OK) == text.startswith("#!")


@pytest.mark.parametrize("ros_version", [1, 2])
def test_robot_and_world_are_read_without_findings(tmp_path: Path, ros_version: int) -> None:
    create_package("robot", "my_bot", tmp_path, ros_version=ros_version)
    workspace, found = _workspace(tmp_path), Diagnostics()
    folder = tmp_path / "my_bot"
    (robot,) = load_models(
        folder / "urdf" / "my_bot.urdf.xacro", workspace=workspace, diagnostics=found
    )
    world = load_world(folder / "worlds" / "my_bot.world", workspace=workspace, diagnostics=found)
    assert not list(found)
    assert robot.name == "my_bot"
    assert [sensor.type for link in robot.links for sensor in link.sensors] == [
        "ray",
        "camera",
        "imu",
    ]
    assert robot.plugins[0].filename == "libgazebo_ros_diff_drive.so"
    assert {model.name for model in world.models} == {"ground_plane", "walls", "crate", "pillar"}


def test_inertias_are_those_of_the_shapes(tmp_path: Path) -> None:
    create_package("robot", "my_bot", tmp_path)
    (robot,) = load_models(
        tmp_path / "my_bot" / "urdf" / "my_bot.urdf.xacro",
        workspace=_workspace(tmp_path),
        diagnostics=Diagnostics(),
    )
    expected = {
        "base_link": box_mass_properties(3.0, (0.30, 0.20, 0.08)),
        "camera_link": box_mass_properties(0.05, (0.02, 0.06, 0.02)),
        "left_wheel_link": cylinder_mass_properties(0.3, 0.05, 0.03),
        "right_wheel_link": cylinder_mass_properties(0.3, 0.05, 0.03),
        "lidar_link": cylinder_mass_properties(0.15, 0.035, 0.04),
        "caster_link": sphere_mass_properties(0.1, 0.02),
    }
    for name, wanted in expected.items():
        link = robot.link(name)
        assert link is not None
        assert link.inertial is not None
        assert link.inertial.inertia_kg_m2 == pytest.approx(wanted.inertia_kg_m2, rel=1e-9)
        assert equivalent_box(link.inertial) is not None
    crate = load_world(
        tmp_path / "my_bot" / "worlds" / "my_bot.world",
        workspace=_workspace(tmp_path),
        diagnostics=Diagnostics(),
    ).model("crate")
    assert crate is not None
    assert crate.links[0].inertial is not None
    solid = box_mass_properties(5.0, (0.4, 0.4, 0.4)).inertia_kg_m2
    assert crate.links[0].inertial.inertia_kg_m2 == pytest.approx(solid, rel=1e-4)


@pytest.mark.parametrize("ros_version", [1, 2])
def test_robot_of_either_generation_drives_and_senses(tmp_path: Path, ros_version: int) -> None:
    create_package("robot", "my_bot", tmp_path, ros_version=ros_version)
    folder, counts = tmp_path / "my_bot", Counter[str]()
    with Simulation.load(
        folder / "urdf" / "my_bot.urdf.xacro", world=folder / "worlds" / "my_bot.world"
    ) as sim:
        for topic in ("/scan", "/odom", "/imu", "/joint_states", "/camera/image_raw"):
            sim.subscribe(topic, lambda _, topic=topic: counts.update([topic]))
        command = message_type("geometry_msgs/Twist")()
        command.linear.x = 0.3
        sim.publish("/cmd_vel", command)
        sim.run(seconds=2.0)
        # v t − v² / (2 a) with a = 2 m/s², less a period of the drive and some slip.
        x, y, z = sim.model("my_bot").pose.position_m
        assert (x, y, z) == pytest.approx((0.5775, 0.0, 0.0), abs=0.015)
        assert {item.severity.name for item in sim.diagnostics} <= {"INFO"}
    rates = {"/scan": 10, "/odom": 50, "/imu": 100, "/joint_states": 50, "/camera/image_raw": 15}
    assert {topic: counts[topic] / 2.0 for topic in rates} == pytest.approx(rates, abs=1.0)


@pytest.mark.parametrize("kind", KINDS)
def test_launch_files_are_read_without_findings(tmp_path: Path, kind: str) -> None:
    create_package(kind, "my_thing", tmp_path)
    found = Diagnostics()
    file = tmp_path / "my_thing" / "launch" / "my_thing.launch"
    config = load_launch_files([file], {}, workspace=_workspace(tmp_path), diagnostics=found)
    assert not list(found)
    assert config.nodes


@pytest.mark.tutorial
def test_new_robot_starts_and_drives(gazelle, tmp_path: Path) -> None:
    create_package("robot", "my_bot", tmp_path / "src")
    run = gazelle("roslaunch", "my_bot", "my_bot.launch")
    run.wait_for_line("Successfully spawned entity", 180.0)
    odometry = run.messages({"/odom": 60, "/scan": 5, "/joint_states": 5}, 180.0)
    # Ahead at its speed, or turning at its rate when a slow machine let it reach a wall.
    twist = odometry["/odom"][-1].twist.twist
    assert max(twist.linear.x / 0.3, twist.angular.z / 0.8) == pytest.approx(1.0, abs=0.15)
    assert len(odometry["/scan"][0].ranges) == 360
    assert set(odometry["/joint_states"][0].name) == {"left_wheel_joint", "right_wheel_joint"}
    run.stop()
    assert "WARN" not in run.text
    assert "warning" not in run.text
    assert "error" not in run.text.lower()


@pytest.mark.tutorial
def test_new_world_starts(gazelle, tmp_path: Path) -> None:
    create_package("world", "my_world", tmp_path / "src")
    run = gazelle("roslaunch", "my_world", "my_world.launch")
    states = run.messages({"/gazebo/model_states": 1}, 60.0)["/gazebo/model_states"][0]
    assert set(states.name) == {"ground_plane", "walls", "crate", "pillar"}
    run.stop()
    assert "warning" not in run.text


@pytest.mark.tutorial
def test_new_package_says_hello(gazelle, tmp_path: Path) -> None:
    create_package("package", "my_node", tmp_path / "src")
    run = gazelle("roslaunch", "my_node", "my_node.launch")
    run.wait_for_line("hello 2", 60.0)
    run.stop()
    assert "warning" not in run.text


@pytest.mark.tutorial
@pytest.mark.parametrize(
    ("kind", "node", "line"), [("package", "hello", "hello 2"), ("robot", "wander", "wandering")]
)
def test_nodes_of_new_ros2_packages_run(
    gazelle, tmp_path: Path, kind: str, node: str, line: str
) -> None:
    create_package(kind, "my_thing", tmp_path / "src", ros_version=2)
    gazelle("roscore")
    gazelle("rosrun", "my_thing", node).wait_for_line(line, 60.0)


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    (tmp_path / "my_bot" / "src").mkdir(parents=True)
    kept = tmp_path / "my_bot" / "src" / "main.cpp"
    kept.write_text("mine")
    with pytest.raises(
        ScaffoldError, match=r"is there already; nothing was written:\n    src/main"
    ):
        create_package("robot", "my_bot", tmp_path)
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == [kept]
    kept.unlink()
    assert create_package("robot", "my_bot", tmp_path)
    (tmp_path / "my_file").write_text("")
    with pytest.raises(ScaffoldError, match="is a file; nothing was written"):
        create_package("robot", "my_file", tmp_path)


@pytest.mark.parametrize("name", ["my_bot", "ab", "robot2", "a1_b2"])
def test_names_of_rep_144_are_accepted(name: str) -> None:
    check_package_name(name)


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("My-Bot", "; 'my_bot' would do"),
        ("2wheels", "; 'wheels' would do"),
        ("my__bot", "; 'my_bot' would do"),
        ("_bot", "; 'bot' would do"),
        ("../bot", "; 'bot' would do"),
        ("a", "(REP 144)"),
        ("", "(REP 144)"),
    ],
)
def test_other_names_are_refused_with_one_that_would_do(name: str, hint: str) -> None:
    with pytest.raises(ScaffoldError, match="is no name for a package") as caught:
        check_package_name(name)
    assert str(caught.value).endswith(hint)


def test_words_of_python_are_no_names() -> None:
    with pytest.raises(ScaffoldError, match="'import' is a word of Python's"):
        check_package_name("import")


def test_templates_are_all_used_and_all_there() -> None:
    from gazelle.workspace import scaffold

    folder = Path(scaffold.__file__).parent / "templates"
    there = {
        path.relative_to(folder).as_posix().removesuffix(".in")
        for path in folder.rglob("*")
        if path.is_file()
    }
    assert there == {template for files in FILES.values() for template in files.values()}
