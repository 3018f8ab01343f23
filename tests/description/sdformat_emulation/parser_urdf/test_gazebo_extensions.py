from __future__ import annotations

import pytest

from gazelle.description.sdformat_emulation import Release, SdfElement

from .making import BOX, converted, joint, link, remarks_of

PARTS = f"<visual>{BOX}</visual><collision>{BOX}</collision>"


def _shown(element: SdfElement) -> str:
    inside = element.text + "".join(map(_shown, element.children))
    return f"<{element.name}>{inside}</>"


def _of_link(keys: str, release: Release = Release.V12) -> SdfElement:
    block = f'<gazebo reference="base">{keys}</gazebo>'
    return converted(link("base", PARTS), block, release=release).children[0]


def test_friction_and_contact_keys_become_a_surface() -> None:
    keys = (
        "<mu1>0.5</mu1><mu2 value='2'/><kp>1e6</kp><minDepth>0.001</minDepth><fdir1>1 0 0</fdir1>"
    )
    collision = _of_link(keys).find("collision")
    assert collision is not None
    assert _shown(collision.children[-1]) == (
        "<surface><contact><ode><kp>1000000</><min_depth>0.001</></></>"
        "<friction><ode><mu>0.5</><mu2>2</><fdir1>1 0 0</></></></>"
    )


def test_friction_goes_where_the_replaced_surface_was_in_memory() -> None:
    contact = "<collision><surface><contact><ode><kp>5</kp></ode></contact></surface></collision>"
    blocks = (f'<gazebo reference="base">{keys}</gazebo>' for keys in ("<kd>1</kd>", contact))
    model = converted(
        link("base", PARTS), *blocks, '<gazebo reference="base"><mu1>3</mu1></gazebo>'
    )
    collision = model.children[0].find("collision")
    assert collision is not None
    # Both real programs do this.
    assert _shown(collision.children[-1]) == (
        "<surface><contact><ode><kp>5</><mu>3</></></><friction></></>"
    )


def test_a_material_names_gazebos_own_script() -> None:
    visual = _of_link("<material>Gazebo/Red</material>").find("visual")
    assert visual is not None
    assert _shown(visual.children[-1]) == (
        "<material><script><name>Gazebo/Red</>"
        "<uri>file://media/materials/scripts/gazebo.material</></></>"
    )


def test_sdformat_9_states_gravity_and_decay_for_every_block() -> None:
    found = [_shown(item) for item in _of_link("<mu1>1</mu1>", Release.V9).children[-2:]]
    assert found == ["<gravity>true</>", "<velocity_decay></>"]
    assert _of_link("<mu1>1</mu1>").find("gravity") is None


@pytest.mark.parametrize(("word", "gravity"), [("true", "false"), ("No", "true"), ("x", "false")])
def test_gravity_is_off_unless_the_word_says_no(word: str, gravity: str) -> None:
    found = _of_link(f"<turnGravityOff>{word}</turnGravityOff>").find("gravity")
    assert found is not None
    assert found.text == gravity


def test_unknown_keys_are_copied_with_attributes_and_space() -> None:
    found = _of_link("<thing a='1'><b> x  y </b></thing>").find("thing")
    assert found is not None
    assert found.attributes == {"a": "1"}
    assert found.children[0].text == " x  y "
    found = _of_link("<thing a='1'><b> x  y </b></thing>", Release.V9).find("thing")
    assert found is not None
    assert found.children[0].text == "x y"


def test_a_block_for_all_visuals_goes_into_each() -> None:
    twice = f"<visual>{BOX}</visual><visual>{BOX}</visual>"
    block = '<gazebo reference="base"><visual><transparency>0.5</transparency></visual></gazebo>'
    visuals = converted(link("base", twice), block).children[0].find_all("visual")
    assert [_shown(item.children[-1]) for item in visuals] == ["<transparency>0.5</>"] * 2
    assert visuals[0].children[-1] is not visuals[1].children[-1]


def test_every_joint_key_has_its_place() -> None:
    keys = (
        "<stopCfm>0.1</stopCfm><stopErp>0.3</stopErp><springStiffness>5</springStiffness>"
        "<provideFeedback>true</provideFeedback><implicitSpringDamper>0</implicitSpringDamper>"
    )
    model = converted(
        link("base"), link("arm"), joint("revolute", "base", "arm"),
        f'<gazebo reference="base_arm">{keys}</gazebo>',
    )  # fmt: skip
    found = model.find("joint")
    assert found is not None
    axis, physics = found.children[-2:]
    assert _shown(axis.children[-1]) == "<dynamics><spring_stiffness>5</></>"
    assert _shown(physics) == (
        "<physics><provide_feedback>true</><ode><provide_feedback>true</>"
        "<implicit_spring_damper>false</><cfm_damping>false</>"
        "<limit><cfm>0.1</><erp>0.3</></></></>"
    )


def test_a_later_block_makes_a_static_robot_move_again() -> None:
    parts = (link("base"), "<gazebo><static>true</static></gazebo>", "<gazebo/>")
    static = converted(*parts).find("static")
    assert static is not None
    assert static.text == "false"
    assert remarks_of(*parts) == [
        "\033[1;33mWarning [parser_urdf.cc:1139]\033[0m multiple inconsistent <static> exists due "
        "to fixed joint reduction overwriting previous value [true] with [false]."
    ]


def test_numbers_are_read_up_to_their_end() -> None:
    friction = next(
        item for item in _of_link("<mu1> 0x1A and more</mu1>").walk() if item.name == "mu"
    )
    assert friction.text == "26"


@pytest.mark.parametrize(
    ("text", "kind", "function"),
    [
        ("<mu1>much</mu1>", "invalid_argument", "stod"),
        ("<mu1/>", "invalid_argument", "stod"),
        ("<kp>1e999</kp>", "out_of_range", "stod"),
        ("<kp>1e-320</kp>", "out_of_range", "stod"),
        ("<maxContacts>x</maxContacts>", "invalid_argument", "stoi"),
        ("<maxContacts>9876543210</maxContacts>", "out_of_range", "stoi"),
    ],
)
def test_a_bad_number_ends_the_program(text: str, kind: str, function: str) -> None:
    assert remarks_of(link("base"), f'<gazebo reference="base">{text}</gazebo>') == [
        f"terminate called after throwing an instance of 'std::{kind}'\n  what():  {function}"
    ]


def test_a_number_that_is_an_element_is_told_by_sdformat_12() -> None:
    remarks = remarks_of(link("base"), '<gazebo reference="base"><mu1><x/></mu1></gazebo>')
    assert remarks[0].endswith("[parser_urdf.cc:1189]\033[0m Attribute value string not set")
