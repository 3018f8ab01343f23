from __future__ import annotations

from dataclasses import replace

import pytest

from gazelle.description.errors_as_warnings import strict
from gazelle.description.loader import load_models, load_world
from gazelle.diagnostics import Diagnostics, Severity

BOX = "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>"
INERTIAL = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
)


def _sdf(body: str) -> str:
    return f"<sdf version='1.7'><model name='m'>{body}</model></sdf>"


def _robot(body: str) -> str:
    links = "".join(f'<link name="{name}">{INERTIAL}</link>' for name in "abc")
    return f'<robot name="r">{links}{body}</robot>'


def _joint(name: str, parent: str, child: str, more: str = "", kind: str = "fixed") -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{more}</joint>'


TREE = _joint("j", "a", "b") + _joint("k", "a", "c")


@pytest.mark.parametrize(
    ("code", "body"),
    [
        ("sdf.duplicate-name", "<link name='l'/><link name='l'/>"),
        ("sdf.unknown-frame", "<link name='l'><pose relative_to='nowhere'/></link>"),
        ("xml.bad-number", "<link name='l'><pose>x 0 0 0 0 0</pose></link>"),
        (
            "sdf.bad-joint",
            "<link name='l'/><joint name='j' type='fixed'><parent>l</parent><child>k</child>"
            "</joint>",
        ),
        (
            "sdf.unknown-joint-type",
            "<link name='l'/><joint name='j' type='elastic'><parent>world</parent>"
            "<child>l</child></joint>",
        ),
    ],
)
def test_what_gazebo_goes_on_with_is_a_warning_in_a_run_and_an_error_for_the_doctor(
    code: str, body: str
) -> None:
    diagnostics = Diagnostics()
    (model,) = load_models(_sdf(body), workspace=None, diagnostics=diagnostics)
    assert model.link("l") is not None
    (found,) = diagnostics.by_code(code)
    assert found.severity is Severity.WARNING
    assert [item.severity for item in strict([found])] == [Severity.ERROR]


@pytest.mark.parametrize(
    ("code", "body"),
    [
        ("urdf.two-parents", TREE + _joint("l", "b", "c")),
        (
            "urdf.zero-axis",
            _joint("k", "a", "c") + _joint("j", "a", "b", '<axis xyz="0 0 0"/>', "continuous"),
        ),
    ],
)
def test_robots_that_urdfdom_takes_load_with_a_warning(code: str, body: str) -> None:
    diagnostics = Diagnostics()
    (model,) = load_models(_robot(body), workspace=None, diagnostics=diagnostics)
    assert {link.name for link in model.links} == {"a", "b", "c"}
    assert not diagnostics.errors
    (found,) = diagnostics.by_code(code)
    assert [item.severity for item in strict([found])] == [Severity.ERROR]


def test_robots_that_urdfdom_refuses_keep_their_errors() -> None:
    diagnostics = Diagnostics()
    load_models(_robot(TREE + '<link name="a"/>'), workspace=None, diagnostics=diagnostics)
    assert [item.code for item in diagnostics.errors] == ["urdf.duplicate-link"]


def test_a_world_with_two_collisions_of_one_name_has_both() -> None:
    diagnostics = Diagnostics()
    model = f"<model name='m'><link name='l'>{BOX}{BOX}</link></model>"
    text = f"<sdf version='1.7'><world name='w'>{model}</world></sdf>"
    world = load_world(text, workspace=None, diagnostics=diagnostics)
    (link,) = world.models[0].links
    assert [item.name for item in link.collisions] == ["c", "c_1"]
    assert not diagnostics.errors


def test_findings_in_included_models_stay_warnings_for_the_doctor() -> None:
    diagnostics = Diagnostics()
    load_models(_sdf("<link name='l'/><link name='l'/>"), workspace=None, diagnostics=diagnostics)
    (found,) = diagnostics.by_code("sdf.duplicate-name")
    assert found.span is not None
    included = replace(found, span=replace(found.span, via=(found.span,)))
    assert [item.severity for item in strict([included])] == [Severity.WARNING]
