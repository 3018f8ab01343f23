from __future__ import annotations

from pathlib import Path

import pytest
from tests.shared_files import needs_shared

from gazelle.description.loader import TEXT_NAME, load_models, load_world
from gazelle.description.model import CameraSpec, LidarSpec, Model
from gazelle.diagnostics import Diagnostics, Severity
from gazelle.errors import UserFileError
from gazelle.workspace import Workspace

INERTIAL = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
)
URDF = f'<robot name="r"><link name="a">{INERTIAL}</link></robot>'
XACRO = (
    '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '<xacro:arg name="link" default="a"/>\n'
    f'<xacro:macro name="body" params="n">\n<link name="${{n}}">{INERTIAL}</link>\n</xacro:macro>\n'
    '<xacro:body n="$(arg link)"/>\n</robot>'
)
SDF = '<sdf version="1.7"><model name="m"><link name="l"/></model></sdf>'
WORLD = f'<sdf version="1.7"><world name="w">{SDF[SDF.index("<model") : -6]}</world></sdf>'


def _load(source: object, workspace: Workspace | None = None, **options):
    diagnostics = Diagnostics()
    models = load_models(source, workspace=workspace, diagnostics=diagnostics, **options)
    return models, diagnostics


@pytest.mark.parametrize(("text", "name"), [(URDF, "r"), (f"\n {SDF}", "m"), (WORLD, "m")])
def test_text_is_recognised_by_its_root(text: str, name: str) -> None:
    (model,), diagnostics = _load(text)
    assert model.name == name
    assert not list(diagnostics)
    assert model.file is None


def test_text_is_called_robot_description() -> None:
    _, diagnostics = _load('<robot name="r"><link name="a"/><link name="a"/></robot>')
    assert {item.span.file for item in diagnostics} == {TEXT_NAME}


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.urdf", URDF),
        ("a.xml", XACRO),
        ("a.xacro", XACRO),
        ("robot", URDF),
        ("a.xacro.urdf", URDF.replace('"a"', '"$(optenv NOTHING a)"')),
    ],
)
def test_file_is_recognised_by_its_content(name: str, text: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    (model,), diagnostics = _load(tmp_path / name)
    assert (model.name, model.links[0].name, model.file) == ("r", "a", tmp_path / name)
    assert not list(diagnostics)


def test_mappings_reach_xacro(tmp_path: Path) -> None:
    (tmp_path / "a.xacro").write_text(XACRO, encoding="utf-8")
    (model,), _ = _load(tmp_path / "a.xacro", mappings={"link": "b"})
    assert model.links[0].name == "b"


def test_places_in_an_expanded_robot_are_those_of_the_xacro_file(tmp_path: Path) -> None:
    path = tmp_path / "a.xacro"
    path.write_text(XACRO.replace('ixx="1"', 'ixx="bad"'), encoding="utf-8")
    _, diagnostics = _load(path)
    (error,) = diagnostics.by_code("xml.bad-number")
    assert (error.span.file, error.span.line) == (str(path), 4)
    assert [(item.file, item.line) for item in error.span.via] == [(str(path), 6)]


def test_model_folder_name_and_uri(tmp_path: Path) -> None:
    folder = tmp_path / "thing"
    folder.mkdir()
    (folder / "model.sdf").write_text(SDF, encoding="utf-8")
    (folder / "model.config").write_text(
        '<model><name>thing</name><sdf version="1.7">model.sdf</sdf></model>', encoding="utf-8"
    )
    workspace = Workspace.discover(environ={"GAZEBO_MODEL_PATH": str(tmp_path)}, cwd=tmp_path)
    for source in (folder, folder / "model.config", "thing", "model://thing"):
        (model,), diagnostics = _load(source, workspace)
        assert model.name == "m"
        assert not list(diagnostics)


def test_missing_file_says_where_it_was_looked_for(tmp_path: Path) -> None:
    models, diagnostics = _load(tmp_path / "gone.urdf")
    assert models == ()
    (error,) = diagnostics
    assert error.code == "load.not-found"
    assert "not found" in error.message
    assert str(tmp_path / "gone.urdf") in error.message


def test_foreign_xml_is_refused_with_its_root() -> None:
    models, diagnostics = _load("<launch/>")
    assert models == ()
    (error,) = diagnostics
    assert error.code == "load.unknown-format"
    assert "is <launch>" in error.message


def test_sdf_without_a_model_is_an_error() -> None:
    models, diagnostics = _load('<sdf version="1.7"><world name="w"/></sdf>')
    assert models == ()
    assert [item.code for item in diagnostics.errors] == ["load.nothing"]


@pytest.mark.parametrize("text", [URDF, SDF, WORLD])
def test_everything_can_be_a_world(text: str, tmp_path: Path) -> None:
    (tmp_path / "file").write_text(text, encoding="utf-8")
    for source in (text, tmp_path / "file"):
        world = load_world(source, workspace=None, diagnostics=Diagnostics())
        assert len(world.models) == 1


def test_world_by_name_comes_from_the_built_in_ones(tmp_path: Path) -> None:
    workspace = Workspace.discover(environ={}, cwd=tmp_path)
    diagnostics = Diagnostics()
    world = load_world("worlds/empty.world", workspace=workspace, diagnostics=diagnostics)
    assert not diagnostics.errors
    assert [model.name for model in world.models] == ["ground_plane"]


def test_missing_world_raises_with_all_findings(tmp_path: Path) -> None:
    workspace = Workspace.discover(environ={}, cwd=tmp_path)
    for source, words in (
        ("gone.world", "world 'gone.world' not found"),
        ("<launch/>", "<launch>"),
    ):
        with pytest.raises(UserFileError, match=words):
            load_world(source, workspace=workspace, diagnostics=Diagnostics())


def _workspace(root: Path) -> Workspace:
    places = [str(root / name / "src") for name in ("catkin_ws", "ros2_ws", "turtlebot3_ws")]
    models = str(root / "gazebo_models")
    environ = {"ROS_PACKAGE_PATH": ":".join(places), "GAZEBO_MODEL_PATH": models}
    return Workspace.discover(environ=environ, cwd=root / "catkin_ws")


def _load_sample(relative: str, root: Path) -> tuple[Model, Diagnostics]:
    (model,), diagnostics = _load(root / relative, _workspace(root))
    return model, diagnostics


EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize(
    ("relative", "links", "joints", "sensors"),
    [
        ("arm_ws/src/heron_description/urdf/heron.urdf.xacro", 11, 11, 0),
        ("four_wheel_ws/src/courier_robot/urdf/courier.urdf.xacro", 6, 5, 0),
        ("pr2_style_ws/src/tandem_controller/urdf/robot.xml", 3, 2, 0),
        ("scout_ws/src/scout_robot/urdf/scout.urdf.xacro", 10, 9, 3),
    ],
)
def test_robots_of_the_examples_read_without_errors(
    relative: str, links: int, joints: int, sensors: int
) -> None:
    model, diagnostics = _load_example(relative)
    assert (len(model.links), len(model.joints)) == (links, joints)
    assert sum(len(link.sensors) for link in model.links) == sensors
    assert {item.code for item in diagnostics} <= {"urdf.old-controller"}


def test_scout_facts() -> None:
    model, _ = _load_example("scout_ws/src/scout_robot/urdf/scout.urdf.xacro")
    assert model.canonical_link == "base_footprint"
    assert model.link("base_footprint").inertial is None
    assert model.link("base_link").inertial.mass_kg == 3.0
    assert model.link("left_wheel_link").inertial.inertia_kg_m2[5] == pytest.approx(0.00025)
    assert model.joint("left_wheel_joint").axis.xyz == (0.0, 0.0, 1.0)
    (camera,) = model.link("camera_link").sensors
    (lidar,) = model.link("lidar_link").sensors
    assert isinstance(camera.spec, CameraSpec)
    assert (camera.type, camera.update_rate_hz, camera.spec.width_px) == ("depth", 15.0, 320)
    assert isinstance(lidar.spec, LidarSpec)
    assert (lidar.spec.samples, lidar.spec.range_max_m, lidar.update_rate_hz) == (360, 10.0, 10.0)
    assert lidar.plugins[0].filename == "libgazebo_ros_laser.so"
    (drive,) = model.plugins
    assert drive.filename == "libgazebo_ros_diff_drive.so"
    assert drive.parameters.text_of("wheelSeparation") == "0.28"


def test_courier_facts() -> None:
    model, _ = _load_example("four_wheel_ws/src/courier_robot/urdf/courier.urdf.xacro")
    swivel = model.joint("head_swivel").axis
    assert (swivel.effort, swivel.velocity) == (3.0, 2.0)
    surface = model.link("left_back_wheel").collisions[0].surface
    assert (surface.mu1, surface.mu2) == (1.0, 0.6)
    assert model.link("left_back_wheel").visuals[0].material.name == "Gazebo/DarkGrey"
    assert [item.type for item in model.transmissions] == [
        "transmission_interface/SimpleTransmission"
    ] * 5
    assert model.plugins[0].parameters.text_of("robotNamespace") == "/"


def test_heron_keeps_its_ros2_control_block() -> None:
    model, _ = _load_example("arm_ws/src/heron_description/urdf/heron.urdf.xacro")
    (control,) = model.ros2_controls
    assert control.element.text_of("hardware", "plugin") == "gazebo_ros2_control/GazeboSystem"
    assert [item.attributes["name"] for item in control.element.find_all("joint")] == [
        *(f"joint_{number}" for number in range(1, 7)),
        "finger_joint",
    ]


def _load_example(relative: str) -> tuple[Model, Diagnostics]:
    file = EXAMPLES / relative
    (model,), diagnostics = _load(file, Workspace.discover(environ={}, cwd=file.parent))
    return model, diagnostics


@needs_shared
@pytest.mark.tutorial
@pytest.mark.parametrize(
    ("relative", "links", "joints", "sensors"),
    [
        ("catkin_ws/src/slam_robot/urdf/slam_robot_gazebo.urdf", 10, 9, 2),
        ("catkin_ws/src/urdf_exam/urdf/mira_gazebo.urdf", 7, 6, 0),
        ("catkin_ws/src/urdf_exam/urdf/mira_gazebo_controller.urdf", 7, 6, 0),
        ("catkin_ws/src/urdf_exam/urdf/mira_gazebo_camera.urdf", 8, 7, 1),
        ("catkin_ws/src/urdf_tutorial/urdf/mobile_robot.urdf", 4, 3, 0),
        ("catkin_ws/src/urdf_tutorial/urdf/mobile_robot.urdf.xacro", 4, 3, 0),
        ("catkin_ws/src/urdf_tutorial/urdf/mobile_robot_stl.urdf", 1, 0, 0),
        ("catkin_ws/src/urdf_tutorial/urdf/mobile_robot_visual.urdf", 4, 3, 0),
        ("catkin_ws/src/tutorial_controller/robot.xml", 3, 2, 0),
        ("ros2_ws/src/luck_description/urdf/luck_description.urdf", 7, 7, 0),
        ("ros2_ws/src/luck_robot/config/luck_description.urdf.xacro", 7, 7, 0),
        *(
            (f"{TB3}/turtlebot3_{name}.urdf.xacro", *counts)
            for TB3 in ["turtlebot3_ws/src/turtlebot3/turtlebot3_description/urdf"]
            for name, counts in (
                ("burger", (7, 6, 2)),
                ("waffle", (13, 12, 3)),
                ("waffle_pi", (11, 10, 3)),
            )
        ),
    ],
)
def test_sample_robots_read_without_errors(
    relative: str, links: int, joints: int, sensors: int, workspaces_dir: Path
) -> None:
    model, diagnostics = _load_sample(relative, workspaces_dir)
    assert (len(model.links), len(model.joints)) == (links, joints)
    assert sum(len(link.sensors) for link in model.links) == sensors
    expected = {
        "urdf.gazebo-no-collision",
        "urdf.no-inertia",
        "urdf.old-controller",
        "xacro.warning",
    }
    assert {item.code for item in diagnostics} <= expected
    assert diagnostics.worst is None or diagnostics.worst < Severity.ERROR


@needs_shared
@pytest.mark.tutorial
def test_slambot_facts(workspaces_dir: Path) -> None:
    model, diagnostics = _load_sample(
        "catkin_ws/src/slam_robot/urdf/slam_robot_gazebo.urdf", workspaces_dir
    )
    assert not list(diagnostics)
    assert model.canonical_link == "base_footprint"
    assert model.link("base_footprint").inertial is None
    assert model.link("base_link").inertial.mass_kg == 20.8233150515763
    assert model.link("left_wheel_link").inertial.mass_kg == 0.317051102258936
    assert model.link("depth_camera_link").T_model_link.position_m == pytest.approx((0, 0, 1.175))
    assert model.joint("right_wheel_joint").axis.xyz == (0.0, 0.0, -1.0)
    assert model.link("base_link").visuals[0].material.name == "Gazebo/Grey"
    (camera,) = model.link("depth_camera_link").sensors
    (lidar,) = model.link("laser_radar_link").sensors
    assert isinstance(camera.spec, CameraSpec)
    assert (camera.type, camera.update_rate_hz, camera.spec.width_px) == ("depth", 20.0, 640)
    assert isinstance(lidar.spec, LidarSpec)
    assert (lidar.spec.samples, lidar.spec.range_max_m, lidar.update_rate_hz) == (360, 6.0, 5.5)
    assert lidar.plugins[0].filename == "libgazebo_ros_laser.so"
    (drive,) = model.plugins
    assert drive.filename == "libgazebo_ros_diff_drive.so"
    assert drive.parameters.text_of("legacyMode") == "true"
    assert [item.joints[0].name for item in model.transmissions] == [
        "left_wheel_joint",
        "right_wheel_joint",
    ]


@needs_shared
@pytest.mark.tutorial
def test_mira_facts(workspaces_dir: Path) -> None:
    model, _ = _load_sample(
        "catkin_ws/src/urdf_exam/urdf/mira_gazebo_controller.urdf", workspaces_dir
    )
    roll, pitch, yaw = (model.joint(f"{name}_joint").axis for name in ("roll", "pitch", "yaw"))
    assert (roll.lower, roll.upper, roll.effort, roll.velocity) == (-0.2, 0.2, 0.1, 0.005)
    assert (pitch.lower, pitch.upper) == (0.0, 0.44)
    assert (yaw.effort, yaw.velocity) == (0.1, 0.01)
    surface = model.link("head_link").collisions[0].surface
    assert (surface.mu1, surface.mu2, surface.kp, surface.kd) == (10.0, 10.0, 1e5, 1e5)
    assert model.link("base_link").collisions[0].surface.mu1 is None
    assert [item.type for item in model.transmissions] == [
        "transmission_interface/SimpleTransmission"
    ] * 3
    assert model.plugins[0].parameters.text_of("robotNamespace") == "/mira"


@needs_shared
@pytest.mark.tutorial
def test_luck_keeps_its_ros2_control_block(workspaces_dir: Path) -> None:
    model, _ = _load_sample(
        "ros2_ws/src/luck_robot/config/luck_description.urdf.xacro", workspaces_dir
    )
    (control,) = model.ros2_controls
    assert control.element.text_of("hardware", "plugin") == "gazebo_ros2_control/GazeboSystem"
    assert len(control.element.find_all("joint")) == 6


def test_equal_findings_of_a_file_are_said_once() -> None:
    bare = "".join(
        f'<link name="l{index}"/><joint name="j{index}" type="continuous"><parent link="a"/>'
        f'<child link="l{index}"/></joint>'
        for index in range(6)
    )
    (_model,), diagnostics = _load(URDF.replace("</robot>", f"{bare}</robot>"))
    (finding,) = diagnostics.by_code("urdf.no-inertia")
    assert "the same 5 more times: 'l1'" in finding.message


def test_sdf_of_2012_is_brought_to_a_version_that_is_read() -> None:
    models, diagnostics = _load(
        "<gazebo version='1.2'><model name='m'><link name='l'/></model></gazebo>"
    )
    assert [model.name for model in models] == ["m"]
    (finding,) = diagnostics
    assert finding.code == "sdf.version"
