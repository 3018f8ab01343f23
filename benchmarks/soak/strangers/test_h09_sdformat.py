"""sdformat's own test files, good and bad, with `gz sdf` of Harmonic (sdformat 14)."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree

import pytest
from stage import Stage

MODELS = ("sdformat/test/integration/model", "sdformat/test/sdf")
INTEGRATION = "sdformat/test/integration"
VALID = "Valid.\n"
# Printed by `gz sdf -d` and not by -k, which is what the case runs.
NOT_OF_CHECKS = "<element name ='sdf' required ='1'"


@pytest.fixture
def gz(stage: Stage, folder: Path) -> Stage:
    """The stage, with Harmonic's `gz` and the models of the tests' includes."""
    stage.environment["GZ_VERSION"] = "harmonic"
    stage.environment["SDF_PATH"] = ":".join(str(folder / one) for one in MODELS)
    return stage


def test_each_case_says_what_sdformat_says(gz: Stage, request: pytest.FixtureRequest) -> None:
    strangers: Path = request.config.getoption("--strangers")
    path = request.config.getoption("--sdf-cases") or strangers / "h09_expect.json"
    if not path.is_file():
        pytest.skip(f"'{path}' is not there; --sdf-cases FILE says where the cases are")
    cases = json.loads(path.read_text())
    assert len(cases) == 63
    wrong = []
    valid = 0
    for case in cases:
        checked = gz.run(f"{case['cmd']} {case['file']}")
        wanted = [one for one in case["expect_substrings"] if not one.startswith(NOT_OF_CHECKS)]
        missing = [one for one in wanted if one not in checked.output]
        missing += [f"not {one}" for one in case["reject_substrings"] if one in checked.output]
        is_valid = any(one.startswith("Valid.") for one in wanted)
        valid += is_valid
        if is_valid != (VALID in checked.stdout) or is_valid != (checked.code == 0):
            missing.append(f"exit code {checked.code}")
        if missing:
            wrong.append((case["file"], missing))
    assert not wrong
    assert valid == 32


def test_errors_of_xml_and_of_attributes_have_a_line(gz: Stage) -> None:
    bad = gz.run("gz sdf -k sdformat/test/sdf/box_bad_test.world")
    assert bad.code != 0
    assert "Required attribute" in bad.output
    assert "box_bad_test.world:L6" in bad.output
    broken = gz.run("gz sdf -k sdformat/test/sdf/invalid_xml_syntax.sdf")
    assert broken.code != 0
    assert "Error parsing XML in file" in broken.output
    assert "invalid_xml_syntax.sdf:8:" in broken.output


def printed(gz: Stage, file: str) -> tuple[ElementTree.Element, Counter[str]]:
    """The model that `gz sdf -p` makes of a robot, and how many elements of each kind it has."""
    ran = gz.run(f"gz sdf -p {file}")
    assert ran.code == 0, ran.output
    model = ElementTree.fromstring(ran.stdout).find("model")
    assert model is not None
    return model, Counter(one.tag for one in model)


def test_fixed_joints_are_lumped_unless_a_robot_says_no(gz: Stage) -> None:
    model, count = printed(gz, f"{INTEGRATION}/fixed_joint_reduction.urdf")
    assert (count["link"], count["joint"]) == (5, 5)
    names = {str(one.get("name")) for one in model.findall("link")}
    assert names == {"link0", "link1", "link2", "link3", "link1a"}
    mass = model.find("link[@name='link1a']/inertial/mass")
    assert mass is not None and float(mass.text or "") == pytest.approx(700.0)
    model, count = printed(gz, f"{INTEGRATION}/fixed_joint_reduction_disabled.urdf")
    # The one of its two fixed joints that it names is kept.
    assert (count["link"], count["joint"]) == (6, 6)
    assert model.find("joint[@name='joint12a']") is not None


def test_mimic_is_kept(gz: Stage) -> None:
    model, _ = printed(gz, "sdformat/test/sdf/joint_mimic_rack_pinion.urdf")
    mimic = model.find("joint[@name='rack_joint']/axis/mimic")
    assert mimic is not None
    assert mimic.get("joint") == "upper_joint"
    assert mimic.findtext("multiplier") == "0.105"


def test_a_force_torque_sensor_without_a_link_is_warned_of(gz: Stage) -> None:
    massless = f"{INTEGRATION}/invalid_force_torque_sensor_massless_child_link.urdf"
    said = gz.run(f"gz sdf -p {massless}").output
    assert "link[link_1] has no <inertial> block defined." in said
    assert "parent joint[joint_1] ignored." in said
    assert "link[link_1] is not modeled in sdf." in said
    # sdformat says nothing of the other one, which is lumped (its urdf_to_sdf.cc wants silence).
    model, _ = printed(gz, f"{INTEGRATION}/invalid_force_torque_sensor_lumped_and_reduced.urdf")
    assert {one.get("name") for one in model.findall("frame")} == {"joint_1", "link_1"}
