"""The front of all checks: clean fixtures and robots that run well raise nothing."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from tests.description.checks.pain import FIXTURES, OWN, examined, finding, place
from tests.shared_files import SHARED, shared_cases

from gazelle.description.checks import SUPERSEDED_CODES, check_description
from gazelle.description.loader import load_models
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics, Severity

REPOSITORY = Path(__file__).parents[3]
CLEAN = [path for pain in OWN for path in sorted((FIXTURES / pain / "clean").glob("*.urdf"))]
BROKEN = [path for pain in OWN for path in sorted((FIXTURES / pain / "broken").glob("*.urdf"))]
# Of these the plug-in is wrong, which the simulator and the probes say.
SEEN_BY_PROBES = {"backwards.urdf", "radius_as_diameter.urdf", "swapped.urdf"}
KNOWN_TO_RUN = {
    "examples/arm_ws/src/heron_description/urdf/heron.urdf.xacro": set(),
    # Its masses come from a macro.
    "examples/four_wheel_ws/src/courier_robot/urdf/courier.urdf.xacro": set(),
    "examples/pr2_style_ws/src/tandem_controller/urdf/robot.xml": set(),
    "examples/scout_ws/src/scout_robot/urdf/scout.urdf.xacro": set(),
    # SDF's defaults: 1 kg for everything.
    "tests/workspaces/ros1/src/yard_gazebo/models/barrow/model.sdf": {"inertia.missing"},
}
SAMPLES_KNOWN_TO_RUN = {
    "catkin_ws/src/urdf_tutorial/urdf/mobile_robot.urdf": set(),
    "catkin_ws/src/urdf_exam/urdf/mira_gazebo.urdf": set(),
    "catkin_ws/src/urdf_exam/urdf/mira_gazebo_camera.urdf": set(),
    "catkin_ws/src/urdf_exam/urdf/mira_gazebo_controller.urdf": set(),
    # 4 g of caster below 22 kg.
    "catkin_ws/src/slam_robot/urdf/slam_robot_gazebo.urdf": {"inertia.mass-ratio"},
    # SDF's defaults: 1 kg for everything.
    "gazebo_models/my_robot/model.sdf": {"inertia.missing"},
    "ros2_ws/src/luck_description/urdf/luck_description.urdf": set(),
    "turtlebot3_ws/src/turtlebot3/turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro": set(),
    "turtlebot3_ws/src/turtlebot3/turtlebot3_description/urdf/turtlebot3_waffle.urdf.xacro": set(),
}


@pytest.mark.parametrize("path", CLEAN, ids=lambda path: f"{path.parts[-3]}/{path.name}")
def test_clean_robot_has_no_finding(path: Path) -> None:
    assert list(examined(path)) == []


@pytest.mark.parametrize("path", BROKEN, ids=lambda path: f"{path.parts[-3]}/{path.name}")
def test_broken_robot_has_findings_with_place_and_fix(path: Path) -> None:
    found = list(examined(path))
    assert bool(found) == (path.name not in SEEN_BY_PROBES)
    for item in found:
        assert item.span is not None
        assert item.span.file == str(path)
        assert item.span.line > 1
        assert item.fix


@pytest.mark.parametrize(
    ("file", "codes"),
    [
        *((REPOSITORY / name, codes) for name, codes in KNOWN_TO_RUN.items()),
        *shared_cases(
            *((SHARED / "workspaces" / name, codes) for name, codes in SAMPLES_KNOWN_TO_RUN.items())
        ),
    ],
)
def test_robot_that_runs_well_has_no_warning_but_true_ones(file: Path, codes: set[str]) -> None:
    warned = {item.code for item in examined(file) if item.severity > Severity.INFO}
    assert warned == codes


def test_static_model_is_spared_what_needs_motion() -> None:
    found = Diagnostics()
    check_description(Model("wall", static=True), diagnostics=found)
    assert list(found) == []


def test_more_inertia_than_fits_is_a_notice_only() -> None:
    item = finding("pain_05_tensor/placeholder.urdf")
    assert (item.code, item.severity) == ("inertia.box", Severity.INFO)
    assert "too large for its shapes of 0.3 × 0.05 × 0.05 m" in item.message


@pytest.mark.parametrize(
    ("file", "code", "words", "line"),
    [
        ("triangle.urdf", "inertia.triangle", "0.0001 + 0.0001 < 0.006", "<inertia ixx="),
        ("gram_millimetres.urdf", "inertia.units", "in g·mm², not kg·m²", "<inertial>"),
        ("millimetre_origin.urdf", "inertia.units", "centre of mass is in milli", "<inertial>"),
        ("zero_mass.urdf", "inertia.mass", "'arm' has a mass of 0 kg", "<mass "),
    ],
)
def test_bad_mass_properties_come_with_a_block(file: str, code: str, words: str, line: str) -> None:
    item = finding(f"pain_05_tensor/{file}")
    assert item.code == code
    assert words in item.message
    assert place(item).startswith(line)
    assert item.fix.startswith('paste into <link name="arm">\n<inertial>')
    assert '<mass value="0.75"/>' in item.fix
    assert '<origin xyz="0.15 0 0" rpy="0 0 0"/>' in item.fix


def test_negative_moment_is_an_error() -> None:
    found = examined(FIXTURES / "pain_05_tensor/broken/negative.urdf")
    (item,) = found.by_code("inertia.not-positive")
    assert item.severity is Severity.ERROR
    assert "A link named ... has invalid inertia." in item.phrase


def test_mass_ratio_names_both_bodies() -> None:
    item = finding("pain_05_tensor/mass_ratio.urdf")
    assert item.code == "inertia.mass-ratio"
    assert "'base_footprint' of 4 kg and 'bead' of 0.002 kg: 1 to 2,000" in item.message
    assert place(item).startswith('<joint name="thread"')
    assert "give 'bead' at least 0.004 kg" in item.fix


@pytest.mark.parametrize("number", ["nan", "inf", "-1", "0", "1e200", "1e308", "1e-320", "", "x"])
@pytest.mark.parametrize("word", ["radius", "length", "xyz", "mass value", "ixx", "axis xyz"])
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_numbers_out_of_this_world_raise_nothing(word: str, number: str) -> None:
    text = (FIXTURES / "pain_14_wheels/clean/rover.urdf").read_text(encoding="utf-8")
    count = 3 if "xyz" in word else 1
    broken = re.sub(rf'{word}="[^"]*"', f'{word}="{" ".join([number] * count)}"', text)
    assert broken != text
    for model in load_models(broken, workspace=None, diagnostics=Diagnostics()):
        check_description(model, diagnostics=Diagnostics())


def test_codes_of_readers_that_are_said_again_are_named() -> None:
    assert {"urdf.no-inertia", "urdf.bad-inertia"} <= SUPERSEDED_CODES
