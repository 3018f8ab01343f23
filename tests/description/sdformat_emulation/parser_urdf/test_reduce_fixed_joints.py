from __future__ import annotations

import pytest

from gazelle.description.sdformat_emulation import Release, SdfElement

from .making import BOX, converted, joint, link

PARTS = f"<visual>{BOX}</visual><collision>{BOX}</collision>"
TURNED = '<origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/>'


def _named(model: SdfElement, kind: str) -> dict[str, SdfElement]:
    return {item.attributes["name"]: item for item in model.walk() if item.name == kind}


def _text(element: SdfElement | None, *path: str) -> str:
    for name in path:
        assert element is not None
        element = element.find(name)
    assert element is not None
    return element.text


def test_visuals_and_collisions_move_under_the_parents_name() -> None:
    model = converted(
        link("base", PARTS), link("arm", PARTS), joint("fixed", "base", "arm", TURNED)
    )
    assert list(_named(model, "link")) == ["base"]
    lumped = "base_fixed_joint_lump__arm_collision_1"
    assert list(_named(model, "collision")) == ["base_collision", lumped]
    assert _text(_named(model, "collision")[lumped], "pose") == "1 2 3 0 0 1.570796326794896"
    assert "base_fixed_joint_lump__arm_visual_1" in _named(model, "visual")


def test_a_name_that_begins_with_the_parents_name_gets_no_prefix() -> None:
    parts = (link("base"), link("base_plate", PARTS), joint("fixed", "base", "base_plate"))
    assert list(_named(converted(*parts), "visual")) == ["base_plate_visual"]


def test_masses_add_up_about_the_common_centre() -> None:
    origin = '<origin xyz="2 0 0"/>'
    model = converted(link("base"), link("arm", mass="3"), joint("fixed", "base", "arm", origin))
    inertial = model.children[0].find("inertial")
    assert _text(inertial, "mass") == "4"
    assert _text(inertial, "pose") == "1.5 0 0 0 0 0"
    # Steiner: 1 kg at 1.5 m and 3 kg at 0.5 m from the common centre.
    assert _text(inertial, "inertia", "ixx") == "2"
    assert _text(inertial, "inertia", "izz") == "5"


def test_links_without_mass_on_both_sides_have_no_centre() -> None:
    parts = (link("base", mass="0"), link("arm", mass="0"), joint("fixed", "base", "arm"))
    assert converted(*parts).children == []


def test_moving_joints_are_hung_on_the_link_that_stays() -> None:
    model = converted(
        link("base"), link("bracket"), link("wheel"),
        joint("fixed", "base", "bracket", TURNED),
        joint("continuous", "bracket", "wheel", '<origin xyz="1 0 0"/>'),
    )  # fmt: skip
    pose = _named(model, "joint")["bracket_wheel"].find("pose")
    assert pose is not None
    assert pose.attributes == {"relative_to": "base"}
    assert [float(word) for word in pose.text.split()] == pytest.approx([1, 3, 3, 0, 0, 1.5707963])
    assert _text(_named(model, "joint")["bracket_wheel"], "parent") == "base"


def test_what_is_fixed_to_world_is_not_lumped() -> None:
    model = converted(link("world", mass=None), link("base"), joint("fixed", "world", "base"))
    assert list(_named(model, "link")) == ["base"]
    fixed = _named(model, "joint")["world_base"]
    assert fixed.attributes["type"] == "fixed"
    assert _text(fixed, "parent") == "world"
    assert fixed.children[0].attributes == {"relative_to": "__model__"}


@pytest.mark.parametrize(
    ("keys", "kind"),
    [
        ("<preserveFixedJoint>true</preserveFixedJoint>", "fixed"),
        ("<disableFixedJointLumping>Yes</disableFixedJointLumping>", "revolute"),
        ("<disableFixedJointLumping>1</disableFixedJointLumping><preserveFixedJoint value='1'/>",
         "fixed"),
    ],
)  # fmt: skip
def test_a_kept_joint_keeps_its_link(keys: str, kind: str) -> None:
    block = f'<gazebo reference="base_arm">{keys}</gazebo>'
    model = converted(link("base"), link("arm"), joint("fixed", "base", "arm"), block)
    assert list(_named(model, "link")) == ["base", "arm"]
    kept = _named(model, "joint")["base_arm"]
    assert kept.attributes["type"] == kind
    if kind == "revolute":
        assert _text(kept, "axis", "limit", "lower") == _text(kept, "axis", "limit", "upper") == "0"


@pytest.mark.parametrize(
    ("release", "pose"),
    [(Release.V9, "1 2 3 0 -0 1.5708"), (Release.V12, "1 2.5 3 0 -0 1.5708")],
)
def test_only_sdformat_12_keeps_the_pose_of_a_lumped_sensor(release: Release, pose: str) -> None:
    sensor = '<sensor name="s" type="imu"><pose>0.5 0 0 0 0 0</pose></sensor>'
    model = converted(
        link("base"), link("arm"), joint("fixed", "base", "arm", TURNED),
        f'<gazebo reference="arm">{sensor}</gazebo>', release=release,
    )  # fmt: skip
    assert _text(_named(model, "sensor")["s"], "pose") == pose


def test_a_pose_that_names_its_frame_is_left_alone() -> None:
    sensor = '<sensor name="s" type="imu"><pose relative_to="x">1 0 0 0 0 0</pose></sensor>'
    model = converted(
        link("base"), link("arm"), joint("fixed", "base", "arm", TURNED),
        f'<gazebo reference="arm">{sensor}</gazebo>',
    )  # fmt: skip
    assert _text(_named(model, "sensor")["s"], "pose") == "1 0 0 0 0 0"


@pytest.mark.parametrize(("release", "offset"), [(Release.V9, "-1 -2 -3"), (Release.V12, "1 2 3")])
def test_a_plugin_gets_the_parents_name_and_an_offset(release: Release, offset: str) -> None:
    plugin = '<plugin name="p" filename="libp.so"><bodyName>arm</bodyName></plugin>'
    model = converted(
        link("base"), link("arm"), joint("fixed", "base", "arm", TURNED),
        f"<gazebo>{plugin}</gazebo>", release=release,
    )  # fmt: skip
    found = _named(model, "plugin")["p"]
    assert _text(found, "bodyName") == "base"
    assert _text(found, "xyzOffset") == offset
    assert (found.find("ignition::corrected_offsets") is None) == (release is Release.V9)


@pytest.mark.parametrize(
    ("release", "name"), [(Release.V9, "base_collision_arm"), (Release.V12, "arm_collision")]
)
def test_only_sdformat_9_renames_the_collision_of_a_contact_sensor(
    release: Release, name: str
) -> None:
    contact = "<contact><collision>arm_collision</collision></contact>"
    model = converted(
        link("base"), link("arm", PARTS), joint("fixed", "base", "arm"),
        f'<gazebo reference="arm"><sensor name="s" type="contact">{contact}</sensor></gazebo>',
        release=release,
    )  # fmt: skip
    assert _text(_named(model, "sensor")["s"], "contact", "collision") == name
