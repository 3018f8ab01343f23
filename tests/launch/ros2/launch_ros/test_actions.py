"""Every action of launch_ros does what it says."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from gazelle.interfaces import message_type, service_type
from gazelle.launch.ros2 import actions as launch
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.conditions import IfCondition
from gazelle.launch.ros2.event_handlers import OnProcessStart
from gazelle.launch.ros2.launch_ros import actions as a
from gazelle.launch.ros2.launch_ros.descriptions import (
    ComposableNode,
    Parameter,
    ParameterFile,
    ParameterValue,
)
from gazelle.launch.ros2.launch_ros.event_handlers import OnStateTransition
from gazelle.launch.ros2.launch_ros.launch_graph import launch_node
from gazelle.launch.ros2.substitutions import EnvironmentVariable, LaunchConfiguration
from gazelle.workspace.ament_index import PackageNotFoundError

Run = Callable[..., Any]
_ROWS: dict[str, Callable[[Run, Path], None]] = {}


def _row(test: Callable[[Run, Path], None]) -> Callable[[Run, Path], None]:
    _ROWS[test.__name__] = test
    return test


@pytest.mark.parametrize("name", a.__all__)
def test_action(name: str, run: Run, package: Path) -> None:
    _ROWS[name](run, package)


def _show(**options: Any) -> a.Node:
    return a.Node(package="demo", executable="show", output="screen", **options)


def _words(ran: Any) -> list[list[str]]:
    """The words of every ``show`` that ran, paths of temporary files as ``FILE``."""
    found = []
    for line in ran.lines:
        head, mark, text = line.partition("] words: ")
        if mark:
            parts = text.split(" ")
            found.append(["FILE" if "launch_params_" in part else part for part in parts])
            assert head.startswith("[show-"), line
    return found


def _yaml(ran: Any) -> list[Any]:
    """What was in the files of parameters, one for each node."""
    texts: dict[str, list[str]] = {}
    for line in ran.lines:
        head, mark, text = line.partition("] ")
        if mark and head.startswith("[show-") and not text.startswith("words: "):
            texts.setdefault(head, []).append(text)
    return [yaml.safe_load("\n".join(lines)) for lines in texts.values()]


@_row
def Node(run: Run, package: Path) -> None:
    file = package / "p.yaml"
    file.write_text("/**: {ros__parameters: {from: file}}")
    node = _show(
        name="n",
        namespace="space",
        arguments=["--own", LaunchConfiguration("word")],
        ros_arguments=["--log-level", "debug"],
        remappings=[("in", "out"), ("/a", [LaunchConfiguration("word"), "_b"])],
        parameters=[
            {"a": 1, "deep": {"b": [1.5, 2]}, "text": "true", "many": ["x", "1"],
             "read": LaunchConfiguration("number"), "joined": ["p", LaunchConfiguration("word")]},
            str(file),
            Parameter("rule", LaunchConfiguration("number")),
        ],
    )  # fmt: skip
    ran = run(node, word="w", number="7")
    assert ran.code == 0
    assert _words(ran) == [
        ["--own", "w", "--ros-args", "--log-level", "debug", "--ros-args",
         "-r", "__node:=n", "-r", "__ns:=/space", "--params-file", "FILE",
         "--params-file", str(file), "-p", "rule:=7", "-r", "in:=out", "-r", "/a:=w_b"],
    ]  # fmt: skip
    written = yaml.safe_load(ran.text[ran.text.index("/space/n:") :].split("] /**")[0]
                             .replace(f"[{node.name}] ", "").rpartition("\n")[0])  # fmt: skip
    assert written["/space/n"]["ros__parameters"] == {
        "a": 1, "deep.b": [1.5, 2.0], "text": "true", "many": ["x", "1"], "read": 7,
        "joined": "pw",
    }  # fmt: skip
    assert node.node_name == "/space/n"
    assert node.expanded_node_namespace == "/space"
    assert node.expanded_remapping_rules == [("in", "out"), ("/a", "w_b")]
    assert (node.node_package, node.node_executable) == ("demo", "show")


def test_node_without_name_gets_its_parameters_by_wildcard(run: Run, package: Path) -> None:
    ran = run(_show(parameters=[{"x": 1}], exec_name="show"))
    assert _words(ran) == [["--ros-args", "--params-file", "FILE"]]
    assert _yaml(ran) == [{"/**": {"ros__parameters": {"x": 1}}}]


def test_names_of_foxy_are_taken_with_a_warning(run: Run, package: Path) -> None:
    with pytest.warns(FutureWarning) as caught:
        node = a.Node(package="demo", node_executable="show", node_name="n", output="screen")
    text = "The parameter 'node_executable' of Node is deprecated, use 'executable' (Foxy was"
    assert len(caught) == 2 and str(caught[0].message).startswith(text)
    assert caught[0].filename == __file__
    assert _words(run(node)) == [["--ros-args", "-r", "__node:=n"]]
    with pytest.raises(TypeError, match="both 'node_name' and 'name' are given"):
        a.Node(package="demo", executable="show", node_name="n", name="m")
    with pytest.raises(TypeError, match="missing 1 required keyword-only argument: 'executable'"):
        a.Node(package="demo")


def test_a_name_of_foxy_is_told_once_for_all_nodes(package: Path) -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        for name in "abc":
            a.Node(package="demo", node_executable="show", name=name)
    assert len(told) == 1


def test_path_in_place_of_a_package_is_run(run: Run, package: Path) -> None:
    path = str(package / "scripts" / "show")
    assert _words(run(a.Node(executable=path, output="screen"))) == [["--ros-args"]]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"pkg": "demo"}, "unexpected keyword argument 'pkg'; did you mean 'package'?"),
        ({"outputs": "screen"}, "unexpected keyword argument 'outputs'; did you mean 'output'?"),
        ({"parameters": "p.yaml"}, r"a list, but got 'p.yaml' .*write parameters=\['p.yaml'\]"),
        ({"parameters": {"a": 1}}, r"write parameters=\[{…}\]"),
        ({"remappings": ["a:=b"]}, r"write remappings=\[\('a', 'b'\)\]"),
    ],
)
def test_arguments_of_another_kind_are_corrected(options: dict[str, Any], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        a.Node(executable="show", **options)


def test_text_in_place_of_arguments_is_told(run: Run, package: Path) -> None:
    ran = run(launch.OpaqueFunction(function=lambda _context: [_show(arguments="-d x")]))
    assert "each character becomes a word, as in ROS 2; write arguments=['-d', 'x']" in ran.text
    assert _words(ran) == [["-", "d", "", "", "x", "--ros-args"]]


def test_second_node_of_a_name_is_told(run: Run, package: Path) -> None:
    ran = run(*(_show(name="n", namespace="/s") for _ in range(2)))
    assert "there are now at least 2 nodes with the name /s/n created within" in ran.text


def test_nodes_take_what_processes_take(run: Run, package: Path) -> None:
    started: list[Any] = []
    node = _show(additional_env={"GZ_X": "1"}, prefix="env", condition=IfCondition("true"))
    handler = OnProcessStart(target_action=node, on_start=lambda event, _: started.append(event))
    run(launch.RegisterEventHandler(handler), node, _show(condition=IfCondition("false")))
    (event,) = started
    assert event.env["GZ_X"] == "1"
    assert event.cmd[:2] == ["env", str(package / "scripts" / "show")]


def test_prefix_is_filtered_by_the_nodes_name(run: Run, package: Path) -> None:
    given = {"launch-prefix": "env GZ=1", "launch-prefix-filter": "show"}
    node, other = _show(), a.Node(package="demo", executable="managed", name="0wrong")
    run(node, **given)
    assert node.process_details is not None
    assert node.process_details["cmd"][:2] == ["env", "GZ=1"]
    assert other.process_description.final_cmd is None


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"name": "a/b"}, "'a/b': node name must not contain '/'; give the namespace"),
        ({"name": "1st"}, "'1st': node name must not start with a number"),
        ({"name": "a-b"}, "other than alphanumerics or '_'; 'a_b' would do"),
        ({"name": "n", "namespace": "a//b"}, "it has an empty part ('/a//b')"),
        ({"parameters": [{"x": []}]}, "Expected 'value' to be one of"),
        ({"parameters": [{"x": [1, "a"]}]}, 'Got inconsistent input for "x"'),
        ({"parameters": [{"x": LaunchConfiguration("bad")}]}, "value of parameter x as yaml"),
        ({"parameters": [Parameter("x", LaunchConfiguration("text"), value_type=int)]}, "abc"),
    ],
)
def test_what_nodes_cannot_be_ends_the_launch(
    run: Run, package: Path, options: dict[str, Any], message: str
) -> None:
    ran = run(_show(**options), bad="[1, ", text="abc")
    assert ran.code == 1
    assert message.lower() in ran.text.lower()
    assert ran.context.diagnostics.errors[0].span.file == __file__


def test_missing_executables_are_told_with_what_there_is(run: Run, package: Path) -> None:
    ran = run(a.Node(package="demo", executable="shwo"))
    (found,) = ran.context.diagnostics.errors
    assert ran.code == 1 and found.code == "ros2_launch.executable-missing"
    assert "Cannot locate node of type [shwo] in package [demo]" in found.message
    assert "did you mean 'show'?" in found.fix
    assert found.span.file == __file__
    assert "Caught exception in launch (see debug for traceback): executable 'shwo'" in ran.text


def test_a_program_that_is_not_here_does_not_end_the_launch(run: Run, package: Path) -> None:
    absent = a.Node(package="robot_localization", executable="navsat_transform_node")
    ran = run(absent, _show(name="n"))
    (found,) = ran.context.diagnostics
    assert ran.code == 0 and found.code == "ros2_launch.executable-missing"
    assert "in package [robot_localization]; the others go on" in found.message
    assert found.fix == (
        "navsat_transform_node is for positions of satellites; robot_localization's pose0 takes "
        "poses"
    )
    assert _words(ran) == [["--ros-args", "-r", "__node:=n"]]


def test_missing_packages_are_told_with_the_nearest(run: Run, package: Path) -> None:
    errors: list[Any] = []
    ran = run(a.Node(package="dmeo", executable="show"))
    errors += ran.context.diagnostics.errors
    assert [one.code for one in errors] == ["ros2_launch.package-missing"]
    assert "package 'dmeo' not found; did you mean 'demo'?" in errors[0].message
    assert "Caught exception in launch (see debug for traceback): package 'dmeo'" in ran.text
    assert issubclass(PackageNotFoundError, KeyError)


def test_launch_goes_on_without_compiled_nodes(run: Run, package: Path) -> None:
    ran = run(a.Node(package="demo", executable="compiled"), _show())
    assert ran.code == 0
    assert len(_words(ran)) == 1
    (found,) = ran.context.diagnostics.errors
    assert found.code == "launch.compiled-node"
    assert "add_executable() in its CMakeLists.txt" in found.fix


@_row
def PushROSNamespace(run: Run, package: Path) -> None:
    group = launch.GroupAction([a.PushROSNamespace("one"), a.PushROSNamespace("two"), _show()])
    absolute = launch.GroupAction([a.PushROSNamespace("/three"), _show(namespace="four")])
    ran = run(group, absolute, _show())
    assert [[word for word in words if "__ns" in word] for words in sorted(_words(ran))] == [
        [], ["__ns:=/one/two"], ["__ns:=/three/four"],
    ]  # fmt: skip
    assert "The resulting namespace is invalid" in run(a.PushROSNamespace("a b")).text


@_row
def PushRosNamespace(run: Run, package: Path) -> None:
    assert a.PushRosNamespace is a.PushROSNamespace
    ran = run(a.PushRosNamespace(LaunchConfiguration("robot")), _show(), robot="r1")
    assert _words(ran) == [["--ros-args", "-r", "__ns:=/r1"]]


@_row
def SetParameter(run: Run, package: Path) -> None:
    group = launch.GroupAction([a.SetParameter("inner", [1, 2]), _show()])
    outer = a.SetParameter(name="use_sim_time", value=True)
    value = a.SetParameter("text", ParameterValue(LaunchConfiguration("v"), value_type=str))
    ran = run(outer, group, value, _show(parameters=[{"own": 1}]), v="1")
    words = sorted(_words(ran), key=len)
    assert words[0] == ["--ros-args", "-p", "use_sim_time:=True", "-p", "inner:=[1,", "2]"]
    assert words[1][1:5] == ["-p", "use_sim_time:=True", "-p", "text:=1"]
    assert (outer.name[0].perform(ran.context), outer.value) == ("use_sim_time", True)


@_row
def SetParametersFromFile(run: Run, package: Path) -> None:
    file = package / "shared.yaml"
    file.write_text("/**: {ros__parameters: {x: 1}}")
    ran = run(launch.GroupAction([a.SetParametersFromFile(str(file)), _show()]), _show())
    assert sorted(_words(ran)) == [["--ros-args"], ["--ros-args", "--params-file", str(file)]]
    missing = run(a.SetParametersFromFile("none.yaml"), _show())
    assert "none.yaml' is not a file" in missing.text


@_row
def SetRemap(run: Run, package: Path) -> None:
    shared = a.SetRemap("scan", [LaunchConfiguration("robot"), "/scan"])
    group = launch.GroupAction([shared, _show(remappings=[("a", "b")])])
    ran = run(group, _show(), robot="r1")
    assert sorted(_words(ran), key=len) == [
        ["--ros-args"], ["--ros-args", "-r", "scan:=r1/scan", "-r", "a:=b"],
    ]  # fmt: skip
    assert [one[0].describe() for one in (shared.src, shared.dst)] == [
        "'scan'", "LaunchConfig('robot')",
    ]  # fmt: skip


@_row
def SetROSLogDir(run: Run, package: Path) -> None:
    log = launch.LogInfo(msg=EnvironmentVariable("ROS_LOG_DIR"))
    before = os.environ["ROS_LOG_DIR"]
    ran = run(launch.GroupAction([a.SetROSLogDir("inner"), log]), a.SetROSLogDir("/tmp/x"), log)
    assert [line.rpartition(" ")[2] for line in ran.lines if "launch.user" in line] == [
        f"{before}/inner", "/tmp/x",
    ]  # fmt: skip


@_row
def SetUseSimTime(run: Run, package: Path) -> None:
    seen: list[bool] = []

    def look(context: Any) -> None:
        seen.append(launch_node(context).clock.use_sim_time)

    both = [a.SetUseSimTime(True), launch.OpaqueFunction(function=look)]
    no = a.SetUseSimTime([LaunchConfiguration("sim")])
    assert run(*both, no, launch.OpaqueFunction(function=look), sim="false").code == 0
    assert seen == [True, False]


@_row
def ROSTimer(run: Run, package: Path) -> None:
    """It waits by simulated time: nobody ticks at first, then time flies."""
    said = launch.LogInfo(msg="time is up")
    timer = a.ROSTimer(period=100.0, actions=[said])

    def tick(context: Any) -> None:
        kind: Any = message_type("rosgraph_msgs/msg/Clock")
        publisher = launch_node(context).create_publisher("/clock", kind)
        for seconds in (0, 99, 101):
            message = kind()
            message.clock.sec = seconds
            publisher.publish(message)

    later = launch.TimerAction(period=0.2, actions=[launch.OpaqueFunction(function=tick)])
    ran = run(a.SetUseSimTime(True), timer, later)
    assert "time is up" in ran.text
    assert "ROSTimer(period=" in timer.describe()


@_row
def RosTimer(run: Run, package: Path) -> None:
    assert a.RosTimer is a.ROSTimer
    up, never = launch.LogInfo(msg="time is up"), launch.LogInfo(msg="never")
    cancelled = a.RosTimer(period=0.05, actions=[never])
    cancelled.cancel()
    ran = run(a.RosTimer(period=0.05, actions=[up]), cancelled)
    assert "time is up" in ran.text and "never" not in ran.text


def _managed(**options: Any) -> a.LifecycleNode:
    return a.LifecycleNode(
        package="demo", executable="managed", name="m", namespace="/s", output="screen", **options
    )


@_row
def LifecycleNode(run: Run, package: Path) -> None:
    node = _managed(autostart=True)
    active = OnStateTransition(
        target_lifecycle_node=node,
        start_state="activating",
        goal_state="active",
        entities=[launch.LogInfo(msg="it is active"), launch.Shutdown()],
    )
    ran = run(launch.RegisterEventHandler(active), node)
    assert [word in ran.text for word in ("configured", "activated", "it is active")] == [True] * 3
    with pytest.raises(TypeError, match="missing 1 required keyword-only argument: 'namespace'"):
        a.LifecycleNode(package="demo", executable="managed", name="m")


@_row
def LifecycleTransition(run: Run, package: Path) -> None:
    node = _managed()
    walk = a.LifecycleTransition(lifecycle_node_names=["s/m"], transition_ids=[1, 3, 4, "cleanup"])
    done = OnStateTransition(goal_state="unconfigured", entities=[launch.Shutdown()])
    ran = run(launch.RegisterEventHandler(done), node, walk)
    assert ran.code == 0
    assert ran.text.index("configured") < ran.text.index("activated")


def test_transitions_stop_at_an_error(run: Run, package: Path) -> None:
    node = _managed(parameters=[{"fails": True}])
    walk = a.LifecycleTransition(lifecycle_node_names=["/s/m"], transition_ids=[1, 3])
    failed = OnStateTransition(start_state="errorprocessing", entities=[launch.Shutdown()])
    ran = run(launch.RegisterEventHandler(failed), node, walk)
    assert "Stopping transitions for /s/m because 'error occurred during transitions'" in ran.text
    assert "activated" not in ran.text


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"lifecycle_node_names": ["n"], "transition_ids": []}, "No transition_ids provided."),
        ({"lifecycle_node_names": [], "transition_ids": [1]}, "No lifecycle_node_names provided."),
    ],
)
def test_transitions_need_nodes_and_numbers(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        a.LifecycleTransition(**options)


@pytest.mark.parametrize(
    ("number", "message"),
    [
        ("activat", "got activat; did you mean 'activate'"),
        ("77", "no transition has the number 77"),
    ],
)
def test_unknown_transitions_are_told(run: Run, number: str, message: str) -> None:
    walk = a.LifecycleTransition(lifecycle_node_names=["n"], transition_ids=[number])
    assert message in run(walk).text


def _container(loaded: list[Any], *, works: bool = True) -> launch.OpaqueFunction:
    """Offers the service of a container and keeps what it is asked to load."""
    kind: Any = service_type("composition_interfaces/srv/LoadNode")

    def load(request: Any) -> Any:
        loaded.append(request)
        name = f"{request.node_namespace}/{request.node_name}"
        return kind.Response(success=works, error_message="no such plug-in", full_node_name=name)

    def offer(context: Any) -> None:
        launch_node(context).create_service("/box/_container/load_node", kind, load)

    return launch.OpaqueFunction(function=offer)


@_row
def LoadComposableNodes(run: Run, package: Path) -> None:
    file = package / "p.yaml"
    file.write_text("/s/one: {ros__parameters: {a: 1}}\nother: {ros__parameters: {a: 2}}")
    loaded: list[Any] = []
    nodes = [
        ComposableNode(
            package="demo", plugin="demo::One", name="one", namespace="s",
            parameters=[ParameterFile(str(file)), {"b": [1, 2], "c": LaunchConfiguration("c")}],
            remappings=[("x", "y")], extra_arguments=[{"use_intra_process_comms": True}],
        ),
        ComposableNode(package="demo", plugin="demo::Two", condition=IfCondition("false")),
        ComposableNode(package="demo", plugin="demo::One", name="one", namespace="s"),
    ]  # fmt: skip
    load = a.LoadComposableNodes(composable_node_descriptions=nodes, target_container="/box")
    shared = [a.SetParameter("z", 3), a.SetRemap("p", "q")]
    ran = run(_container(loaded), *shared, load, c="2.5")
    first, second = loaded
    assert (first.package_name, first.plugin_name) == ("demo", "demo::One")
    assert (first.node_name, first.node_namespace) == ("one", "/s")
    values = {one.name: one.value for one in first.parameters}
    assert (values["z"].integer_value, values["a"].integer_value) == (3, 1)
    assert (list(values["b"].integer_array_value), values["c"].double_value) == ([1, 2], 2.5)
    assert list(first.remap_rules) == ["p:=q", "x:=y"]
    assert first.extra_arguments[0].value.bool_value is True
    assert [one.name for one in second.parameters] == ["z"]
    assert "Loaded node '/s/one' in container '/box'" in ran.text
    assert "there are now at least 2 nodes with the name /s/one" in ran.text


def test_components_that_cannot_be_loaded_are_told(run: Run, package: Path) -> None:
    node = ComposableNode(package="demo", plugin="demo::One", name="one")
    load = a.LoadComposableNodes(composable_node_descriptions=[node], target_container="/box")
    text = run(_container([], works=False), load).text
    what = "Failed to load node 'one' of type 'demo::One' in container '/box': no such plug-in"
    assert what in text


@_row
def ComposableNodeContainer(run: Run, package: Path) -> None:
    node = ComposableNode(package="demo", plugin="demo::One", name="one")
    container = a.ComposableNodeContainer(
        package="demo", executable="show", name="box", namespace="",
        composable_node_descriptions=[node], output="screen",
    )  # fmt: skip
    loaded: list[Any] = []
    ran = run(_container(loaded), container)
    assert _words(ran) == [["--ros-args", "-r", "__node:=box", "-r", "__ns:=/"]]
    assert [one.node_name for one in loaded] == ["one"]


def test_container_of_ros_runs_built_in_nodes(run: Run, package: Path) -> None:
    node = ComposableNode(
        package="topic_tools", plugin="topic_tools::RelayNode", name="relay", namespace="s"
    )
    container = a.ComposableNodeContainer(
        package="rclcpp_components", executable="component_container_mt", name="box",
        namespace="", composable_node_descriptions=[node], output="screen",
    )  # fmt: skip
    end = launch.TimerAction(period=60.0, actions=[launch.Shutdown()])

    def stop_when_loaded(service: Any) -> None:
        handler = launch_logging.get_logger("launch_ros.actions.load_composable_nodes")
        handler.addFilter(lambda record: service.shutdown(force_sync=True) or bool(record))

    text = run(container, end, during=stop_when_loaded).text
    assert "Loaded node '/s/relay' in container '/box'" in text
    assert "topic_tools/relay does the work of topic_tools::RelayNode" in text
