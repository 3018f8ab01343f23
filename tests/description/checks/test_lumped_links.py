"""What Gazebo loses behind fixed joints; names as sdformat 9 and 12.3 print them."""

from __future__ import annotations

from pathlib import Path

from tests.description.checks.pain import FIXTURES, examined, finding, place
from tests.shared_files import needs_shared

from gazelle.description.model import Model
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader import read_urdf
from gazelle.description.urdf_reader.fixed_joint_lumping import collision_names, lumped_links
from gazelle.description.xml import Tag, parse_xml, read_xml
from gazelle.diagnostics import Diagnostic, Diagnostics, Severity


def test_preserved_dummy_root_lets_the_robot_vanish() -> None:
    item = finding("pain_04_massless/preserved_root.urdf")
    assert item.code == "robot.preserved-massless"
    assert item.message == (
        "the fixed joint 'base_joint' is preserved, but 'base_footprint' has no <inertial>: "
        "Gazebo drops that link, and with it the whole robot: nothing appears; here it is kept"
    )
    assert place(item) == '<joint name="base_joint" type="fixed">'
    assert item.fix.startswith("remove <preserveFixedJoint>")
    assert "not modeled in sdf" in item.phrase


def test_preserved_frame_is_dropped_alone() -> None:
    item = finding("pain_04_massless/preserved_frame.urdf")
    assert item.code == "robot.preserved-massless"
    assert item.message.endswith(
        "'camera_frame' has no <inertial>: Gazebo drops that link; here it is kept"
    )


BROKEN = FIXTURES / "pain_06_lumping/broken/sensors.urdf"


def _read(root: Tag | None) -> tuple[Tag, Model]:
    assert root is not None
    model = read_urdf(root, context=ReadContext(None, Diagnostics(), "robot.urdf"))
    assert model is not None
    return root, model


def _file(path: Path) -> tuple[Tag, Model]:
    return _read(read_xml(path, Diagnostics()))


def _of(code: str) -> list[Diagnostic]:
    return list(examined(BROKEN).by_code(code))


def test_collisions_are_called_as_sdformat_calls_them() -> None:
    names = collision_names(*_file(BROKEN))
    lump = "base_footprint_fixed_joint_lump__"
    assert names == {
        "base_footprint": (),
        "base_link": (f"{lump}base_link_collision",),
        "bumper": (f"{lump}bumper_collision_1",),
        "gps_link": (f"{lump}gps_link_collision_2",),
        "imu_link": (f"{lump}imu_link_collision_3",),
        "tool": (f"{lump}tool_collision_4",),
    }


def test_preserved_joints_keep_names() -> None:
    root, model = _file(FIXTURES / "pain_06_lumping/clean/sensors.urdf")
    assert lumped_links(model) == {"base_link": "base_footprint"}
    assert collision_names(root, model)["bumper"] == ("bumper_collision",)


def test_collision_that_starts_with_the_body_s_name_gets_no_prefix() -> None:
    text = """<robot name="r">
      <link name="base"/>
      <link name="base_top"><collision><geometry><sphere radius="1"/></geometry></collision></link>
      <joint name="j" type="fixed"><parent link="base"/><child link="base_top"/></joint>
    </robot>"""
    root, model = _read(parse_xml(text, "robot.urdf", Diagnostics()))
    assert collision_names(root, model)["base_top"] == ("base_top_collision",)


def test_chain_of_thousands_of_fixed_links_is_one_body() -> None:
    count = 3000
    links = "".join(f'<link name="l{index}"><collision/></link>' for index in range(count))
    joints = "".join(
        f'<joint name="j{index:04}" type="fixed"><parent link="l{index - 1}"/>'
        f'<child link="l{index}"/></joint>'
        for index in range(1, count)
    )
    text = f'<robot name="r">{links}{joints}</robot>'
    root, model = _read(parse_xml(text, "robot.urdf", Diagnostics()))
    assert set(lumped_links(model).values()) == {"l0"}
    assert collision_names(root, model)["l2999"] == ("l0_fixed_joint_lump__l2999_collision_2999",)


def test_contact_sensor_gets_the_name_that_gazebo_uses() -> None:
    (item,) = _of("robot.lumped-collision")
    assert "a contact sensor watches 'bumper_collision'" in item.message
    assert "lumps link 'bumper' into 'base_footprint'" in item.message
    assert place(item) == "<collision>bumper_collision</collision>"
    assert "write 'base_footprint_fixed_joint_lump__bumper_collision_1', or preserve" in item.fix
    assert '<gazebo reference="bumper_joint"><preserveFixedJoint>true' in item.fix


def test_names_that_gazebo_does_not_replace_are_reported() -> None:
    gps, tool, wrench = _of("robot.lumped-name")
    assert "plug-in 'gps' names the link 'gps_link' in <body_name>" in gps.message
    assert place(gps) == "<body_name>gps_link</body_name>"
    assert "plug-in 'tool' names the joint 'tool_joint' in <jointName>" in tool.message
    assert '<gazebo reference="tool_joint">' in tool.fix
    assert "sensor 'wrench' measures at the fixed joint 'tool_joint'" in wrench.message
    assert place(wrench) == '<sensor name="wrench" type="force_torque">'
    assert wrench.severity is Severity.WARNING


def test_name_that_gazebo_replaces_is_a_notice() -> None:
    (item,) = _of("robot.lumped-frame")
    assert item.severity is Severity.INFO
    assert "<bodyName> 'imu_link' becomes 'base_footprint'" in item.message
    assert place(item) == "<bodyName>imu_link</bodyName>"


def test_link_without_mass_needs_some_to_be_preserved(tmp_path: Path) -> None:
    text = BROKEN.read_text(encoding="utf-8")
    head, _, tail = text.partition('<link name="imu_link">')
    link, _, rest = tail.partition("</link>")
    bare = link[: link.index("<inertial>")] + link[link.index("</inertial>") + 11 :]
    file = tmp_path / "robot.urdf"
    file.write_text(f'{head}<link name="imu_link">{bare}</link>{rest}', encoding="utf-8")
    (item,) = examined(file).by_code("robot.lumped-frame")
    assert item.fix.endswith(
        "and give 'imu_link' an <inertial>: preserved links without one are dropped"
    )


@needs_shared
def test_massless_link_of_burger_needs_some_to_be_preserved(workspaces_dir: Path) -> None:
    folder = workspaces_dir / "turtlebot3_ws/src/turtlebot3/turtlebot3_description/urdf"
    found = examined(folder / "turtlebot3_burger.urdf.xacro").by_code("robot.lumped-frame")
    (item,) = found
    assert "<frameName> 'imu_link' becomes 'base_footprint'" in item.message
    assert item.fix.endswith(
        "and give 'imu_link' an <inertial>: preserved links without one are dropped"
    )


def test_gravity_of_a_lumped_link_would_lift_the_whole_body() -> None:
    (item,) = _of("robot.lumped-value")
    assert "gravity is switched off for 'imu_link'" in item.message
    assert "there all of 'base_footprint' floats" in item.message
    assert "multiple inconsistent <gravity>" in item.phrase
