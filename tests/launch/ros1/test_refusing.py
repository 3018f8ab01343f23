"""What the real roslaunch refuses is refused, in the words that it prints."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.workspace import Workspace

NODE = '<node pkg="p" type="t" name="n" {}/>'
TEST = '<test pkg="p" type="t" test-name="n" {}/>'
MACHINE = '<machine name="m" address="a" {}/>'
REFUSED = {
    '<remap from="from something" to="to"/>': "remap from [from something] is not a valid ROS name",
    '<remap from="a" to="b c"/>': "remap to [b c] is not a valid ROS name",
    '<remap from="a//b" to="c"/>': "remap from [a//b] is not a valid ROS name",
    '<env name="A"/>': "<env> tag is missing required name/value attributes",
    NODE.format('respawn="true" required="true"'): "respawn and required cannot both be set",
    NODE.format('ns=""'): "<node> tag has an empty 'ns' attribute",
    '<rosparam file="" command="load"/>': "error loading <rosparam> tag: file does not exist []",
    '<rosparam file="a" command="delete"/>': "'file' attribute is invalid with 'delete' command",
    TEST.format('time-limit="-1"'): "'time-limit' must be a positive number, found -1",
    TEST.format('time-limit="0"'): "'time-limit' must be a positive number, found 0",
    TEST.format('output="screen"'): "<test> tags cannot have 'output' attribute",
    TEST.format('respawn="true"'): "<test> tags cannot have 'respawn' attribute",
    '<group clear_params="true"/>': "'ns' attribute must be set in order to use 'clear_params'",
    '<group ns=""/>': "<group> tag has an empty 'ns' attribute",
    '<include file="a.launch" clear_params="true"/>': "'ns' attribute must be set in order to use",
    MACHINE.format('timeout=""'): "<machine timeout>: '' is not a number",
    MACHINE.format('timeout="ten"'): "<machine timeout>: 'ten' is not a number",
    MACHINE.format('timeout="-1"'): "'timeout' must be a positive number, found -1",
    MACHINE.format('ros-root="/r"'): "<machine>: ros-root is not supported since ROS Fuerte",
    MACHINE.format('ros-ip="1"'): "<machine>: ros-ip is not supported since ROS Fuerte",
    '<machine name="m" address="a"><env name="A" value="b"/></machine>': "<env> is not supported",
}
TAKEN = (
    '<remap from="~a" to="/b/c_1"/>',
    '<env name="A" value=""/>',
    NODE.format('respawn="true" required="false"'),
    '<rosparam command="delete" param="a"/>',
    TEST.format('time-limit="0.5"'),
    '<group ns="a" clear_params="true"/>',
    NODE.format('clear_params="true"'),
    MACHINE.format('timeout="10.0" env-loader="e"'),
)


def errors(body: str, folder: Path, **args: str) -> list[tuple[str, str, str]]:
    file = folder / "a.launch"
    file.write_text(f"<launch>\n{body}\n</launch>")
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd=folder)
    load_launch_files([file], args, workspace=workspace, diagnostics=diagnostics)
    return [(str(item.span), item.message, item.phrase) for item in diagnostics.errors]


@pytest.mark.parametrize("body", REFUSED)
def test_what_roslaunch_refuses_is_an_error_in_its_words(tmp_path: Path, body: str) -> None:
    ((place, message, _phrase),) = errors(body, tmp_path)
    assert place.startswith(f"{tmp_path}/a.launch:2:")
    assert REFUSED[body] in message


@pytest.mark.parametrize("body", TAKEN)
def test_what_roslaunch_takes_is_taken(tmp_path: Path, body: str) -> None:
    assert errors(body, tmp_path) == []


def test_phrases_hold_the_names_of_the_case(tmp_path: Path) -> None:
    file = f"{tmp_path}/a.launch"
    ((_, _, phrase),) = errors('<arg name="rate"/><param name="r" value="$(arg rate)"/>', tmp_path)
    assert phrase == f"RLException: [{file}] requires the 'rate' arg to be set"
    ((_, _, phrase),) = errors('<arg name="a" default="1"/><arg name="a" default="2"/>', tmp_path)
    assert phrase == "RLException: arg 'a' has already been declared"
    ((_, _, phrase),) = errors(NODE.format("") + NODE.format(""), tmp_path)
    assert phrase == "RLException: roslaunch file contains multiple nodes named [/n]"
    ((_, _, phrase),) = errors('<param name="a" value="$(env NOT_SET)"/>', tmp_path)
    assert phrase == "environment variable 'NOT_SET' is not set"


def test_phrase_of_an_included_file_names_it(tmp_path: Path) -> None:
    inner = tmp_path / "inner.launch"
    inner.write_text('<launch><arg name="x"/><param name="r" value="$(arg x)"/></launch>')
    ((_, _, phrase),) = errors('<include file="inner.launch"/>', tmp_path)
    assert phrase == f"RLException: included file [{inner}] requires the 'x' arg to be set"
    ((_, _, phrase),) = errors(
        '<include file="inner.launch"><arg name="x" value="1"/><arg name="y" value="1"/></include>',
        tmp_path,
    )
    assert phrase == f"RLException: unused args [y] for include of [{inner}]"
