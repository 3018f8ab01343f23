"""roslaunch XML: what real roslaunch printed for the same files, and one diagnostic a mistake."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
import yaml

from gazelle.diagnostics import Diagnostics
from gazelle.launch.console import dump_text
from gazelle.launch.launch_config import LaunchConfig
from gazelle.launch.ros1.loader import load_launch_files, load_launch_text
from gazelle.workspace import Workspace


def _load(text: str, tmp_path: Path, **args: str) -> tuple[LaunchConfig, Diagnostics]:
    file = tmp_path / "a.launch"
    file.write_text(text, encoding="utf-8")
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd=tmp_path)
    config = load_launch_files([file], args, workspace=workspace, diagnostics=diagnostics)
    return config, diagnostics


def _params(body: str, tmp_path: Path) -> dict[str, object]:
    config, diagnostics = _load(f"<launch>{body}</launch>", tmp_path)
    assert not diagnostics.errors, [str(item) for item in diagnostics]
    return config.params


@pytest.fixture
def demo(oracles_dir: Path) -> Path:
    return oracles_dir / "demo_pkg"


def _load_demo(demo: Path, name: str, **args: str) -> tuple[LaunchConfig, Diagnostics]:
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={"ROS_PACKAGE_PATH": str(demo)}, cwd=demo)
    config = load_launch_files(
        [demo / "launch" / name], args, workspace=workspace, diagnostics=diagnostics
    )
    return config, diagnostics


def _oracle_stdout(path: Path) -> str:
    text = path.read_text(encoding="utf-8")
    return text.split("[stdout]\n")[1].split("[stderr]")[0]


@pytest.mark.reference
def test_parameters_equal_those_of_real_roslaunch(demo: Path, oracles_dir: Path) -> None:
    config, diagnostics = _load_demo(demo, "main.launch", req="1")
    assert not diagnostics.errors, [str(item) for item in diagnostics]
    expected = yaml.safe_load(_oracle_stdout(oracles_dir / "roslaunch" / "dump_params.txt"))
    found = yaml.safe_load(dump_text(config))
    for name in ("/anon_p", "/find_p"):
        expected[name] = expected[name].replace("/example//src/demo_pkg", str(demo))
    expected["/env_home"] = found["/env_home"]
    assert found == expected
    assert {key: type(value) for key, value in found.items()} == {
        key: type(value) for key, value in expected.items()
    }


@pytest.mark.reference
def test_nodes_and_files_equal_those_of_real_roslaunch(demo: Path, oracles_dir: Path) -> None:
    config, _ = _load_demo(demo, "main.launch", req="1")
    nodes = [item.full_name for item in (*config.nodes, *(test.node for test in config.tests))]
    assert nodes == _oracle_stdout(oracles_dir / "roslaunch" / "nodes.txt").split()
    files = [Path(line).name for line in dict.fromkeys(config.files)]
    assert files == ["main.launch", "inc.launch"]
    node = next(item for item in config.nodes if item.full_name == "/alpha/sub/n1")
    assert node.remaps == (("/scan", "laser/scan"), ("odom", "odometry"))
    assert node.env == (("GLOBAL_ENV", "g"), ("E1", "v"))
    assert (node.args, node.respawn, node.respawn_delay_s) == ("--a 3", True, 2.0)
    assert node.output == "screen"


_ORACLE_CODES = {
    "e_argredecl": "launch.arg-redeclared",
    "e_badattr": "xml.unknown-attribute",
    "e_badenv": "launch.env-missing",
    "e_badif": "launch.bad-attribute",
    "e_badtag": "xml.unknown-tag",
    "e_badxml": "xml.malformed",
    "e_badyaml": "launch.bad-yaml",
    "e_both": "launch.if-and-unless",
    "e_cmdfail": "launch.param-command-failed",
    "e_dupnode": "launch.duplicate-node",
    "e_eval": "launch.substitution",
    "e_evalimport": "launch.substitution",
    "e_nodename": "launch.bad-node-name",
    "e_noinc": "launch.include-missing",
    "e_nopkg": "launch.package-missing",
    "e_paramtype": "launch.bad-param",
    "e_req": "launch.arg-missing",
    "e_root": "launch.no-root",
    "e_undeclared": "launch.arg-undeclared",
    "e_unusedinc": "launch.arg-unused",
}


@pytest.mark.reference
def test_files_that_real_roslaunch_refuses_get_one_diagnostic(demo: Path) -> None:
    for name, code in _ORACLE_CODES.items():
        _, diagnostics = _load_demo(demo, f"{name}.launch")
        found = diagnostics.by_code(code)
        assert found, name
        assert all(item.span is not None and item.span.line >= 1 for item in found), name


_NODE = '<node pkg="p" type="t" name="n"/>'


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (
            '<launch>\n<arg name="a"/>\n<arg name="a" default="1"/></launch>',
            "launch.arg-redeclared",
        ),
        (
            '<launch>\n<node pkg="p" type="t" name="n" colour="red"/></launch>',
            "xml.unknown-attribute",
        ),
        ('<launch>\n<param name="a" value="$(env NO_SUCH_PLACE)"/></launch>', "launch.env-missing"),
        ('<launch>\n<group if="perhaps"/></launch>', "launch.bad-attribute"),
        ("<launch>\n<nodes/></launch>", "xml.unknown-tag"),
        ("<launch>\n<group></launch>", "xml.malformed"),
        ("<launch>\n<rosparam>a: [1</rosparam></launch>", "launch.bad-yaml"),
        ('<launch>\n<group if="1" unless="0"/></launch>', "launch.if-and-unless"),
        ('<launch>\n<param name="a" command="false"/></launch>', "launch.param-command-failed"),
        (f"<launch>\n{_NODE}\n{_NODE}</launch>", "launch.duplicate-node"),
        ('<launch>\n<param name="a" value="$(eval 1 +)"/></launch>', "launch.substitution"),
        ('<launch>\n<node pkg="p" type="t" name="a b"/></launch>', "launch.bad-node-name"),
        ('<launch>\n<include file="/no/such.launch"/></launch>', "launch.include-missing"),
        ('<launch>\n<include file="$(find no_pkg)/a.launch"/></launch>', "launch.package-missing"),
        ('<launch>\n<param name="a" type="int" value="much"/></launch>', "launch.bad-param"),
        (
            '<launch>\n<arg name="a"/>\n<param name="b" value="$(arg a)"/></launch>',
            "launch.arg-missing",
        ),
        ("<robot>\n</robot>", "launch.no-root"),
        ('<launch>\n<param name="a" value="$(arg b)"/></launch>', "launch.arg-undeclared"),
        (
            '<launch>\n<include file="$(dirname)/b.launch"><arg name="x" value="1"/></include>'
            "</launch>",
            "launch.arg-unused",
        ),
    ],
)
def test_a_mistake_has_a_place_and_a_code(tmp_path: Path, text: str, code: str) -> None:
    (tmp_path / "b.launch").write_text("<launch/>", encoding="utf-8")
    _, diagnostics = _load(text, tmp_path)
    found = diagnostics.by_code(code)
    assert found, [str(item) for item in diagnostics]
    assert all(item.span is not None and item.span.line >= 1 for item in found)


def test_all_mistakes_of_a_file_show_at_once(tmp_path: Path) -> None:
    text = """<launch>
  <param name="a" value="$(arg nope)"/>
  <parm name="b" value="1"/>
  <node pkg="p" type="t" name="x/y"/>
  <param name="good" value="1"/>
</launch>"""
    config, diagnostics = _load(text, tmp_path)
    codes = [item.code for item in diagnostics]
    assert codes == ["launch.arg-undeclared", "xml.unknown-tag", "launch.bad-node-name"]
    assert [item.span.line for item in diagnostics if item.span] == [2, 3, 4]
    assert "did you mean 'param'" in diagnostics.by_code("xml.unknown-tag")[0].fix
    assert config.params == {"/good": 1}


def test_tags_that_need_a_package_of_ros_that_is_not_here_are_left_out(tmp_path: Path) -> None:
    text = """<launch>
  <include file="$(find rosbridge_server)/launch/rosbridge_websocket.launch"/>
  <rosparam command="load" file="$(find interactive_marker_twist_server)/config/planar.yaml"/>
  <arg name="camera" default="$(find rgbd_launch)"/>
  <include file="$(arg camera)/launch/kinect_frames.launch"/>
  <param name="good" value="1"/>
</launch>"""
    config, diagnostics = _load(text, tmp_path)
    assert config.params == {"/good": 1}
    assert not diagnostics.errors
    assert [item.code for item in diagnostics] == ["launch.package-elsewhere"] * 3
    assert [item.span.line for item in diagnostics if item.span] == [2, 3, 4]
    (bridge, *_) = diagnostics
    assert "$(find rosbridge_server): package 'rosbridge_server' not found" in bridge.message
    assert bridge.fix.startswith("rosbridge_server is a bridge to programs outside of ROS")


def test_what_needs_an_unreadable_argument_says_nothing_more(tmp_path: Path) -> None:
    text = """<launch>
  <arg name="model" default="$(env NO_SUCH_MODEL)"/>
  <arg name="file" default="$(arg model).urdf"/>
  <param name="a" value="$(arg file)"/>
  <param name="b" value="$(eval 'x' + arg('model'))"/>
  <include file="$(arg model).launch"/>
  <param name="good" value="1"/>
</launch>"""
    config, diagnostics = _load(text, tmp_path)
    assert [item.code for item in diagnostics] == ["launch.env-missing"]
    assert config.params == {"/good": 1}


def test_a_mistake_in_an_include_names_the_way_there(tmp_path: Path) -> None:
    (tmp_path / "inner.launch").write_text("<launch>\n<param name='p'/>\n</launch>")
    _, diagnostics = _load('<launch>\n <include file="inner.launch"/>\n</launch>', tmp_path)
    (found,) = diagnostics
    assert found.code == "launch.bad-param"
    assert found.span is not None
    assert (Path(found.span.file).name, found.span.line) == ("inner.launch", 2)
    assert [(Path(item.file).name, item.line) for item in found.span.via] == [("a.launch", 2)]


def test_include_cycle_is_cut_and_shows_the_chain(tmp_path: Path) -> None:
    (tmp_path / "b.launch").write_text('<launch><include file="a.launch"/></launch>')
    _, diagnostics = _load('<launch><include file="b.launch"/></launch>', tmp_path)
    (found,) = diagnostics.by_code("launch.include-cycle")
    assert found.message.count("a.launch") == 2


def test_fixed_argument_cannot_be_given_another_value(tmp_path: Path) -> None:
    _, diagnostics = _load('<launch><arg name="a" value="1"/></launch>', tmp_path, a="2")
    (found,) = diagnostics.by_code("launch.arg-fixed")
    assert "cannot override arg 'a', which has already been set to '1'" in found.message


def test_argument_of_the_command_line_that_nothing_declares_is_a_warning(tmp_path: Path) -> None:
    _, diagnostics = _load('<launch><arg name="world" default=""/></launch>', tmp_path, wrld="x")
    (found,) = diagnostics.by_code("launch.arg-unused-command-line")
    assert "unused args [wrld]" in found.message
    assert "world" in found.message


def test_argument_that_an_included_file_does_not_have_is_told_at_its_line(tmp_path: Path) -> None:
    inner = tmp_path / "inner.launch"
    inner.write_text('<launch><arg name="world" default=""/></launch>')
    body = f'<include file="{inner}">\n<arg name="wrold" value="x"/></include>'
    _, diagnostics = _load(f"<launch>{body}</launch>", tmp_path)
    (found,) = diagnostics.by_code("launch.arg-unused")
    assert (found.span and found.span.line, found.fix) == (2, "did you mean 'world'?")


def test_arguments_of_a_group_do_not_leak_out_of_it(tmp_path: Path) -> None:
    body = """<group><arg name="a" default="1"/></group><param name="p" value="$(arg a)"/>"""
    _, diagnostics = _load(f"<launch>{body}</launch>", tmp_path)
    assert diagnostics.by_code("launch.arg-undeclared")


def test_remaps_apply_to_the_nodes_that_follow_in_their_scope(tmp_path: Path) -> None:
    text = """<launch>
      <node pkg="p" type="t" name="before"/>
      <group><remap from="a" to="b"/><node pkg="p" type="t" name="inside"/></group>
      <remap from="c" to="d"/><remap from="c" to="e"/>
      <node pkg="p" type="t" name="after"/>
    </launch>"""
    config, _ = _load(text, tmp_path)
    remaps = {node.name: node.remaps for node in config.nodes}
    assert remaps == {"before": (), "inside": (("a", "b"),), "after": (("c", "e"),)}


def test_private_parameter_above_a_node_belongs_to_the_nodes_that_follow(tmp_path: Path) -> None:
    body = """<param name="~rate" value="5"/><node pkg="p" type="t" name="n" ns="x"/>"""
    assert _params(body, tmp_path) == {"/x/n/rate": 5}


def test_parameters_inside_a_node_are_private(tmp_path: Path) -> None:
    body = """<node pkg="p" type="t" name="n"><param name="a" value="1.0"/>
      <rosparam>
        b: 1e-3
        c: {d: on}
      </rosparam></node>"""
    assert _params(body, tmp_path) == {"/n/a": 1.0, "/n/b": "1e-3", "/n/c/d": True}


@pytest.mark.parametrize(
    ("text", "value"),
    [("5", 5), ("5.0", 5.0), ("1e-3", "1e-3"), ("0x10", "0x10"), ("007", 7), ("True", True),
     ("hello world", "hello world"), ("", "")],
)  # fmt: skip
def test_untyped_values_follow_roslaunch(tmp_path: Path, text: str, value: object) -> None:
    found = _params(f'<param name="p" value="{text}"/>', tmp_path)["/p"]
    assert (found, type(found)) == (value, type(value))


def test_deg_and_rad_in_yaml_become_radians(tmp_path: Path) -> None:
    found = _params("<rosparam>{a: deg(180), b: rad(pi/2)}</rosparam>", tmp_path)
    assert found == {
        "/a": pytest.approx(3.141592653589793),
        "/b": pytest.approx(1.5707963267948966),
    }


def test_binary_file_parameter_is_bytes(tmp_path: Path) -> None:
    (tmp_path / "b.bin").write_bytes(b"\x00\xff")
    assert _params('<param name="p" binfile="$(dirname)/b.bin"/>', tmp_path) == {"/p": b"\x00\xff"}


def test_unreadable_text_file_is_reported_with_its_path(tmp_path: Path) -> None:
    (tmp_path / "robot.urdf").write_text("<robot/>")
    body = '<param name="p" textfile="$(dirname)/robt.urdf"/>'
    _, diagnostics = _load(f"<launch>{body}</launch>", tmp_path)
    (found,) = diagnostics.by_code("xml.unreadable")
    assert found.message == f"textfile '{tmp_path}/robt.urdf': No such file or directory"
    assert found.fix == "did you mean 'robot.urdf'?"


def test_command_output_is_the_value_and_xacro_needs_no_program(tmp_path: Path) -> None:
    (tmp_path / "r.xacro").write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:arg name="n" default="a"/><link name="$(arg n)"/></robot>'
    )
    body = """<param name="e" command="printf 1.5"/>
      <param name="x" command="$(find xacro)/xacro --inorder $(dirname)/r.xacro n:=b"/>"""
    found = _params(body, tmp_path)
    assert found["/e"] == "1.5"
    assert '<link name="b"/>' in str(found["/x"])


def test_a_wrapper_of_another_python_still_finds_xacro(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "r.xacro").write_text('<robot name="r"><link name="b"/></robot>')
    wrapper = tmp_path / "env_run"
    wrapper.write_text('#!/bin/sh\nexec "$@"\n')
    wrapper.chmod(0o755)
    strange = tmp_path / "bin" / "python3"  # as without an activated environment
    strange.parent.mkdir()
    strange.write_text(f'#!/bin/sh\nexec "{sys.executable}" -S "$@"\n')
    strange.chmod(0o755)
    monkeypatch.setenv("PATH", f"{strange.parent}:/usr/bin:/bin")
    monkeypatch.delenv("PYTHONPATH", raising=False)
    command = "$(dirname)/env_run $(find xacro)/xacro $(dirname)/r.xacro"
    found = _params(f'<param name="x" command="{command}"/>', tmp_path)
    assert '<link name="b"/>' in str(found["/x"])


def test_what_every_shell_with_ros_has_set_is_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("ROS_DISTRO", "ROS_VERSION", "ROS_PYTHON_VERSION"):
        monkeypatch.delenv(name, raising=False)
    body = """<param name="d" value="$(env ROS_DISTRO)"/>
      <param name="v" value="$(env ROS_VERSION)$(optenv ROS_PYTHON_VERSION)" type="str"/>"""
    assert _params(body, tmp_path) == {"/d": "noetic", "/v": "13"}
    monkeypatch.setenv("ROS_DISTRO", "melodic")
    assert _params(body, tmp_path)["/d"] == "melodic"


def test_anonymous_names_are_equal_for_equal_ids(tmp_path: Path) -> None:
    body = """<param name="a" value="$(anon x)"/><param name="b" value="$(anon x)"/>
      <param name="c" value="$(anon y)"/>"""
    found = _params(body, tmp_path)
    assert found["/a"] == found["/b"] != found["/c"]


def test_deprecated_file_says_so(tmp_path: Path) -> None:
    _, diagnostics = _load('<launch deprecated="use b.launch"/>', tmp_path)
    assert "DEPRECATED: use b.launch" in diagnostics.by_code("launch.deprecated")[0].message


def test_unknown_substitution_says_what_exists(tmp_path: Path) -> None:
    _, diagnostics = _load('<launch><param name="p" value="$(fnd x)"/></launch>', tmp_path)
    (found,) = diagnostics.by_code("launch.substitution")
    assert found.fix == "did you mean 'find'?"


def test_empty_substitution_is_reported(tmp_path: Path) -> None:
    _, diagnostics = _load('<launch><param name="p" value="$()"/></launch>', tmp_path)
    (found,) = diagnostics.by_code("launch.substitution")
    assert "unknown substitution '$()'; known are find, env" in found.message


def test_text_from_standard_input_is_a_launch_file_too(tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    config = load_launch_text(
        '<launch><param name="p" value="1"/></launch>',
        {},
        workspace=Workspace.discover(environ={}, cwd=tmp_path),
        diagnostics=diagnostics,
    )
    assert config.params == {"/p": 1}


def test_missing_attribute_is_named(tmp_path: Path) -> None:
    _, diagnostics = _load('<launch><node pkg="p" name="n"/></launch>', tmp_path)
    (found,) = diagnostics.by_code("xml.missing-attribute")
    assert found.message == "<node> tag is missing required attribute 'type'"


def test_find_is_resolved_last_so_that_args_can_complete_it(tmp_path: Path) -> None:
    package = tmp_path / "go_description"
    package.mkdir()
    (package / "package.xml").write_text("<package><name>go_description</name></package>")
    body = """<arg name="name" default="go"/><arg name="dollar" value="$"/>
      <arg name="path" value="(find $(arg name)_description)"/>
      <param name="a" value="$(arg dollar)$(arg path)/robot.xacro"/>
      <param name="b" value="$(find $(arg name)_description)/robot.xacro"/>"""
    found = _params(body, tmp_path)
    assert found["/a"] == found["/b"] == f"{package}/robot.xacro"
