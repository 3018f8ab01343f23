from __future__ import annotations

import pytest

from gazelle.description.sdformat_emulation import Release, SdfElement

from .making import BOX, converted, joint, link, remarks_of


def _texts(element: SdfElement, name: str) -> list[str]:
    return [item.text for item in element.walk() if item.name == name]


def test_parts_are_numbered_from_the_second_one_on() -> None:
    parts = f"<visual>{BOX}</visual><visual>{BOX}</visual><visual name='shell'>{BOX}</visual>"
    found = converted(link("base", parts)).children[0].find_all("visual")
    assert [item.attributes["name"] for item in found] == [
        "base_visual", "base_visual_1", "base_fixed_joint_lump__shell_visual_2",
    ]  # fmt: skip


def test_ros_packages_are_models_to_gazebo() -> None:
    mesh = '<mesh filename="package://p/a.stl" scale="0.001 0.001 0.00123456789"/>'
    model = converted(link("base", f"<collision><geometry>{mesh}</geometry></collision>"))
    assert _texts(model, "uri") == ["model://p/a.stl"]
    assert _texts(model, "scale") == ["0.001 0.001 0.00123457"]


def test_a_mesh_without_a_name_is_told() -> None:
    mesh = '<collision><geometry><mesh filename=""/></geometry></collision>'
    assert remarks_of(link("base", mesh)) == [
        "\033[1;31mError [parser_urdf.cc:2364]\033[0m urdf2sdf: mesh geometry with no filename "
        "given."
    ]


def test_only_sdformat_12_writes_colours() -> None:
    named = f'<visual>{BOX}<material name="m"/></visual>'
    parts = ('<material name="m"><color rgba="0.4 0 1 0.5"/></material>', link("base", named))
    assert _texts(converted(*parts), "diffuse") == ["0.5000000074505806 0 1 0.5"]
    assert _texts(converted(*parts), "ambient") == ["0.5000000074505806 0 1 0.5"]
    assert _texts(converted(*parts, release=Release.V9), "diffuse") == []


def test_the_first_visual_that_says_how_a_material_looks_says_it_for_all() -> None:
    red = f'<visual>{BOX}<material name="m"><color rgba="1 0 0 1"/></material></visual>'
    green = f'<visual>{BOX}<material name="m"><color rgba="0 1 0 1"/></material></visual>'
    assert _texts(converted(link("base", red + green)), "diffuse") == ["1 0 0 1", "1 0 0 1"]


def test_what_follows_a_broken_part_is_left_out() -> None:
    parts = f"<visual>{BOX}</visual><visual/><collision>{BOX}</collision>"
    model = converted(link("base", parts))
    assert [item.name for item in model.children[0].children] == ["inertial", "visual"]


def test_a_mass_with_a_broken_inertia_stays() -> None:
    broken = '<link name="a"><inertial><mass value="2"/><inertia ixx="1"/></inertial></link>'
    model = converted(broken)
    assert (_texts(model, "mass"), _texts(model, "ixx")) == (["2"], ["0"])


@pytest.mark.parametrize(("mass", "is_there"), [("1e-6", False), ("1.1e-6", True), ("-1", True)])
def test_a_millionth_of_a_kilogram_is_no_mass(mass: str, is_there: bool) -> None:
    assert bool(converted(link("base", mass=mass)).children) is is_there


def test_swapped_limits_are_put_right_with_a_remark() -> None:
    limit = '<limit lower="1.5" upper="-0.25" effort="3" velocity="4"/>'
    parts = (link("base"), link("arm"), joint("prismatic", "base", "arm", limit))
    model = converted(*parts)
    assert (_texts(model, "lower"), _texts(model, "upper")) == (["-0.25"], ["1.5"])
    assert remarks_of(*parts, release=Release.V9) == [
        "\033[1;33mWarning [parser_urdf.cc:3037]\033[0m urdf2sdf: revolute joint [base_arm] with "
        "limits: lowStop[1.5] > highStop[-0.25], switching the two."
    ]


def test_only_sdformat_12_limits_continuous_joints() -> None:
    limit = '<limit effort="3" velocity="4"/>'
    parts = (link("base"), link("arm"), joint("continuous", "base", "arm", limit))
    assert _texts(converted(*parts), "effort") == ["3"]
    assert _texts(converted(*parts), "lower") == []
    assert _texts(converted(*parts, release=Release.V9), "effort") == []


def test_floating_and_planar_joints_are_left_out_and_their_links_stay() -> None:
    parts = (
        link("a"),
        link("b"),
        link("c"),
        joint("floating", "a", "b"),
        joint("planar", "a", "c"),
    )
    model = converted(*parts)
    assert [item.name for item in model.children] == ["link", "link", "link"]


def test_mimic_is_lost() -> None:
    limit = '<limit effort="1" velocity="1"/><mimic joint="a_b"/>'
    parts = (link("a"), link("b"), link("c"), joint("revolute", "a", "b"))
    model = converted(*parts, joint("revolute", "a", "c", limit))
    assert not [item for item in model.walk() if item.name == "mimic"]


def test_negative_zeros_lose_their_sign() -> None:
    origin = '<origin xyz="-0 0 -0.0"/>'
    model = converted(link("a", f"<visual>{origin}{BOX}</visual>"))
    assert _texts(model, "pose") == ["0 0 0 0 0 0"] * 2


def test_a_robots_origin_is_the_models_pose() -> None:
    model = converted('<origin xyz="1 2 3" rpy="0 0 1"/>', link("a"))
    assert model.children[-1].text == "1 2 3 0 0 1"
    assert remarks_of('<origin xyz="1 b 3"/>', link("a")) == [
        "\033[1;31mError [parser_urdf.cc:288]\033[0m xml key [1 b 3][1] value [b] is not a valid "
        "double from a 3-tuple"
    ]
