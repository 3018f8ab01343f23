"""SDF said in URDF: the same bodies, shapes and motion, and everything lost is named."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.description.writers.conftest import OWN_ROS1
from tests.shared_files import SHARED, shared_cases

from gazelle.description.forward_kinematics import posed_model
from gazelle.description.sdformat_emulation import Release
from gazelle.description.writers import OutputFiles, to_urdf
from gazelle.description.writers.single_axis_joints import CARRIER_SHARE
from gazelle.diagnostics import Diagnostics

YARD = OWN_ROS1 / "src/yard_gazebo"
SAMPLES = SHARED / "workspaces/gazebo_models"
INERTIAL = (
    "<inertial><pose>0.01 0.02 0.03 0.1 0 0</pose><mass>2</mass><inertia><ixx>0.02</ixx>"
    "<iyy>0.03</iyy><izz>0.04</izz></inertia></inertial>"
)
BOX = "<geometry><box><size>0.1 0.2 0.3</size></box></geometry>"


def link(name: str, inside: str = "", pose: str = "0 0 0 0 0 0") -> str:
    return f'<link name="{name}"><pose>{pose}</pose>{INERTIAL}{inside}</link>'


def shape(name: str, geometry: str = BOX, inside: str = "", word: str = "collision") -> str:
    return f'<{word} name="{name}">{geometry}{inside}</{word}>'


def joint(name: str, kind: str, parent: str, child: str, inside: str = "") -> str:
    ends = f"<parent>{parent}</parent><child>{child}</child>"
    return f'<joint name="{name}" type="{kind}">{ends}{inside}</joint>'


def axis(xyz: str, inside: str = "", word: str = "axis") -> str:
    return f"<{word}><xyz>{xyz}</xyz>{inside}</{word}>"


def sdf(*parts: str) -> str:
    return f'<sdf version="1.9"><model name="m">{"".join(parts)}</model></sdf>'


@pytest.fixture
def convert(reading, tmp_path):
    """Converts SDF; returns the model read, the one of the URDF, and the findings."""

    def run(text: str):
        model = reading.model(text)
        found = Diagnostics()
        converted = to_urdf(model, diagnostics=found, output_files=OutputFiles(tmp_path, "robot"))
        for name, data in converted.files.items():
            (tmp_path / name).parent.mkdir(exist_ok=True)
            (tmp_path / name).write_bytes(data)
        return model, reading.model(converted.text), found, converted.text

    return run


def codes(found: Diagnostics) -> list[str]:
    return [item.code for item in found]


TWO = sdf(
    link("a", shape("ca"), "0.1 0 0.5 0 0 0.3"),
    link("b", shape("cb") + shape("vb", word="visual"), "0.4 0.2 0.5 1.5707963267948966 0.2 0.1"),
    joint(
        "j",
        "revolute",
        "a",
        "b",
        "<pose>0.05 0.06 0.07 0.4 1.5707963267948966 0.2</pose>"
        + axis("1 2 3", "<limit><lower>-1</lower><upper>2</upper><effort>3</effort></limit>"),
    ),
)


def test_shapes_masses_and_motion_are_the_same_in_the_world(convert, reading) -> None:
    model, again, _, _ = convert(TWO)
    for one, other in zip(reading.total(model), reading.total(again), strict=True):
        assert np.allclose(one, other, atol=1e-9)
    for seed in range(5):
        positions = reading.random_positions(model, seed)
        first, second = reading.shapes(model, positions), reading.shapes(again, positions)
        assert first.keys() == second.keys()
        for name, matrix in first.items():
            assert np.allclose(matrix, second[name], atol=1e-9), name


def test_moved_link_frame_is_told(convert) -> None:
    _, again, found, text = convert(TWO)
    assert again.link("b").T_model_link == again.joint("j").T_model_joint
    [item] = found.by_code("convert.approximated")
    assert "the frame of link 'b' is at joint 'j' now" in item.message
    assert item.span.line == 1
    assert "Said differently" in text


def test_sdformat_turns_the_urdf_back_into_the_same_bodies(convert, reading) -> None:
    from gazelle.description.sdformat_emulation.gz_sdf_command import read_document, to_text

    model, again, _, text = convert(TWO)
    document = read_document(text, release=Release.V12, file="r.urdf", find=lambda _word: None)
    assert document.root is not None
    back = reading.model(to_text(document.root, Release.V12))
    for one, other in zip(reading.total(model), reading.total(back), strict=True):
        assert np.allclose(one, other, atol=1e-6)
    world_axis = [
        m.T_world_model.rotate(m.joint("j").T_model_joint.rotate(m.joint("j").axis.xyz))
        for m in (model, back)
    ]
    assert np.allclose(*world_axis, atol=1e-6)
    for angle in (-0.9, 0.4, 1.7):
        one, other = (
            (m.T_world_model @ posed_model(m, {"j": angle}).link("b").T_model_link).matrix()
            for m in (again, back)
        )
        assert np.allclose(one, other, atol=1e-6)


@pytest.mark.parametrize(
    "file",
    [
        YARD / "models/barrow/model.sdf",
        YARD / "stages/barrow_7.sdf",
        *shared_cases(SAMPLES / "my_robot/model.sdf", SAMPLES / "stages/my_robot_7.sdf"),
    ],
    ids=lambda file: file.stem,
)
def test_robots_of_the_documents_keep_shapes_and_mass(file, reading, workspace) -> None:
    model = reading.model(file, workspace)
    again = reading.model(to_urdf(model, diagnostics=Diagnostics()).text, workspace)
    for one, other in zip(reading.total(model), reading.total(again), strict=True):
        assert np.allclose(one, other, atol=1e-9)
    positions = reading.random_positions(model, 3)
    first, second = reading.shapes(model, positions), reading.shapes(again, positions)
    assert all(np.allclose(first[key], second[key], atol=1e-9) for key in first)


def test_castor_without_friction_keeps_its_own_surface(convert) -> None:
    slick = "<surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface>"
    model, again, found, _ = convert(sdf(link("a", shape("box") + shape("castor", inside=slick))))
    extra = again.link("a_castor")
    assert extra.collisions[0].surface.mu1 == 0.0
    assert again.link("a").collisions[0].surface.mu1 is None
    assert extra.inertial is None
    assert "on a link of its own, 'a_castor'" in next(iter(found)).message
    assert model.link("a").inertial.mass_kg == again.link("a").inertial.mass_kg


def test_joint_limits_dynamics_springs_and_softness_come_over(convert, reading) -> None:
    inside = axis(
        "0 1 0",
        "<limit><lower>-1</lower><upper>1</upper><effort>5</effort><velocity>2</velocity></limit>"
        "<dynamics><damping>0.1</damping><friction>0.2</friction><spring_stiffness>3"
        "</spring_stiffness><spring_reference>0.4</spring_reference></dynamics>",
    ) + (
        "<physics><ode><cfm>0.01</cfm><limit><cfm>0.02</cfm><erp>0.3</erp></limit></ode>"
        "<provide_feedback>true</provide_feedback></physics>"
    )
    model, again, found, _ = convert(
        sdf(link("a"), link("b"), joint("j", "revolute", "a", "b", inside))
    )
    without_thread = replace(again.joint("j"), thread_pitch_rad_m=2 * math.pi)
    assert reading.differences(model.joint("j"), without_thread) == []
    assert codes(found) == []


def test_unlimited_revolute_joint_is_continuous_and_slides_have_no_limit(convert) -> None:
    _, again, _, text = convert(
        sdf(
            link("a"),
            link("b"),
            link("c"),
            joint("turn", "revolute", "a", "b", axis("0 0 1")),
            joint("slide", "prismatic", "a", "c", axis("1 0 0")),
        )
    )
    assert 'name="turn" type="continuous"' in text
    assert again.joint("slide").axis.upper == 1e16
    assert again.joint("slide").axis.lower == -1e16


def test_universal_joint_is_two_joints_and_keeps_the_mass(convert, reading) -> None:
    model, again, found, _ = convert(
        sdf(
            link("a"),
            link("b"),
            joint("u", "universal", "a", "b", axis("1 0 0") + axis("0 1 0", word="axis2")),
        )
    )
    assert [item.name for item in again.joints] == ["u", "u_axis2"]
    assert again.link("b").inertial.mass_kg == pytest.approx(2 * (1 - CARRIER_SHARE))
    for one, other in zip(reading.total(model), reading.total(again), strict=True):
        assert np.allclose(one, other, atol=1e-9)
    assert "type universal" in found.by_code("convert.approximated")[0].message
    turned = posed_model(again, {"u": 0.3, "u_axis2": 0.4}).link("b").T_model_link
    expected = _turn((1, 0, 0), 0.3) @ _turn((0, 1, 0), 0.4)
    assert np.allclose(turned.matrix()[:3, :3], expected, atol=1e-12)


def test_ball_joint_is_three_joints(convert) -> None:
    _, again, found, _ = convert(sdf(link("a"), link("b"), joint("j", "ball", "a", "b")))
    assert [item.name for item in again.joints] == ["j_x", "j_y", "j"]
    assert {item.type.value for item in again.joints} == {"continuous"}
    assert "'j_x', 'j_y', 'j'" in found.by_code("convert.approximated")[0].message


def test_screw_slides_as_it_turns(convert) -> None:
    pitch = "<thread_pitch>-4</thread_pitch>"
    model, again, _, _ = convert(
        sdf(link("a"), link("b"), joint("s", "screw", "a", "b", axis("0 0 1") + pitch))
    )
    assert model.joint("s").thread_pitch_rad_m == 4
    for angle in (-1.0, 0.5):
        one = posed_model(model, {"s": angle}).link("b").T_model_link.matrix()
        other = posed_model(again, {"s": angle}).link("b").T_model_link.matrix()
        assert np.allclose(one, other, atol=1e-12)


def test_gearbox_is_a_mimic_and_a_useless_one_is_told(convert) -> None:
    hinges = joint("one", "revolute", "a", "b", axis("0 0 1")) + joint(
        "two", "revolute", "a", "c", axis("0 0 -1")
    )
    gear = (
        axis("0 0 1")
        + axis("0 0 1", word="axis2")
        + ("<gearbox_ratio>3</gearbox_ratio><gearbox_reference_body>a</gearbox_reference_body>")
    )
    links = link("a") + link("b") + link("c")
    _, again, found, _ = convert(sdf(links, hinges, joint("gear", "gearbox", "b", "c", gear)))
    assert again.joint("two").mimic.joint == "one"
    assert again.joint("two").mimic.multiplier == 3.0
    assert "mimicking 'one' 3 times" in found.by_code("convert.approximated")[0].message
    _, again, found, _ = convert(sdf(links, joint("gear", "gearbox", "b", "c", gear)))
    assert "no turning joints" in found.by_code("convert.left-out")[0].message


def test_loop_is_left_out_and_told(convert) -> None:
    bars = "".join(link(name) for name in "abc")
    joints = [joint(f"j{p}{c}", "revolute", p, c, axis("0 0 1")) for p, c in ("ab", "bc", "ca")]
    _, again, found, text = convert(sdf(bars, *joints))
    assert [item.name for item in again.joints] == ["jab", "jbc"]
    [item] = found.by_code("convert.loop")
    assert "joint 'jca' between 'c' and 'a' closes a kinematic loop" in item.message
    assert "Not in this file" in text


def test_joint_towards_the_root_is_turned_round(convert) -> None:
    limit = "<limit><lower>-0.2</lower><upper>1</upper></limit>"
    model, again, found, _ = convert(
        sdf(
            link("a"),
            link("b", pose="1 0 0 0 0 0"),
            link("c", pose="0 1 0 0 0 0"),
            joint("ab", "revolute", "a", "b", axis("0 0 1")),
            joint("cb", "revolute", "c", "b", axis("1 0 0", limit)),
        )
    )
    turned = again.joint("cb")
    assert (turned.parent, turned.child) == ("b", "c")
    assert turned.axis.xyz == (-1.0, 0.0, 0.0)
    assert (turned.axis.lower, turned.axis.upper) == (-0.2, 1.0)
    assert "leads from 'b' to 'c' in URDF" in found.by_code("convert.approximated")[0].message
    assert model.joint("cb").parent == "c"


def test_links_that_nothing_joins_float(convert) -> None:
    _, again, found, _ = convert(sdf(link("a"), link("b", pose="1 0 0 0 0 0")))
    assert again.joint("b_floating").type.value == "floating"
    assert again.link("b").T_model_link.position_m == (1.0, 0.0, 0.0)
    assert "nothing joins link 'b' to 'a'" in next(iter(found)).message


def test_world_joint_gives_the_link_world(convert) -> None:
    _, again, _, text = convert(
        sdf(link("a", pose="0 0 1 0 0 0"), joint("hold", "fixed", "world", "a"))
    )
    assert '<link name="world"/>' in text
    assert again.joint("hold").parent == "world"
    assert again.link("a").T_model_link.position_m == (0.0, 0.0, 1.0)


def test_nested_names_lose_their_colons_everywhere(convert) -> None:
    inner = (
        f'<model name="arm"><pose>0 0 1 0 0 0</pose>{link("hand")}{link("tip")}'
        f"{joint('wrist', 'revolute', 'hand', 'tip', axis('0 0 1'))}"
        '<plugin name="p" filename="libp.so"><joint_name>wrist</joint_name></plugin></model>'
    )
    outer = '<plugin name="q" filename="libq.so"><link>arm::tip</link></plugin>'
    hold = joint("hold", "fixed", "a", "arm::hand")
    _, again, found, _ = convert(sdf(link("a"), inner, hold, outer))
    assert [item.name for item in again.links] == ["a", "arm_hand", "arm_tip"]
    assert again.joint("hold").child == "arm_hand"
    texts = {item.name: item.parameters.children[0].text for item in again.plugins}
    assert texts == {"p": "arm_wrist", "q": "arm_tip"}
    assert "'arm::hand' is 'arm_hand'" in found.by_code("convert.renamed")[0].message
    assert "nested model 'arm'" in found.by_code("convert.approximated")[-1].message


def test_frames_are_links_without_mass(convert) -> None:
    frame = '<frame name="tool" attached_to="a"><pose>0 0 0.5 0 0 1</pose></frame>'
    model, again, found, _ = convert(sdf(link("a"), frame))
    assert again.link("tool").inertial is None
    assert np.allclose(
        again.link("tool").T_model_link.matrix(), model.frames[0].T_model_frame.matrix()
    )
    assert codes(found) == []


def test_shapes_without_a_word_become_meshes_or_are_told(convert, tmp_path) -> None:
    def geometry(inside: str) -> str:
        return f"<geometry>{inside}</geometry>"

    shapes = [
        shape("egg", geometry("<ellipsoid><radii>0.1 0.2 0.3</radii></ellipsoid>")),
        shape("floor", geometry("<plane><normal>0 0 1</normal><size>2 2</size></plane>")),
        shape("pill", geometry("<capsule><radius>0.1</radius><length>0.4</length></capsule>")),
    ]
    _, again, found, _ = convert(sdf(link("a", "".join(shapes))))
    by_name = {item.name: item for item in again.link("a").collisions}
    assert set(by_name) == {"egg", "pill", "pill_top", "pill_bottom"}
    assert by_name["egg"].shape.path == tmp_path / "robot_files" / "a_egg.stl"
    assert by_name["pill_top"].T_link_collision.position_m == (0.0, 0.0, 0.2)
    from gazelle.geometry import load_mesh

    low, high = load_mesh(by_name["egg"].shape.path).bounds_m
    assert np.allclose([low, high], [(-0.1, -0.2, -0.3), (0.1, 0.2, 0.3)], atol=2e-3)
    [lost] = found.by_code("convert.left-out")
    assert "the plane of collision 'floor' of link 'a' is left out: URDF has none" in lost.message


def test_mesh_in_its_place_needs_a_folder(reading) -> None:
    cone = "<geometry><ellipsoid><radii>1 1 2</radii></ellipsoid></geometry>"
    found = Diagnostics()
    to_urdf(reading.model(sdf(link("a", shape("c", cone)))), diagnostics=found)
    assert "needs a file to be written beside" in found.by_code("convert.left-out")[0].message


def test_sensors_lights_flags_and_static_come_over(convert, reading) -> None:
    sensors = (
        '<sensor name="imu" type="imu"><pose>0 0 0.1 0 0 0.5</pose><update_rate>50</update_rate>'
        '<imu><angular_velocity><x><noise type="gaussian"><mean>0</mean><stddev>0.1</stddev>'
        "</noise></x></angular_velocity></imu></sensor>"
        '<sensor name="eye" type="depth"><camera name="c"><horizontal_fov>1.2</horizontal_fov>'
        "<image><width>64</width><height>48</height></image><clip><near>0.2</near><far>9</far>"
        "</clip><distortion><k1>0.1</k1></distortion></camera></sensor>"
        '<sensor name="touch" type="contact"><contact><collision>c</collision></contact></sensor>'
        '<sensor name="air" type="air_pressure"><air_pressure><reference_altitude>5'
        "</reference_altitude></air_pressure></sensor>"
        '<sensor name="where" type="gps"><gps><position_sensing><horizontal><noise '
        'type="gaussian"><mean>0</mean><stddev>1</stddev></noise></horizontal></position_sensing>'
        "</gps></sensor>"
        '<sensor name="alt" type="altimeter"/><sensor name="mag" type="magnetometer"/>'
        '<sensor name="near" type="sonar"/><sensor name="log" type="logical_camera"/>'
        '<light name="lamp" type="spot"><pose>0 0 1 0 0 0</pose><spot><inner_angle>0.1'
        "</inner_angle><outer_angle>0.5</outer_angle><falloff>1</falloff></spot></light>"
        "<gravity>false</gravity><self_collide>true</self_collide><kinematic>true</kinematic>"
        "<velocity_decay><linear>0.1</linear><angular>0.2</angular></velocity_decay>"
    )
    flags = "<static>true</static><self_collide>true</self_collide>"
    model, again, found, _ = convert(sdf(flags, link("a", shape("c") + sensors)))
    assert reading.differences(model.link("a"), again.link("a")) == []
    assert again.static
    assert again.self_collide
    assert codes(found) == []


def test_sensor_known_by_name_only_is_told(convert) -> None:
    _, _, found, _ = convert(sdf(link("a", '<sensor name="r" type="rfid"/>')))
    assert "'r' of type rfid is written without" in found.by_code("convert.left-out")[0].message


def test_looks_are_kept_and_what_differs_is_told(convert, reading) -> None:
    def visual(name: str, material: str, inside: str = "") -> str:
        return shape(name, BOX, f"<material>{material}</material>{inside}", "visual")

    script = "<script><name>Gazebo/Red</name></script>"
    rich = "<diffuse>0 1 0 1</diffuse><specular>1 1 1 1</specular>"
    thin = "<transparency>0.25</transparency>"
    model, again, found, _ = convert(sdf(link("a", visual("v", script, thin))))
    assert reading.differences(model.link("a"), again.link("a")) == []
    _, again, found, _ = convert(
        sdf(
            link(
                "a",
                visual("v", rich) + visual("w", script, thin + "<cast_shadows>0</cast_shadows>"),
            )
        )
    )
    messages = [item.message for item in found.by_code("convert.left-out")]
    assert any(
        "look different from each other: 'v', 'w' keep their diffuse colour" in m for m in messages
    )
    assert any("differ in cast_shadows" in m for m in messages)
    assert again.link("a").visuals[1].material.diffuse[3] == 0.75


def test_initial_position_is_told(convert) -> None:
    inside = axis("0 0 1", "<initial_position>0.5</initial_position>")
    _, _, found, _ = convert(sdf(link("a"), link("b"), joint("j", "revolute", "a", "b", inside)))
    assert "joint 'j' starts at 0.5" in found.by_code("convert.left-out")[0].message


def test_meshes_are_named_by_package_where_they_lie_in_one(tmp_path, reading) -> None:
    from gazelle.workspace import Workspace

    package = tmp_path / "src" / "bot"
    (package / "meshes").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>bot</name></package>", encoding="utf-8")
    (package / "meshes" / "m.stl").write_bytes(b"solid m\nendsolid m\n")
    mesh = f"<geometry><mesh><uri>{package}/meshes/m.stl</uri></mesh></geometry>"
    model = reading.model(sdf(link("a", shape("c", mesh))))
    workspace = Workspace.discover(
        environ={"ROS_PACKAGE_PATH": str(tmp_path / "src")}, cwd=tmp_path
    )

    def address(**words) -> tuple[str, Diagnostics]:
        found = Diagnostics()
        text = to_urdf(
            model, diagnostics=found, output_files=OutputFiles(tmp_path, "r", **words)
        ).text
        return text.split('filename="')[1].split('"')[0], found

    assert address(workspace=workspace)[0] == "package://bot/meshes/m.stl"
    assert address()[0] == (package / "meshes" / "m.stl").as_uri()
    other, found = address(workspace=workspace, package="other")
    assert other == "package://other/meshes/m.stl"
    assert "is not there yet" in found.by_code("convert.file-address")[0].message


def _turn(direction: tuple[float, float, float], angle: float) -> np.ndarray:
    x, y, z = direction
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew
