"""Configurations of cartographer: the Lua that they are written in."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from gazelle.errors import LaunchError, UserFileError
from gazelle.nodes.slam.cartographer.configuration import read_configuration

USUAL = """
include "map_builder.lua"
include "trajectory_builder.lua"

options = {
  map_builder = MAP_BUILDER,
  trajectory_builder = TRAJECTORY_BUILDER,
  tracking_frame = "imu_link",
  published_frame = 'odom',
  provide_odom_frame = false,
  pose_publish_period_sec = 5e-3,
  rangefinder_sampling_ratio = 1.,
}

MAP_BUILDER.use_trajectory_builder_2d = true
TRAJECTORY_BUILDER_2D.max_range = 3.5 -- metres
TRAJECTORY_BUILDER_2D.submaps.grid_options_2d.resolution = 0.05 * 2
TRAJECTORY_BUILDER_2D.motion_filter.max_angle_radians = math.rad(180)
POSE_GRAPH.constraint_builder.min_score = 0.65
return options
"""


def _read(folder: Path, text: str, **others: str) -> dict[str, Any]:
    (folder / "robot.lua").write_text(text)
    for name, content in others.items():
        (folder / f"{name}.lua").write_text(content)
    flags = {"configuration_directory": str(folder), "configuration_basename": "robot.lua"}
    return read_configuration(flags)


def test_the_usual_form_is_read_without_cartographers_own_files(tmp_path: Path) -> None:
    given = _read(tmp_path, USUAL)
    assert given["MAP_BUILDER.use_trajectory_builder_2d"] is True
    assert (given["tracking_frame"], given["published_frame"]) == ("imu_link", "odom")
    assert given["provide_odom_frame"] is False
    assert given["max_range"] == 3.5
    assert given["resolution"] == 0.1
    key = "TRAJECTORY_BUILDER_2D.motion_filter.max_angle_radians"
    assert given[key] == pytest.approx(math.pi)
    assert given["POSE_GRAPH.constraint_builder.min_score"] == 0.65


def test_tables_reached_by_another_name_are_the_same(tmp_path: Path) -> None:
    text = """
    include "map_builder.lua"
    include "trajectory_builder.lua"
    TRAJECTORY_BUILDER.trajectory_builder_2d.max_range = 7
    MAP_BUILDER.pose_graph.optimize_every_n_nodes = 40
    return { map_builder = MAP_BUILDER }
    """
    given = _read(tmp_path, text)
    assert given == {"max_range": 7.0, "POSE_GRAPH.optimize_every_n_nodes": 40.0}


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("1 + 2 * 3 ^ 2", 19.0),
        ("-2 ^ 2", -4.0),
        ("(1 + 2) * 3", 9.0),
        ("7 % 4 - 10 / 4", 0.5),
        ("0x10 + .5e1", 21.0),
        ('"scan_" .. 1 + 1', "scan_2"),
        ("[[long\nstring]]", "long\nstring"),
        ('"a\\tb"', "a\tb"),
        ("not nil and 1 < 2", True),
        ("false or 'second'", "second"),
        ("nil == false", False),
        ("1 ~= 2", True),
        ("#{ 4, 5, 6 }", 3.0),
        ("({ a = { 8 } }).a[1]", 8.0),
        ("choose(true, 1, 2)", 1.0),
        ("math.max(3, math.abs(-9))", 9.0),
        ("tostring(2) .. tostring(true)", "2true"),
        ("tonumber('5') + '1'", 6.0),
        ("(function (x) return x * 2 end)(4)", 8.0),
    ],
)
def test_expressions_are_worked_out(tmp_path: Path, expression: str, value: Any) -> None:
    given = _read(tmp_path, f"return {{ x = {expression} }}")
    assert given["x"] == value
    assert type(given["x"]) is type(value)


def test_names_functions_and_conditions_work(tmp_path: Path) -> None:
    text = """
    --[[ a comment
    of two lines ]]
    local size, name = 2.5, "base"
    function twice(value) return value * 2 end
    local function rest(n) if n <= 1 then return 1 end return n * rest(n - 1) end
    do local size = 7 end
    local options = { ["frame"] = name; size = twice(size), n = rest(4) }
    if size > 2 then options.big = true elseif size == 0 then options.none = true
    else options.small = true end
    options.gone = nil
    return options
    """
    given = _read(tmp_path, text)
    assert given == {"frame": "base", "size": 5.0, "n": 24.0, "big": True}


def test_own_files_are_included_before_cartographers(tmp_path: Path) -> None:
    text = 'include "common.lua"\ninclude "map_builder.lua"\nMAP_BUILDER.b = A * 2\nreturn {}'
    given = _read(tmp_path, text, common="A = 3", map_builder="MAP_BUILDER = { c = 1 }")
    assert given == {"MAP_BUILDER.b": 6.0, "MAP_BUILDER.c": 1.0}


@pytest.mark.parametrize(
    ("text", "line_column", "message", "fix"),
    [
        ("options = {\n  a = 1\n  b = 2,\n}", "3:3", "'}' expected (to close '{' at line 1)", ""),
        ("return { a = 'x }", "1:14", "unfinished string", "close it with"),
        ("x = = 2", "1:5", "unexpected symbol near '='", ""),
        ("x == 2", "1:3", "syntax error near '=='", "write NAME = VALUE"),
        ("for i = 1, 2 do end", "1:1", "'for' is not understood in a configuration", "one by one"),
        ("MAP_BUILDER.x = 1", "1:13", "attempt to index 'MAP_BUILDER' (a nil value)", "include"),
        (
            'include "map_builder.lua"\nMAP_BUIDLER.x = 1', "2:13", "attempt to index",
            "did you mean 'MAP_BUILDER'",
        ),
        ("x = 1 + nothing", "1:7", "attempt to perform arithmetic on 'nothing' (a nil value)", ""),
        ("x = 'a' .. {}", "1:9", "attempt to concatenate a value (a table value)", ""),
        ("x = maths(2)", "1:10", "attempt to call 'maths' (a nil value)", ""),
        ("x = math.rad('a', 2)", "1:13", "bad argument to 'math.rad'", "give it a number"),
        ('include "map_bilder.lua"', "1:9", "File 'map_bilder.lua' was not found",
         "did you mean 'map_builder.lua'"),
        ("function f() return f() end x = f()", "1:22", "stack overflow", "calls itself"),
        (
            'include "map_builder.lua"\nreturn { x = POSE_GRAPH.n * 2 }', "2:27",
            "the default of POSE_GRAPH.n stands in cartographer's own files", "write the number",
        ),
    ],
)  # fmt: skip
def test_mistakes_are_told_at_their_place(
    tmp_path: Path, text: str, line_column: str, message: str, fix: str
) -> None:
    with pytest.raises(UserFileError) as caught:
        _read(tmp_path, text)
    (found,) = caught.value.diagnostics
    assert str(found.span) == f"{tmp_path / 'robot.lua'}:{line_column}"
    assert message in found.message
    assert fix in found.fix
    assert found.code == "mapping.lua"


def test_a_file_that_returns_nothing_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserFileError, match="the configuration returns no table"):
        _read(tmp_path, "options = {}")


def test_a_file_that_is_not_there_is_told_with_a_name_that_is(tmp_path: Path) -> None:
    (tmp_path / "robot.lua").write_text("return {}")
    flags = {"configuration_directory": str(tmp_path), "configuration_basename": "robbot.lua"}
    with pytest.raises(LaunchError, match=r"cannot be read\n  fix: did you mean 'robot.lua'"):
        read_configuration(flags)
