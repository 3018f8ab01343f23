"""MJCF read as worlds: the same bodies where MuJoCo has them."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

from gazelle.description.forward_kinematics import posed_model
from gazelle.description.loader import load_models, load_world
from gazelle.description.model import Box, Capsule, JointType, MeshShape, Model, World
from gazelle.description.writers import OutputFiles, to_sdf, to_urdf
from gazelle.diagnostics import Diagnostics
from gazelle.engine.mjcf import is_mjcf, read_mjcf

HUMANOID = """<mujoco model="humanoid">
  <compiler angle="degree"/>
  <default><geom friction="0.7"/><joint damping="0.5"/>
    <default class="visual"><geom contype="0" conaffinity="0" group="2"/></default></default>
  <worldbody>
    <light pos="0 0 3"/>
    <geom name="floor" type="plane" size="5 5 0.1"/>
    <body name="torso" pos="0 0 1.3" euler="0 0 20">
      <freejoint name="root"/>
      <geom name="chest" type="capsule" fromto="0 -.07 0 0 .07 0" size="0.07"/>
      <geom class="visual" type="ellipsoid" size=".1 .2 .3" rgba="1 0 0 0.5"/>
      <site name="imu"/>
      <body name="head" pos="0 0 .19"><geom type="sphere" size=".09" mass="2"/></body>
      <body name="thigh" pos="0 -.1 -.4">
        <joint name="hip_x" axis="1 0 0" range="-25 5"/>
        <joint name="hip_z" axis="0 0 1" range="-60 35"/>
        <joint name="hip_y" axis="0 1 0" range="-110 20" stiffness="2" springref="10"/>
        <geom type="capsule" fromto="0 0 0 0 .01 -.34" size=".06"/>
        <body name="shin" pos="0 .01 -.4">
          <joint name="knee" axis="0 -1 0" pos="0 0 .02" range="-160 -2" ref="-30" armature=".01"/>
          <geom type="capsule" fromto="0 0 0 0 0 -.3" size=".049"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="knee" gear="50" ctrlrange="-1 1" ctrllimited="true"/></actuator>
</mujoco>
"""
CARTPOLE = """<mujoco model="cartpole"><option timestep="0.01" gravity="0 0 -9.81"/>
 <worldbody>
  <body name="cart" pos="0 0 1">
   <joint name="slider" type="slide" axis="1 0 0" range="-1.8 1.8" limited="true" damping="0.05"/>
   <geom type="box" size=".2 .15 .1" mass="1"/>
   <body name="pole"><joint name="hinge" axis="0 1 0"/>
    <geom type="capsule" fromto="0 0 0 0.3 0 1" size=".045" mass=".1"/></body>
  </body></worldbody></mujoco>
"""
ARM = """<mujoco model="arm"><compiler angle="radian"/>
 <worldbody>
  <body name="base" pos="1 0 .1" euler="0.1 0.2 1"><geom type="cylinder" size=".1 .1"/>
   <body name="upper" pos="0 0 .1" euler="0 0.5 0">
    <joint name="turn" axis="0 1 1" range="-2 2" frictionloss="0.1" pos=".1 0 0"/>
    <geom type="box" size=".05 .05 .2" pos="0 0 .2" euler="1 0 0"/>
    <body name="left" pos=".1 0 .4"><joint name="finger" type="slide" axis="1 0 0" range="0 .1"/>
     <geom type="box" size=".01 .02 .03" friction="2"/></body>
    <body name="right" pos="-.1 0 .4">
     <joint name="right" type="slide" axis="-1 0 0" range="0 .1" actuatorfrcrange="-5 5"/>
     <geom type="box" size=".01 .02 .03"/></body>
   </body></body>
 </worldbody>
 <equality><joint joint1="right" joint2="finger" polycoef="0.01 2 0 0 0"/></equality>
 <actuator><position joint="finger" kp="100" forcerange="-20 20"/></actuator>
</mujoco>
"""


@pytest.fixture
def read(tmp_path):
    """Reads a text as MJCF; returns the world, the findings and MuJoCo's own model."""

    def run(text: str) -> tuple[World | None, Diagnostics, mujoco.MjModel | None]:
        file = tmp_path / "robot.xml"
        file.write_text(text, encoding="utf-8")
        found = Diagnostics()
        world = read_mjcf(
            file, diagnostics=found, output_files=OutputFiles(tmp_path, "robot", relative=True)
        )
        own = mujoco.MjModel.from_xml_path(str(file)) if world is not None else None
        return world, found, own

    return run


def robot(world: World) -> Model:
    [model] = [item for item in world.models if not item.static]
    return model


def as_urdf(model: Model, folder: Path) -> Model:
    text = to_urdf(model, diagnostics=Diagnostics(), output_files=OutputFiles(folder, "r")).text
    [again] = load_models(text, workspace=None, diagnostics=Diagnostics())
    return again


def as_sdf(model: Model, folder: Path) -> Model:
    text = to_sdf(model, diagnostics=Diagnostics(), output_files=OutputFiles(folder, "r")).text
    [again] = load_models(text, workspace=None, diagnostics=Diagnostics())
    return again


def assert_bodies_agree(model: Model, own: mujoco.MjModel, seed: int, tolerance: float) -> None:
    """Compare poses, masses and inertias in the world with MuJoCo's at random positions."""
    rng = np.random.default_rng(seed)
    data = mujoco.MjData(own)
    positions = {}
    for index in range(own.njnt):
        if own.jnt_type[index] in (2, 3):
            name = own.joint(index).name
            name = name if model.joint(name) else f"{name}_joint"
            value = float(rng.uniform(-1, 1))
            data.qpos[own.jnt_qposadr[index]] = positions[name] = value
    for index in range(own.neq):
        follower, leader = own.eq_obj1id[index], own.eq_obj2id[index]
        constant, factor = own.eq_data[index][:2]
        value = constant + factor * data.qpos[own.jnt_qposadr[leader]]
        data.qpos[own.jnt_qposadr[follower]] = value
        positions.pop(next(name for name in positions if name.startswith("right")))
    mujoco.mj_forward(own, data)
    posed = posed_model(model, positions)
    for body in range(1, own.nbody):
        link = posed.link(own.body(body).name)
        pose = (posed.T_world_model @ link.T_model_link @ link.inertial.T_link_com).matrix()
        assert np.allclose(pose[:3, 3], data.xipos[body], atol=1e-9), link.name
        tensor = pose[:3, :3] @ _tensor(link.inertial) @ pose[:3, :3].T
        axes = data.ximat[body].reshape(3, 3)
        expected = axes @ np.diag(own.body_inertia[body]) @ axes.T
        assert np.allclose(tensor, expected, rtol=tolerance, atol=tolerance * tensor.max())
        assert link.inertial.mass_kg == pytest.approx(own.body_mass[body], rel=tolerance)
    assert sum(item.inertial.mass_kg for item in posed.links if item.inertial) == pytest.approx(
        own.body_mass.sum(), rel=1e-9
    )


def _tensor(inertial) -> np.ndarray:
    a, b, c, d, e, f = inertial.inertia_kg_m2
    return np.array([[a, b, c], [b, d, e], [c, e, f]])


@pytest.mark.parametrize("convert", [as_urdf, as_sdf])
@pytest.mark.parametrize(("text", "tolerance"), [(HUMANOID, 2.1e-3), (CARTPOLE, 1e-9), (ARM, 1e-9)])
def test_bodies_are_where_mujoco_has_them(read, convert, text, tolerance, tmp_path) -> None:
    world, _, own = read(text)
    model = robot(world)
    again = convert(model, tmp_path)
    for seed in range(4):
        assert_bodies_agree(model, own, seed, tolerance)
        assert_bodies_agree(again, own, seed, tolerance)


def test_floor_is_scenery_and_the_robot_has_the_files_name(read) -> None:
    world, _, _ = read(HUMANOID)
    assert [(item.name, item.static) for item in world.models] == [
        ("scenery", True),
        ("humanoid", False),
    ]
    assert world.gravity_m_s2 == (0.0, 0.0, -9.81)


def test_joints_of_one_body_are_a_chain(read) -> None:
    world, found, _ = read(HUMANOID)
    model = robot(world)
    names = [item.name for item in model.joints]
    assert names == ["head_joint", "hip_x", "hip_z", "hip_y", "knee"]
    assert model.joint("hip_y").axis.spring_reference == pytest.approx(np.radians(10))
    assert model.joint("knee").axis.position == pytest.approx(np.radians(-30))
    assert model.joint("knee").axis.effort == 50.0
    assert "body 'thigh' has the joints 'hip_x', 'hip_z', 'hip_y'" in " ".join(
        item.message for item in found.by_code("convert.approximated")
    )


def test_everything_without_a_place_is_told(read) -> None:
    _, found, _ = read(HUMANOID)
    told = " | ".join(item.message for item in found.by_code("convert.left-out"))
    for words in ("1 actuator", "1 site", "1 light", "armature of joints 'knee'"):
        assert words in told


def test_equality_of_joints_is_a_mimic_and_taken_names_change(read) -> None:
    world, found, _ = read(ARM)
    model = robot(world)
    mimic = model.joint("right_joint").mimic
    assert (mimic.joint, mimic.multiplier, mimic.offset) == ("finger", 2.0, 0.01)
    assert model.joint("finger").axis.effort == 20.0
    assert model.joint("right_joint").axis.effort == 5.0
    assert model.joint("base_joint").parent == "world"
    assert "joint 'right' is called 'right_joint'" in found.by_code("convert.renamed")[0].message


def test_connect_and_weld_close_loops(read) -> None:
    world, found, _ = read(
        '<mujoco><worldbody><body name="a"><freejoint/><geom size=".1"/>'
        '<body name="b" pos="1 0 0"><joint axis="0 0 1"/><geom size=".1"/></body>'
        '<body name="c" pos="0 1 0"><joint axis="0 0 1"/><geom size=".1"/></body></body>'
        '</worldbody><equality><connect name="pin" body1="b" body2="c" anchor="0 1 0"/>'
        '<weld body1="a" body2="c"/></equality></mujoco>'
    )
    model = robot(world)
    assert model.joint("pin").type is JointType.BALL
    assert model.joint("pin").T_model_joint.position_m == (1.0, 1.0, 0.0)
    assert model.joint("a_c_fixed").type is JointType.FIXED
    assert not found.by_code("convert.left-out")


def test_meshes_stand_where_mujoco_puts_them(read, tmp_path) -> None:
    from gazelle.geometry import box_mesh, load_mesh

    (tmp_path / "meshes").mkdir()
    part = box_mesh((0.2, 0.4, 0.6))
    stl(tmp_path / "meshes" / "part.stl", part.vertices_m + np.array([0.3, 0.1, 0.2]), part.faces)
    world, _, own = read(
        '<mujoco><compiler meshdir="meshes"/><asset><mesh name="p" file="part.stl" '
        'scale="2 1 0.5"/><mesh name="q" file="part.stl" refpos="0.1 0 0"/></asset><worldbody>'
        '<body name="a" pos="0 0 1"><freejoint/><geom name="g" type="mesh" mesh="p" '
        'pos="1 2 3" euler="10 20 30"/><geom name="h" type="mesh" mesh="q"/></body></worldbody>'
        "</mujoco>"
    )
    link = robot(world).links[0]
    data = mujoco.MjData(own)
    mujoco.mj_forward(own, data)
    for visual in link.visuals:
        shape = visual.shape
        assert isinstance(shape, MeshShape)
        geom = own.geom(visual.name)
        mesh = own.mesh(int(geom.dataid[0]))
        start, count = int(mesh.vertadr[0]), int(mesh.vertnum[0])
        turn = data.geom_xmat[geom.id].reshape(3, 3)
        expected = own.mesh_vert[start : start + count] @ turn.T + data.geom_xpos[geom.id]
        if shape.path is None:
            continue
        found = load_mesh(shape.path).scaled(shape.scale).vertices_m
        pose = robot(world).T_world_model @ link.T_model_link @ visual.T_link_visual
        placed = pose.transform(found)
        assert np.allclose(np.sort(placed.min(axis=0)), np.sort(expected.min(axis=0)), atol=1e-6)
        assert np.allclose(placed.max(axis=0), expected.max(axis=0), atol=1e-6)
    kinds = {item.name: item.shape.path is None for item in link.visuals}
    assert kinds == {"g": False, "h": True}


def stl(path: Path, vertices: np.ndarray, faces: np.ndarray) -> None:
    from gazelle.description.writers.geometry_elements import stl_bytes

    path.write_bytes(stl_bytes(vertices, faces))


def test_groups_and_masks_tell_visuals_from_collisions(read) -> None:
    world, _, _ = read(
        '<mujoco><worldbody><body name="a"><freejoint/><geom name="both" type="box" size="1 2 3"/>'
        '<geom name="seen" type="capsule" size="1 2" contype="0" conaffinity="0"/>'
        '<geom name="felt" size="1" group="3" condim="1"/></body></worldbody></mujoco>'
    )
    link = robot(world).links[0]
    assert {item.name: item.shape for item in link.visuals} == {
        "both": Box((2.0, 4.0, 6.0)),
        "seen": Capsule(1.0, 4.0),
    }
    assert {item.name: item.surface.mu1 for item in link.collisions} == {"both": 1.0, "felt": 0.0}


def test_written_and_read_again_keeps_bodies(read, tmp_path) -> None:
    from gazelle.engine.mjcf import to_mjcf

    world = load_world(
        '<sdf version="1.9"><model name="m"><link name="a"><inertial><mass>2</mass></inertial>'
        '</link><link name="b"><pose>1 0 0 0 0.3 0</pose></link><joint name="j" type="revolute">'
        "<pose>0 0 0.2 0 0 0</pose><parent>a</parent><child>b</child><axis><xyz>0 1 0</xyz></axis>"
        "</joint></model></sdf>",
        workspace=None,
        diagnostics=Diagnostics(),
    )
    text = to_mjcf(world, diagnostics=Diagnostics()).text
    again, _, _ = read(text)
    model = robot(again)
    assert [link.name for link in model.links] == ["m::a", "m::b"]
    for link in world.models[0].links:
        other = model.link(f"m::{link.name}")
        assert np.allclose(other.T_model_link.matrix(), link.T_model_link.matrix(), atol=1e-12)
        assert other.inertial.mass_kg == link.inertial.mass_kg


def test_includes_are_followed_and_give_places(read, tmp_path) -> None:
    (tmp_path / "leg.xml").write_text(
        '<mujocoinclude>\n  <body name="leg"><joint name="j" type="ball" range="0 1" '
        'limited="true"/><geom size=".1"/></body></mujocoinclude>',
        encoding="utf-8",
    )
    world, found, _ = read(
        '<mujoco><worldbody><body name="a"><freejoint/><geom size=".1"/>'
        '<include file="leg.xml"/></body></worldbody></mujoco>'
    )
    assert robot(world).link("leg").span.file.endswith("leg.xml")
    [item] = [i for i in found.by_code("convert.left-out") if "ball joint 'j'" in i.message]
    assert item.span.line == 2


def test_every_missing_file_is_told_at_its_place(read) -> None:
    world, found, _ = read(
        '<mujoco>\n<asset><mesh file="a.stl"/>\n<texture type="2d" name="t" file="b.png"/>'
        '</asset>\n<include file="c.xml"/>\n<worldbody/></mujoco>'
    )
    assert world is None
    lines = {item.span.line: item.message for item in found.by_code("convert.mjcf")}
    assert sorted(lines) == [2, 3, 4]
    assert "the mesh file" in lines[2]
    assert "does not exist" in lines[4]


def test_a_file_that_includes_itself_is_refused(read) -> None:
    world, found, _ = read('<mujoco><include file="robot.xml"/></mujoco>')
    assert world is None
    assert "includes itself" in found.by_code("convert.mjcf")[0].message


def test_entities_are_refused(read) -> None:
    world, found, _ = read('<!DOCTYPE m [<!ENTITY x "y">]><mujoco><worldbody/></mujoco>')
    assert world is None
    assert found.by_code("xml.entity")


def test_mujocos_own_words_are_passed_on(read) -> None:
    world, found, _ = read(
        '<mujoco><worldbody><body><joint axs="1 0 0"/></body></worldbody></mujoco>'
    )
    assert world is None
    message = found.by_code("convert.mjcf")[0].message
    assert "MuJoCo refuses the file" in message
    assert "axs" in message


def test_only_mujoco_roots_are_mjcf(tmp_path) -> None:
    for name, text in (("a.xml", "<mujoco/>"), ("b.xml", "<robot name='mujoco'/>")):
        (tmp_path / name).write_text(text, encoding="utf-8")
    assert is_mjcf(tmp_path / "a.xml")
    assert not is_mjcf(tmp_path / "b.xml")
    assert not is_mjcf(tmp_path)
