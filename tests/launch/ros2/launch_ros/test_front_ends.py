"""launch_ros in XML and YAML."""

from __future__ import annotations

from collections.abc import Callable
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from gazelle.launch.ros2 import LaunchContext, LaunchDescription
from gazelle.launch.ros2.frontend import Parser
from gazelle.launch.ros2.frontend.expose import (
    action_parse_methods,
    substitution_parse_methods,
)
from gazelle.launch.ros2.launch_ros import actions as a

Run = Callable[..., Any]


def _described(text: str) -> LaunchDescription:
    root, parser = Parser.load(StringIO(text))
    return parser.parse_description(root)


def _lines(ran: Any) -> list[str]:
    return [line.partition("] ")[2] for line in ran.lines if line.startswith("[show-")]


_NODE = """
<launch>
  <node pkg="demo" exec="show" name="n" namespace="$(var space)" output="screen"
        args="--own $(var space)_b c" ros_args="--log-level warn" if="true">
    <env name="GZ_X" value="1"/>
    <remap from="in" to="out_$(var space)"/>
    <param name="number" value="3"/>
    <param name="text" value="3" type="str"/>
    <param name="deep"><param name="list" value="[1, 2]"/></param>
    <param from="$(var file)" allow_substs="true"/>
  </node>
</launch>"""
_YAML = """
launch:
- node:
    pkg: demo
    exec: show
    name: n
    namespace: $(var space)
    output: screen
    args: --own $(var space)_b c
    ros_args: --log-level warn
    env: [{name: GZ_X, value: '1'}]
    remap: [{from: in, to: out_$(var space)}]
    param:
    - {name: number, value: 3}
    - {name: text, value: '3', type: str}
    - {name: deep, param: [{name: list, value: [1, 2]}]}
    - {from: $(var file), allow_substs: true}
"""


@pytest.mark.parametrize("text", [_NODE, _YAML], ids=["xml", "yaml"])
def test_node_with_everything(run: Run, package: Path, text: str) -> None:
    (package / "p.yaml").write_text("/**: {ros__parameters: {from: $(var space)}}")
    ran = run(*_described(text).entities, space="s", file=str(package / "p.yaml"))
    assert ran.code == 0
    first, *rest = _lines(ran)
    words = first.removeprefix("words: --own s_b c --ros-args --log-level warn --ros-args ")
    assert words.startswith("-r __node:=n -r __ns:=/s --params-file ")
    assert words.endswith(" -r in:=out_s") and words.count("--params-file") == 4
    assert "    number: 3" in rest and "    text: '3'" in rest
    assert "    deep.list:" in rest and "    - 1" in rest
    assert "/**: {ros__parameters: {from: s}}" in rest


_SCOPE = """
<launch>
  <set_ros_log_dir new_log_dir="below"/>
  <set_use_sim_time value="false"/>
  <group>
    <push_ros_namespace namespace="one"/>
    <push-ros-namespace namespace="two"/>
    <set_parameter name="x" value="[1, 2]"/>
    <set_parameters_from_file filename="$(find-pkg-share demo)/p.yaml"/>
    <set_remap from="a" to="b"/>
    <node pkg="demo" exec="show" output="screen"/>
  </group>
  <ros_timer period="0.01"><node pkg="demo" exec="show" output="screen" args="late"/></ros_timer>
  <executable cmd="$(exec-in-pkg show demo) $(find-pkg-prefix demo) $(param y none)" name="show"
              output="screen"/>
</launch>"""


_SCOPE_YAML = """
launch:
- set_ros_log_dir: {new_log_dir: below}
- set_use_sim_time: {value: 'false'}
- group:
  - push_ros_namespace: {namespace: one}
  - push-ros-namespace: {namespace: two}
  - set_parameter: {name: x, value: '[1, 2]'}
  - set_parameters_from_file: {filename: $(find-pkg-share demo)/p.yaml}
  - set_remap: {from: a, to: b}
  - node: {pkg: demo, exec: show, output: screen}
- ros_timer:
    period: 0.01
    children:
    - node: {pkg: demo, exec: show, output: screen, args: late}
- executable:
    cmd: $(exec-in-pkg show demo) $(find-pkg-prefix demo) $(param y none)
    name: show
    output: screen
"""


@pytest.mark.parametrize("text", [_SCOPE, _SCOPE_YAML], ids=["xml", "yaml"])
def test_elements_of_scopes_and_substitutions(run: Run, package: Path, text: str) -> None:
    (package / "p.yaml").write_text("/**: {ros__parameters: {from: file}}")
    ran = run(*_described(text).entities)
    assert ran.code == 0
    words = sorted(line for line in _lines(ran) if line.startswith("words"))
    file = f"--params-file {package}/p.yaml"
    assert words == [
        f"words: --ros-args -r __ns:=/one/two -p x:=[1, 2] {file} -r a:=b",
        f"words: {package} none",
        "words: late --ros-args",
    ]


_MANAGED = """
<launch>
  <lifecycle_node pkg="demo" exec="managed" name="m" namespace="s" autostart="true"/>
  <lifecycle_transition names="s/m other" ids="1 activate"/>
</launch>"""
_CONTAINERS = """
<launch>
  <node_container pkg="demo" exec="show" name="box" namespace="" output="screen">
    <composable_node pkg="demo" plugin="demo::One" name="one" namespace="s" unless="$(var off)">
      <param name="x" value="1"/>
      <remap from="a" to="b"/>
      <extra_arg name="use_intra_process_comms" value="true"/>
    </composable_node>
  </node_container>
  <load_composable_node target="box">
    <composable_node pkg="demo" plugin="demo::Two" name="two"/>
  </load_composable_node>
</launch>"""


_MANAGED_YAML = """
launch:
- lifecycle_node: {pkg: demo, exec: managed, name: m, namespace: s, autostart: true}
- lifecycle_transition: {names: s/m other, ids: 1 activate}
"""
_CONTAINERS_YAML = """
launch:
- node_container:
    pkg: demo
    exec: show
    name: box
    namespace: ''
    output: screen
    composable_node:
    - pkg: demo
      plugin: demo::One
      name: one
      namespace: s
      unless: $(var off)
      param: [{name: x, value: 1}]
      remap: [{from: a, to: b}]
      extra_arg: [{name: use_intra_process_comms, value: 'true'}]
- load_composable_node:
    target: box
    composable_node: [{pkg: demo, plugin: 'demo::Two', name: two}]
"""


@pytest.mark.parametrize(
    ("managed_text", "containers_text"),
    [(_MANAGED, _CONTAINERS), (_MANAGED_YAML, _CONTAINERS_YAML)],
    ids=["xml", "yaml"],
)
def test_managed_nodes_and_containers_are_elements(
    context: LaunchContext, managed_text: str, containers_text: str
) -> None:
    managed = _described(managed_text).entities
    assert [type(one) for one in managed] == [a.LifecycleNode, a.LifecycleTransition]
    container, load = _described(containers_text).entities
    assert isinstance(container, a.ComposableNodeContainer)
    assert isinstance(load, a.LoadComposableNodes)
    from gazelle.launch.ros2.launch_ros.actions.composable_nodes import (
        get_composable_node_load_request as request_of,
    )

    (node,) = container._ComposableNodeContainer__nodes  # type: ignore[attr-defined]
    context.launch_configurations["off"] = "true"
    assert request_of(node, context) is None
    context.launch_configurations["off"] = "false"
    request = request_of(node, context)
    assert (request.plugin_name, request.node_namespace) == ("demo::One", "/s")
    assert request.parameters[0].value.integer_value == 1
    assert list(request.remap_rules) == ["a:=b"]
    assert request.extra_arguments[0].value.bool_value is True


@pytest.mark.parametrize(
    ("inner", "message"),
    [
        ('<node pkg="demo" exec="show"><param name="a"/></node>', "either a value attribute or"),
        ('<node pkg="demo" exec="show"><param value="a"/></node>', "should have name or from"),
        (
            '<node pkg="demo" exec="show"><param name="a" from="b"/></node>',
            "name and from attributes are mutually exclusive",
        ),
        (
            '<node pkg="demo" exec="show"><param name="a" value="b" allow_substs="1"/></node>',
            "'allow_substs' can only be used together with 'from'",
        ),
        (
            '<node pkg="demo" exec="show"><param name="a" value="1"><param name="b" value="1"/>'
            "</param></node>",
            "nested parameters and value attributes are mutually exclusive",
        ),
        ('<node pkg="demo" exec="show" type="x"/>', "type"),
        ('<node pkg="demo"/>', "exec"),
        ('<nod pkg="demo" exec="show"/>', "did you mean 'node'"),
        ('<log message="$(find-pkg-shar demo)"/>', "did you mean 'find-pkg-share'"),
    ],
)
def test_mistakes_are_told(inner: str, message: str) -> None:
    with pytest.raises(Exception, match=message):
        _described(f"<launch>{inner}</launch>")


def test_everything_of_launch_ros_is_exposed() -> None:
    Parser.load_launch_extensions()
    elements = {
        *("node", "node_container", "load_composable_node", "lifecycle_node"),
        *("lifecycle_transition", "push_ros_namespace", "push-ros-namespace", "ros_timer"),
        *("set_parameter", "set_parameters_from_file", "set_remap", "set_ros_log_dir"),
        "set_use_sim_time",
    }
    assert elements <= action_parse_methods.keys()
    names = {"exec-in-pkg", "find-pkg-prefix", "find-pkg-share", "param"}
    assert names <= substitution_parse_methods.keys()
