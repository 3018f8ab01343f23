from __future__ import annotations

from gazelle.description.checks.inertia import inertial_block, sdf_block, urdf_block
from gazelle.geometry import MassProperties, Pose, box_mass_properties, is_legal_inertia

BODY = MassProperties(1.25, (0.1, -0.2, 1e-17), (3.0, 0.1, 0.2, 2.0, 0.3, 1.5))


def test_urdf_block() -> None:
    assert urdf_block(BODY) == (
        "<inertial>\n"
        '  <origin xyz="0.1 -0.2 0" rpy="0 0 0"/>\n'
        '  <mass value="1.25"/>\n'
        '  <inertia ixx="3" ixy="0.1" ixz="0.2" iyy="2" iyz="0.3" izz="1.5"/>\n'
        "</inertial>"
    )
    assert inertial_block(BODY, "urdf") == urdf_block(BODY)


def test_sdf_block() -> None:
    block = sdf_block(BODY)
    assert block.startswith("<inertial>\n  <pose>0.1 -0.2 0 0 0 0</pose>\n  <mass>1.25</mass>\n")
    assert "    <ixz>0.2</ixz>\n    <iyy>2</iyy>\n" in block
    assert inertial_block(BODY, "sdf") == block


def test_thin_plate_stays_possible_when_it_is_written(judge) -> None:
    plate = box_mass_properties(1.0, (0.7, 0.3, 1e-5))
    turned = plate.transformed(Pose.from_xyz_rpy((0, 0, 0), (0.4, 1.1, -0.3)))
    text = f'<robot name="r"><link name="a">{urdf_block(turned)}</link></robot>'
    (record,) = judge(text).records
    assert record.written is not None
    assert is_legal_inertia(record.written.inertia_kg_m2)
