"""Headers of generate_parameter_library's files."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cpp.interfaces import parameter_header
from gazelle.cpp.interfaces.parameter_files import read_parameter_file
from gazelle.errors import UserFileError

_YAML = """\
arm_controller:
  joints:
    type: string_array
    default_value: ["a", "b"]
    description: "which joints"
    read_only: true
    validation:
      size_gt<>: [0]
      unique<>: null
  rate: {type: double, default_value: 1, description: "", validation: {gt<>: [0.0]}}
  tiny: {type: double, default_value: 1e-9}
  count: {type: int, validation: {bounds<>: [1, 5], "own::even": null}}
  label: {type: string_fixed_8, default_value: "arm"}
  weights: {type: double_array_fixed_3, default_value: [1.0]}
  filters: {type: none, description: "only told"}
  gains:
    __map_joints:
      p: {type: double, default_value: 2.0, validation: {gt_eq<>: [0.0001]}}
"""


def _text(tmp_path: Path, yaml: str = _YAML) -> str:
    file = tmp_path / "arm.yaml"
    file.write_text(yaml, encoding="utf-8")
    header = parameter_header(file, "arm_parameters", tmp_path, "arm", "own.hpp")
    assert header == tmp_path / "arm_parameters.hpp"
    assert "<arm_parameters.hpp>" in (tmp_path / "arm/arm_parameters.hpp").read_text("utf-8")
    return header.read_text(encoding="utf-8")


def test_the_structure_is_that_of_the_file(tmp_path: Path) -> None:
    text = _text(tmp_path)
    for line in (
        '#include "own.hpp"',
        "namespace arm_controller {",
        '  std::vector<std::string> joints = {"a", "b"};',
        "  double rate = 1.0;",
        "  double tiny = 1e-09;",
        "  int64_t count{};",
        '  rsl::StaticString<8> label = "arm";',
        "  rsl::StaticVector<double, 3> weights = {1.0};",
        "    std::map<std::string, MapJoints> joints_map;",
        "class ParamListener",
    ):
        assert f"{line}\n" in text, line
    assert "filters" not in text


def test_values_are_checked_and_limits_told(tmp_path: Path) -> None:
    text = _text(tmp_path)
    assert "size_gt<std::string>(parameter, 0)" in text
    assert "unique<std::string>(parameter)" in text
    assert "bounds<int64_t>(parameter, 1ll, 5ll)" in text
    assert "own::even(parameter)" in text
    assert "size_lt<double>(parameter, 4)" in text
    assert "std::int64_t(1ll), std::int64_t(5ll)" in text
    assert "std::nextafter(0.0, std::numeric_limits<double>::infinity())" in text


def test_entries_of_maps_are_called_by_their_keys(tmp_path: Path) -> None:
    text = _text(tmp_path)
    assert "for (const std::string &key2 : p.joints) {" in text
    assert 'std::string("gains.") + key2 + "." + "p"' in text


@pytest.mark.parametrize(
    ("yaml", "line", "words"),
    [
        ("a:\n  x: {type: dubble}\n", 2, "type 'dubble' is not known"),
        ("a:\n  x: 3\n", 2, "'x' is neither a parameter nor a group"),
        ("a:\n  x: {type: int_array, default_value: 1}\n", 2, "is a list"),
        ("a: {}\nb: {}\n", 1, "one outermost key"),
        ("a: [\n", 2, "expected the node content"),
    ],
)
def test_mistakes_are_told_at_their_lines(tmp_path: Path, yaml: str, line: int, words: str) -> None:
    file = tmp_path / "bad.yaml"
    file.write_text(yaml, encoding="utf-8")
    with pytest.raises(UserFileError) as error:
        read_parameter_file(file)
    found = error.value.diagnostics[0]
    assert found.code == "interfaces.parameter-file"
    assert words in found.message
    assert found.span.line == line
