"""urdfdom's verdict: against the recorded runs of the real one, and what those lack."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from tests.description.recorded_robots import OWN, SAMPLES, RecordedRobots
from tests.shared_files import shared_cases

from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader import read_urdf
from gazelle.description.urdfdom_emulation import tree_text, urdfdom_verdict, verdict_of_element
from gazelle.description.urdfdom_emulation.tinyxml import parse_tinyxml
from gazelle.diagnostics import Diagnostics, Severity

_FAILED = "ERROR: Model Parsing the xml failed\n"
_JOINT = '<joint name="j" type="{}"><parent link="a"/><child link="b"/>{}</joint>'
# Each with the remark urdfdom makes; all of them end the file.
_BAD_PARTS = [
    ("<dynamics damping='x'/>", "damping value (x) is not a valid float"),
    ("<dynamics friction='x'/>", "friction value (x) is not a valid float"),
    ("<limit upper='x'/>", "upper value (x) is not a valid float"),
    ("<limit effort='x'/>", "effort value (x) is not a valid float"),
    ("<limit effort='1' velocity='x'/>", "velocity value (x) is not a valid float"),
    ("<mimic joint='k' offset='x'/>", "offset value (x) is not a valid float"),
    ("<mimic joint='k' multiplier='x'/>", "multiplier value (x) is not a valid float"),
    ("<safety_controller k_velocity='x'/>", "k_velocity value (x) is not a valid float"),
    ("<safety_controller k_position='x'/>", "k_position value (x) is not a valid float"),
    ("<calibration falling='x'/>", "falling value (x) is not a valid float"),
    ("<origin rpy='x'/>", "Unable to parse component [x] to a double"),
]
_BAD_SHAPES = [
    ("<sphere radius='x'/>", "radius [x] is not a valid float"),
    ("<box size='1'/>", "Parser found 1 elements but 3 expected"),
    ("<cylinder length='x' radius='1'/>", "length [x] is not a valid float"),
    ("<cylinder length='1' radius='x'/>", "radius [x] is not a valid float"),
    ("", "Geometry tag contains no child element."),
]


def _robot(inside: str, version: str = "") -> str:
    return f'<robot name="r"{version}>{inside}</robot>\n'


def _remarks(text: str) -> list[str]:
    return [remark.message for remark in urdfdom_verdict(text).remarks]


@pytest.mark.parametrize("robots", [OWN, *shared_cases(SAMPLES)])
def test_all_recorded_verdicts_are_met_to_the_byte(robots: RecordedRobots) -> None:
    assert len(robots.names) == 53
    for name in robots.names:
        real = robots.run(name)
        verdict = urdfdom_verdict(real.text + "\n")
        out = tree_text(verdict.robot) if verdict.robot else ""
        err = "".join(f"{remark}\n" for remark in verdict.remarks)
        assert (0 if verdict.robot else 255) == real.code, name
        assert out == real.out, name
        assert err + ("" if verdict.robot else _FAILED) == real.err, name


_PASSED_BY_URDFDOM = {
    "bad_number_inertia": "xml.bad-number",
    "bad_number_mass": "xml.bad-number",
    "bad_rgba": "urdf.bad-rgba",
    "box_no_size": "urdf.geometry-incomplete",
    "cylinder_no_length": "urdf.geometry-incomplete",
    "link_no_name": "urdf.link-no-name",
    "mass_no_value": "urdf.inertial-incomplete",
    "mesh_bad_scale": "xml.bad-number",
    "mesh_no_filename": "urdf.geometry-incomplete",
    "missing_izz": "urdf.inertial-incomplete",
    "nan_mass": "xml.bad-number",
    "neg_mass": "urdf.negative-mass",
    "no_inertia": "urdf.inertial-incomplete",
    "sphere_no_radius": "urdf.geometry-incomplete",
    "trailing_number": "xml.bad-number",
    "two_parents": "urdf.two-parents",
    "undefined_material": "urdf.material-undefined",
    "unknown_geom": "urdf.geometry-unknown",
    "unknown_tag": "xml.unknown-tag",
    "zero_axis": "urdf.zero-axis",
}
_CLEAN = {"floating_planar", "good"}


@pytest.mark.parametrize("robots", [OWN, *shared_cases(SAMPLES)])
def test_our_findings_name_all_that_urdfdom_passes(robots: RecordedRobots) -> None:
    for name in robots.names:
        real = robots.run(name)
        diagnostics = Diagnostics()
        read_urdf(real.text, context=ReadContext(None, diagnostics, f"{name}.urdf"))
        codes = {item.code for item in diagnostics if item.severity is not Severity.INFO}
        if name in _CLEAN:
            assert codes == {"urdf.no-inertia"}, name
        elif real.code:
            assert diagnostics.errors, name
        else:
            assert _PASSED_BY_URDFDOM[name] in codes, name


def test_the_rest_of_the_robot_survives_a_broken_link() -> None:
    text = _robot(
        '<link name="a"><inertial><origin xyz="0"/></inertial></link><link name="b"/>'
        + _JOINT.format("fixed", "")
    )
    verdict = urdfdom_verdict(text)
    assert verdict.robot is not None
    assert tree_text(verdict.robot).splitlines()[2:] == [
        "root Link: a has 1 child(ren)",
        "    child(1):  b",
    ]
    assert _remarks(text)[-1] == "Could not parse inertial element for Link [a]"


@pytest.mark.parametrize(("part", "remark"), _BAD_PARTS)
def test_a_broken_part_of_a_joint_ends_the_file(part: str, remark: str) -> None:
    text = _robot('<link name="a"/><link name="b"/>' + _JOINT.format("continuous", part))
    remarks = _remarks(text)
    assert remark in remarks[0]
    assert remarks[-1] == "joint xml is not initialized correctly"
    assert urdfdom_verdict(text).robot is None


@pytest.mark.parametrize(("shape", "remark"), _BAD_SHAPES)
def test_a_broken_shape_is_only_remarked(shape: str, remark: str) -> None:
    inside = f"<visual><geometry>{shape}</geometry></visual>"
    text = _robot(f'<link name="a">{inside}</link>')
    remarks = _remarks(text)
    assert remark in remarks[0]
    assert remarks[1:] == ["Could not parse visual element for Link [a]"]
    assert urdfdom_verdict(text).robot is not None


@pytest.mark.parametrize(
    ("version", "remark"),
    [
        ("1.0", ""),
        (" 01.00", ""),
        ("1.1", "Invalid 'version' specified; only version 1.0 is currently supported"),
        ("1", "The version attribute should be in the form 'x.y'"),
        ("1.", "The version attribute should be in the form 'x.y'"),
        ("", "The version attribute should be in the form 'x.y'"),
        ("1.0.0", "The version attribute should be in the form 'x.y'"),
        (".0", "One of the fields of the version attribute is blank"),
        ("a.0", "Version attribute is not an integer"),
        ("1.0b", "Extra characters after the version number"),
        ("-1.0", "Version number must be positive"),
    ],
)
def test_versions_are_two_numbers(version: str, remark: str) -> None:
    text = _robot('<link name="a"/>', f' version="{version}"')
    assert _remarks(text) == ([remark] if remark else [])


def test_materials_of_visuals_are_known_to_later_links() -> None:
    visual = "<visual><geometry><sphere radius='1'/></geometry>{}</visual>"
    colour = "<material name='red'><color rgba='1 0 0 1'/></material>"
    users = visual.format("<material name='red'/>")
    good = _robot(f"<link name='a'>{visual.format(colour)}</link><link name='b'>{users}</link>")
    assert _remarks(good)[0].startswith("Failed to find root link")
    late = _robot(f"<link name='b'>{users}{visual.format(colour)}</link>")
    assert _remarks(late) == ["link 'b' material 'red' undefined."] * 2
    nameless = _robot(f"<link name='a'>{visual.format('<material/>')}</link><material/>")
    assert _remarks(nameless)[:2] == [
        "Material must contain a name attribute",
        "Visual material must contain a name attribute",
    ]


@pytest.mark.parametrize("robots", [OWN, *shared_cases(SAMPLES)])
def test_the_real_program_agrees_where_it_is_installed(
    tmp_path: Path, robots: RecordedRobots
) -> None:
    program = shutil.which("check_urdf", path="/usr/bin:/usr/local/bin")
    if program is None:
        pytest.skip("check_urdf is not installed (apt-get install liburdfdom-tools)")
    file = tmp_path / "robot.urdf"
    for name in ("good", "two_parents", "bad_rgba"):
        text = robots.text(name)
        for place in range(0, len(text), max(1, len(text) // 15)):
            for mutant in (text[:place], text[:place] + text[place + 2 :], f"{text[:place]}&x"):
                _compare(program, file, mutant)


def _compare(program: str, file: Path, text: str) -> None:
    file.write_text(text, encoding="utf-8")
    done = subprocess.run([program, str(file)], capture_output=True, text=True, check=False)
    verdict = urdfdom_verdict(text + "\n")
    err = "".join(f"{remark}\n" for remark in verdict.remarks)
    assert done.returncode == (0 if verdict.robot else 255), text
    assert done.stdout == (tree_text(verdict.robot) if verdict.robot else ""), text
    assert done.stderr == err + ("" if verdict.robot else _FAILED), text


def test_elements_of_another_parser_get_the_same_verdict() -> None:
    text = "<robot name='r'><link name='a'/><link name='b'/></robot>"
    assert verdict_of_element(parse_tinyxml(text)[0]) == urdfdom_verdict(text)
    foreign = verdict_of_element(parse_tinyxml("<sdf/>")[0])
    assert foreign.robot is None
    assert foreign.remarks[0].message == "Could not find the 'robot' element in the xml file"
