"""An SDF model that is read and written again is the same model."""

from __future__ import annotations

import pytest
from tests.description.writers.conftest import OWN_ROS1
from tests.shared_files import SHARED, shared_cases

from gazelle.description.sdformat_emulation import Release
from gazelle.description.writers import to_sdf
from gazelle.diagnostics import Diagnostics

YARD = OWN_ROS1 / "src/yard_gazebo/models"
SAMPLES = SHARED / "workspaces/gazebo_models"
CASES = [(file, release) for file in (YARD / "barrow", YARD / "shed") for release in Release]
SAMPLE_CASES = [
    (SAMPLES / name / "model.sdf", release)
    for name in ("my_robot", "ISCAS_Museum")
    for release in Release
]


@pytest.mark.parametrize(("file", "release"), [*CASES, *shared_cases(*SAMPLE_CASES)])
def test_models_of_the_documents_come_back_equal(file, release, reading, workspace) -> None:
    model = reading.model(file, workspace)
    text = to_sdf(model, diagnostics=Diagnostics(), release=release).text
    assert reading.differences(model, reading.model(text, workspace)) == []


def test_shapes_and_visuals_of_one_link_get_different_names(reading) -> None:
    shape = "<geometry><sphere><radius>1</radius></sphere></geometry>"
    model = reading.model(
        f'<sdf version="1.6"><model name="m"><link name="l"><collision name="s">{shape}'
        f'</collision><visual name="s">{shape}</visual></link></model></sdf>'
    )
    again = reading.model(to_sdf(model, diagnostics=Diagnostics()).text)
    assert again.link("l").visuals[0].name == "s_visual"


def test_every_joint_type_comes_back(reading) -> None:
    two = "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>"
    kinds = {
        "ball": "",
        "continuous": "<axis><xyz>0 0 1</xyz></axis>",
        "fixed": "",
        "prismatic": "<axis><xyz>0 0 1</xyz><limit><lower>0</lower></limit></axis>",
        "revolute": "<axis><xyz>0 1 1</xyz><initial_position>1</initial_position></axis>",
        "revolute2": two,
        "screw": "<axis><xyz>0 0 1</xyz></axis><thread_pitch>3</thread_pitch>",
        "universal": two,
    }
    parts = "".join(
        f'<link name="{kind}"/><joint name="j{kind}" type="{kind}"><parent>base</parent>'
        f"<child>{kind}</child>{words}</joint>"
        for kind, words in kinds.items()
    )
    model = reading.model(
        f'<sdf version="1.9"><model name="m"><link name="base"/>{parts}</model></sdf>'
    )
    again = reading.model(to_sdf(model, diagnostics=Diagnostics()).text)
    assert reading.differences(model, again) == []


def test_massless_link_gets_a_least_mass_and_says_so(reading) -> None:
    model = reading.model(
        '<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="1" ixy="0" '
        'ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><link name="b"/><joint name="j" '
        'type="fixed"><parent link="a"/><child link="b"/></joint></robot>'
    )
    found = Diagnostics()
    again = reading.model(to_sdf(model, diagnostics=found).text)
    assert again.link("b").inertial.mass_kg == 1e-6
    assert "link 'b' has no mass, which SDF does not allow" in next(iter(found)).message
