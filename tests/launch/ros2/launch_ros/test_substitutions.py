"""Substitutions, events, handlers, descriptions and names of launch_ros."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any, List  # noqa: UP035

import pytest

from gazelle.launch.environment import drop_in_folder
from gazelle.launch.ros2 import LaunchContext
from gazelle.launch.ros2 import actions as launch
from gazelle.launch.ros2.launch_ros import (
    actions,
    descriptions,
    event_handlers,
    events,
    substitutions,
    utilities,
)
from gazelle.launch.ros2.launch_ros.events.lifecycle import ChangeState, StateTransition
from gazelle.launch.ros2.substitutions import LaunchConfiguration, SubstitutionFailure
from gazelle.workspace.ament_index import PackageNotFoundError

Run = Callable[..., Any]
_ROWS: dict[str, Callable[[LaunchContext, Path], None]] = {}


def _row(test: Callable[[LaunchContext, Path], None]) -> Callable[[LaunchContext, Path], None]:
    _ROWS[test.__name__] = test
    return test


_NAMES = (
    *substitutions.__all__[:-1],
    *descriptions.__all__,
    *event_handlers.__all__,
    *(name for name in events.__all__ if name != "lifecycle"),
    *(name for name in events.lifecycle.__all__),
    *utilities.__all__,
)


@pytest.mark.parametrize("name", dict.fromkeys(_NAMES))
def test_name(name: str, context: LaunchContext, package: Path) -> None:
    _ROWS[name](context, package)


@_row
def FindPackage(context: LaunchContext, package: Path) -> None:
    class Manifest(substitutions.FindPackage):
        def find(self, package_name: str) -> str:
            return f"{package_name}/package.xml"

    context.launch_configurations["p"] = "demo"
    found = Manifest([LaunchConfiguration("p")])
    assert found.perform(context) == "demo/package.xml"
    assert found.describe() == "Manifest(pkg=LaunchConfig('p'))"
    with pytest.raises(NotImplementedError):
        substitutions.FindPackage("demo").perform(context)
    with pytest.raises(AttributeError, match="expect 1 argument"):
        substitutions.FindPackage.parse([])


@_row
def FindPackageShare(context: LaunchContext, package: Path) -> None:
    assert substitutions.FindPackageShare("demo").perform(context) == str(package)
    with pytest.raises(PackageNotFoundError, match=r"package 'dmeo' not found.*mean 'demo'"):
        substitutions.FindPackageShare("dmeo").perform(context)


@_row
def FindPackagePrefix(context: LaunchContext, package: Path) -> None:
    assert substitutions.FindPackagePrefix("demo").perform(context) == str(package)
    with pytest.raises(ValueError, match="'a b' is not a valid package name"):
        substitutions.FindPackagePrefix("a b").perform(context)


@_row
def ExecutableInPackage(context: LaunchContext, package: Path) -> None:
    found = substitutions.ExecutableInPackage("show", "demo")
    assert found.describe() == "ExecInPkg(pkg='demo', exec='show')"
    assert found.perform(context) == str(package / "scripts" / "show")
    # What takes an interpreter gets a script that runs it.
    script = substitutions.ExecutableInPackage("managed", "demo").perform(context)
    assert Path(script).name == "managed" and Path(script).read_text().startswith("#!/bin/sh\n")
    relay = substitutions.ExecutableInPackage("relay", "topic_tools").perform(context)
    ran = subprocess.run([relay], capture_output=True, text=True, check=False)
    assert ran.returncode == 1 and "usage: relay IN_TOPIC" in ran.stderr
    for name, why in (("shwo", "executable 'shwo' not found"), ("compiled", "is not built")):
        with pytest.raises(SubstitutionFailure, match=why):
            substitutions.ExecutableInPackage(name, "demo").perform(context)
    with pytest.raises(AttributeError, match="expects 2 arguments"):
        substitutions.ExecutableInPackage.parse(["show"])


def test_parameter_of_the_scope_is_a_text(run: Run, package: Path) -> None:
    log = launch.LogInfo(msg=["x is ", substitutions.Parameter("x")])
    default = launch.LogInfo(msg=["y is ", substitutions.Parameter("y", default=[1, "b"])])
    ran = run(actions.SetParameter("x", 1.5), log, default)
    assert "x is 1.5" in ran.text and "y is 1b" in ran.text
    ran = run(log)
    assert ran.code == 1 and "parameter 'x' not found" in ran.text
    assert substitutions.Parameter("x").describe() == "Parameter(name='x')"
    with pytest.raises(TypeError, match="expects 1 or 2 arguments"):
        substitutions.Parameter.parse([])


@_row
def ParameterValue(context: LaunchContext, package: Path) -> None:
    context.launch_configurations.update(n="12", l="[1, 2]")
    kinds: list[tuple[str, Any, Any]] = [
        ("n", str, "12"), ("n", int, 12), ("n", float, 12.0), ("n", None, 12),
        ("l", List[int], [1, 2]), ("l", str, "[1, 2]"),  # noqa: UP006
    ]  # fmt: skip
    for name, kind, value in kinds:
        made = descriptions.ParameterValue(LaunchConfiguration(name), value_type=kind)
        assert made.evaluate(context) == value == made.value
    assert "value_type=<class 'str'>" in str(descriptions.ParameterValue("x", value_type=str))
    with pytest.raises(ValueError, match="'bool'"):
        descriptions.ParameterValue(LaunchConfiguration("n"), value_type=bool).evaluate(context)


@_row
def Parameter(context: LaunchContext, package: Path) -> None:
    context.launch_configurations["n"] = "12"
    made = descriptions.Parameter(["a", "b"], LaunchConfiguration("n"), value_type=str)
    assert made.evaluate(context) == ("ab", "12")
    context.launch_configurations["n"] = "13"
    assert made.evaluate(context) == ("ab", "12")
    assert (made.name, made.value, made.value_type) == ("ab", "12", str)
    assert str(made).startswith("launch_ros.description.Parameter(name=ab, value=12")


@_row
def ParameterFile(context: LaunchContext, package: Path) -> None:
    file = package / "p.yaml"
    file.write_text("/**: {ros__parameters: {x: $(var robot), share: $(find-pkg-share demo)}}")
    context.launch_configurations["robot"] = "r1"
    assert descriptions.ParameterFile(str(file)).evaluate(context) == file
    made = descriptions.ParameterFile(file, allow_substs=True)
    copy = made.evaluate(context)
    assert copy != file
    assert copy.read_text() == f"/**: {{ros__parameters: {{x: r1, share: {package}}}}}"
    assert made.evaluate(context) == copy == made.param_file
    made.cleanup()
    assert not copy.exists()
    file.write_text("a: [$(var robot)")
    with pytest.raises(SubstitutionFailure, match="not a valid yaml file"):
        descriptions.ParameterFile(file, allow_substs=True).evaluate(context)


@_row
def ComposableNode(context: LaunchContext, package: Path) -> None:
    made = descriptions.ComposableNode(
        package="p", plugin="p::C", name="n", remappings=[("a", "b")]
    )
    assert made.node_plugin[0].perform(context) == "p::C"
    assert [pair[1][0].perform(context) for pair in made.remappings or ()] == ["b"]
    assert (made.parameters, made.extra_arguments, made.condition()) == (None, None, None)
    with pytest.warns(FutureWarning, match="'node_plugin' of ComposableNode is deprecated"):
        old = descriptions.ComposableNode(package="p", node_plugin="p::D")
    assert old.node_plugin[0].perform(context) == "p::D"
    with pytest.raises(TypeError, match="unexpected keyword argument 'plug'"):
        descriptions.ComposableNode(package="p", plugin="x", plug="y")


def _transition(**labels: str) -> StateTransition:
    parts: Any = {
        key: SimpleNamespace(label=labels.get(key, ""))
        for key in ("transition", "start_state", "goal_state")
    }
    node = SimpleNamespace(node_name="/n")
    return StateTransition(action=node, msg=SimpleNamespace(timestamp=3, **parts))


@_row
def OnStateTransition(context: LaunchContext, package: Path) -> None:
    event = _transition(transition="activate", start_state="inactive", goal_state="active")
    rows: tuple[tuple[bool, dict[str, Any]], ...] = (
        (True, {}), (True, {"goal_state": "active"}), (False, {"goal_state": "inactive"}),
        (False, {"start_state": "active"}), (False, {"transition": "configure"}),
        (True, {"transition": "activate", "start_state": "inactive"}),
    )  # fmt: skip
    for fits, options in rows:
        assert event_handlers.OnStateTransition(entities=[], **options).matches(event) is fits
    custom = event_handlers.OnStateTransition(entities=[], matcher=lambda _event: True)
    assert custom.matches(ChangeState(lifecycle_node_matcher=lambda _: True, transition_id=1))
    assert custom.matcher_description == "event == StateTransition"
    with pytest.raises(RuntimeError, match="requires a 'LifecycleNode' action"):
        event_handlers.OnStateTransition(entities=[], target_lifecycle_node="n")  # type: ignore[arg-type]


@_row
def matches_node_name(context: LaunchContext, package: Path) -> None:
    node = SimpleNamespace(node_name="/a/n")
    assert events.matches_node_name("/a/n")(node)
    assert events.matches_node_name("a/n")(node)
    assert not events.matches_node_name("n")(node)


def test_change_of_state_names_the_transitions() -> None:
    names = ChangeState.valid_transitions
    assert (names[1], names[3], names[7]) == (
        "TRANSITION_CONFIGURE", "TRANSITION_ACTIVATE", "TRANSITION_ACTIVE_SHUTDOWN",
    )  # fmt: skip
    assert ChangeState.valid_states[3] == "PRIMARY_STATE_ACTIVE"


_ROWS["ChangeState"] = lambda _context, _package: _change_state()


def _change_state() -> None:
    with pytest.raises(ValueError, match=r"transition_id of '42', expected one of {TRANSITION_CRE"):
        ChangeState(lifecycle_node_matcher=lambda _: True, transition_id=42)


@_row
def StateTransition_(context: LaunchContext, package: Path) -> None:
    event = _transition(transition="t", start_state="s", goal_state="g")
    found = (event.timestamp, event.transition, event.start_state, event.goal_state)
    assert found == (3, "t", "s", "g")


_ROWS["StateTransition"] = _ROWS.pop("StateTransition_")


@_row
def prefix_namespace(context: LaunchContext, package: Path) -> None:
    prefix = utilities.prefix_namespace
    pairs = {
        ("a", "b"): "a/b", ("/a", "b"): "/a/b", ("a", "/b"): "/b", ("/", "b"): "/b",
        ("a", "b/"): "a/b", (None, "b"): "b", ("a", None): "a", (None, None): None,
    }  # fmt: skip
    assert {pair: prefix(*pair) for pair in pairs} == pairs


@_row
def make_namespace_absolute(context: LaunchContext, package: Path) -> None:
    found = [utilities.make_namespace_absolute(one) for one in ("a", "/a", None)]
    assert found == ["/a", "/a", None]


@_row
def is_namespace_absolute(context: LaunchContext, package: Path) -> None:
    assert [utilities.is_namespace_absolute(one) for one in ("a", "/a")] == [False, True]


@_row
def is_root_namespace(context: LaunchContext, package: Path) -> None:
    assert [utilities.is_root_namespace(one) for one in ("/", "/a")] == [True, False]


@_row
def add_node_name(context: LaunchContext, package: Path) -> None:
    assert utilities.get_node_name_count(context, "/n") == 0
    for _ in range(2):
        utilities.add_node_name(context, "/n")
    assert utilities.get_node_name_count(context, "/n") == 2


_ROWS["get_node_name_count"] = add_node_name


@_row
def normalize_remap_rule(context: LaunchContext, package: Path) -> None:
    rules = list(utilities.normalize_remap_rules([("a", ["b", LaunchConfiguration("c")])]))
    assert [len(side) for side in rules[0]] == [1, 2]
    with pytest.raises(TypeError, match="must be a tuple of length 2, got length 3"):
        utilities.normalize_remap_rule(("a", "b", "c"))
    with pytest.raises(TypeError, match="xpected 'remap_rule' to be one of"):
        utilities.normalize_remap_rule(["a", "b"])


_ROWS["normalize_remap_rules"] = normalize_remap_rule


@_row
def normalize_parameter_dict(context: LaunchContext, package: Path) -> None:
    normal = utilities.normalize_parameter_dict
    given = {
        "text": "yes", "deep": {"er": {"x": 1}}, "mixed": [1, 2.5], "flags": [True, False],
        "words": ["1", "b"], "joined": ["a", LaunchConfiguration("n")], "raw": b"x",
        LaunchConfiguration("n"): 3, "lists": [["a", LaunchConfiguration("n")], ["b"]],
    }  # fmt: skip
    context.launch_configurations["n"] = "nn"
    assert utilities.evaluate_parameter_dict(context, normal(given)) == {
        "text": "yes", "deep.er.x": 1, "mixed": (1.0, 2.5), "flags": (True, False),
        "words": ("1", "b"), "joined": "ann", "raw": b"x", "nn": 3, "lists": ("ann", "b"),
    }  # fmt: skip
    with pytest.raises(TypeError, match="expected dict"):
        normal([1])  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="'a' has an unexpected type for parameter value None"):
        normal({"a": None})


_ROWS["evaluate_parameter_dict"] = normalize_parameter_dict


@_row
def normalize_parameters(context: LaunchContext, package: Path) -> None:
    file = package / "p.yaml"
    rule = descriptions.Parameter("r", 1)
    found = utilities.normalize_parameters([str(file), {"a": 1}, rule])
    assert utilities.evaluate_parameters(context, found) == (file, {"a": 1}, rule)
    for wrong in ("p.yaml", {"a": 1}, 3):
        with pytest.raises(TypeError, match="Expecting list of parameters"):
            utilities.normalize_parameters(wrong)


_ROWS["evaluate_parameters"] = normalize_parameters


@_row
def parameter_values(context: LaunchContext, package: Path) -> None:
    file = package / "p.yaml"
    file.write_text(
        "/**: {ros__parameters: {a: 1, b: 1}}\n/s: {n: {ros__parameters: {b: 2}}}\n"
        "other: {ros__parameters: {c: 3}}"
    )
    given = (file, {"d": "x"}, descriptions.Parameter("e", 5))
    found = utilities.parameter_values(context, "n", "/s", given)
    assert found == [("a", 1), ("b", 2), ("d", "x"), ("e", 5)]
    with pytest.raises(RuntimeError, match="invalid evaluated parameters 3"):
        utilities.parameter_values(context, "n", None, [3])


_PATHS = """
actions.Node actions.node.Node actions.node.NodeActionExtension
actions.composable_node_container.ComposableNodeContainer actions.lifecycle_node.LifecycleNode
actions.lifecycle_transition.LifecycleTransition
actions.load_composable_nodes.LoadComposableNodes
actions.load_composable_nodes.get_composable_node_load_request
actions.push_ros_namespace.PushROSNamespace actions.push_ros_namespace.PushRosNamespace
actions.ros_timer.ROSTimer actions.ros_timer.RosTimer actions.set_parameter.SetParameter
actions.set_parameters_from_file.SetParametersFromFile actions.set_remap.SetRemap
actions.set_ros_log_dir.SetROSLogDir actions.set_use_sim_time.SetUseSimTime
descriptions.ComposableNode descriptions.composable_node.ComposableNode
event_handlers.OnStateTransition event_handlers.on_state_transition.OnStateTransition
events.lifecycle.ChangeState events.lifecycle.change_state.ChangeState
events.lifecycle.state_transition.StateTransition events.matches_node_name
events.lifecycle.lifecycle_node_matchers.matches_node_name events.matchers.matches_node_name
parameter_descriptions.Parameter parameter_descriptions.ParameterFile
parameter_descriptions.ParameterValue parameters_type.SomeParameters
parameters_type.EvaluatedParameters remap_rule_type.SomeRemapRules ros_adapters.ROSAdapter
ros_adapters.get_ros_adapter ros_adapters.get_ros_node substitutions.ExecutableInPackage
substitutions.executable_in_package.ExecutableInPackage
substitutions.find_package.FindPackagePrefix substitutions.find_package.FindPackageShare
substitutions.parameter.Parameter utilities.evaluate_parameters utilities.to_parameters_list
utilities.evaluate_parameters.evaluate_parameter_dict
utilities.namespace_utils.prefix_namespace
utilities.normalize_parameters.normalize_parameter_dict utilities.add_node_name
utilities.normalize_remap_rule.normalize_remap_rules utilities.track_node_names.add_node_name
"""


@pytest.fixture
def drop_ins(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(drop_in_folder()))


@pytest.mark.parametrize("path", _PATHS.split())
@pytest.mark.usefixtures("drop_ins")
def test_users_import_from_the_originals_places(path: str) -> None:
    module, _, name = f"launch_ros.{path}".rpartition(".")
    import_module("launch_ros")
    assert callable(getattr(import_module(module), name)) or name.startswith(("Some", "Evaluated"))


@pytest.mark.usefixtures("drop_ins")
def test_launch_has_a_node_of_rclpy_for_users(run: Run) -> None:
    adapters = import_module("launch_ros.ros_adapters")
    names: list[str] = []

    def look(context: Any) -> None:
        node = adapters.get_ros_node(context)
        assert adapters.get_ros_node(context) is node
        names.append(node.get_name())

    assert run(launch.OpaqueFunction(function=look)).code == 0
    assert names[0].startswith("launch_ros_")


@pytest.mark.usefixtures("drop_ins")
def test_parameters_become_those_of_rclpy(context: LaunchContext) -> None:
    convert = import_module("launch_ros.utilities").to_parameters_list
    found = convert(context, "n", "/", ({"a": (1, 2), "b": "x"},))
    assert [(one.name, one.value) for one in found] == [("a", [1, 2]), ("b", "x")]
    with pytest.raises(RuntimeError, match=r"invalid parameter value {}"):
        convert(context, "n", "/", ({"a": {}},))
