"""What ``<gazebo>`` without a reference inserts, and the names that sensors watch."""

from __future__ import annotations

import pytest

from gazelle.description.loader import load_models
from gazelle.description.model import ContactSpec, JointType, Model
from gazelle.diagnostics import Diagnostics

INERTIAL = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
)
SHAPE = '<collision><geometry><box size="1 1 1"/></geometry></collision>'
TREE = f"""
<link name="a">{INERTIAL}</link>
<link name="b">{INERTIAL}{SHAPE}</link>
<link name="c">{INERTIAL}{SHAPE}</link>
<joint name="ab" type="continuous">
  <origin xyz="1 0 0"/><parent link="a"/><child link="b"/>
</joint>
<joint name="bc" type="fixed"><origin xyz="1 0 0"/><parent link="b"/><child link="c"/></joint>
"""
SCREW = """
<gazebo>
  <joint name="thread" type="screw">
    <parent>a</parent><child>b</child><thread_pitch>-10</thread_pitch>
    <axis><xyz>0 0 1</xyz></axis>
  </joint>
</gazebo>
"""


def _loaded(inside: str, *, inserts: bool = True) -> tuple[Model, Diagnostics]:
    diagnostics = Diagnostics()
    (model,) = load_models(
        f'<robot name="r">{TREE}{inside}</robot>',
        workspace=None,
        diagnostics=diagnostics,
        inserts=inserts,
    )
    return model, diagnostics


def test_a_joint_in_gazebo_becomes_the_models() -> None:
    model, diagnostics = _loaded(SCREW)
    joint = model.joint("thread")
    assert joint is not None
    assert (joint.type, joint.parent, joint.child) == (JointType.SCREW, "a", "b")
    assert joint.thread_pitch_rad_m == pytest.approx(10.0)
    assert joint.T_model_joint.position_m == (1.0, 0.0, 0.0)
    assert not list(diagnostics)


def test_planners_and_state_publishers_do_not_see_it() -> None:
    model, _ = _loaded(SCREW, inserts=False)
    assert [joint.name for joint in model.joints] == ["ab", "bc"]


def test_links_frames_and_their_joints_are_inserted() -> None:
    model, _ = _loaded(
        "<gazebo><link name='d'><pose>0 0 3 0 0 0</pose></link><frame name='f' attached_to='d'/>"
        "<joint name='cd' type='fixed'><parent>c</parent><child>d</child></joint></gazebo>"
    )
    assert [link.name for link in model.links] == ["a", "b", "c", "d"]
    assert model.links[-1].T_model_link.position_m == (0.0, 0.0, 3.0)
    assert [(item.name, item.attached_to) for item in model.frames] == [("f", "d")]
    assert model.canonical_link == "a"


def test_a_joint_of_a_lumped_child_starts_from_the_link_that_gazebo_has() -> None:
    model, _ = _loaded(
        "<gazebo><joint name='j' type='ball'><pose>0 0 1 0 0 0</pose>"
        "<parent>a</parent><child>c</child></joint></gazebo>"
    )
    joint = model.joint("j")
    assert joint is not None
    assert joint.T_model_joint.position_m == (1.0, 0.0, 1.0)


def test_a_joint_to_an_unknown_link_is_left_out_with_a_warning() -> None:
    model, diagnostics = _loaded(
        "<gazebo><joint name='j' type='ball'><parent>a</parent><child>bb</child></joint></gazebo>"
    )
    assert model.joint("j") is None
    (found,) = diagnostics.by_code("sdf.bad-joint")
    assert "'bb' specified by joint with name 'j' not found" in found.message
    assert not diagnostics.errors


def test_the_robots_own_names_win() -> None:
    model, diagnostics = _loaded("<gazebo><link name='a'/></gazebo>")
    assert [link.name for link in model.links] == ["a", "b", "c"]
    (found,) = diagnostics.by_code("sdf.duplicate-name")
    assert "the robot's own counts" in found.message


def test_transmissions_may_name_inserted_joints() -> None:
    _, diagnostics = _loaded(
        f"{SCREW}<transmission name='t'><type>transmission_interface/SimpleTransmission</type>"
        "<joint name='thread'><hardwareInterface>EffortJointInterface</hardwareInterface></joint>"
        "<actuator name='m'/></transmission>"
    )
    assert not diagnostics.by_code("urdf.transmission-joint")


@pytest.mark.parametrize(
    ("written", "watched"),
    [
        ("b_fixed_joint_lump__c_collision_1", "c::c_collision"),
        ("c_collision", "c::c_collision"),
        ("b_collision", "b_collision"),
        ("nothing", "nothing"),
    ],
)
def test_contact_sensors_watch_lumped_collisions_by_gazebos_names(
    written: str, watched: str
) -> None:
    model, _ = _loaded(
        "<gazebo reference='b'><sensor name='s' type='contact'><contact>"
        f"<collision>{written}</collision></contact></sensor></gazebo>"
    )
    link = model.link("b")
    assert link is not None
    (sensor,) = link.sensors
    assert sensor.spec == ContactSpec((watched,))


def test_plugins_of_visuals_are_told_as_not_loaded() -> None:
    _, diagnostics = _loaded(
        "<gazebo reference='b'><visual><plugin name='p' filename='libp.so'/></visual></gazebo>"
    )
    (found,) = diagnostics.by_code("sdf.plugin-not-loaded")
    assert "plug-in 'libp.so' in <visual> is not loaded" in found.message
    assert not diagnostics.by_code("xml.unknown-tag")
