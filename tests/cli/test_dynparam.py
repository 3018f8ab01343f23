"""``dynparam`` against a reconfigurable node."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from gazelle.cli import dynparam
from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.graph.dynamic_reconfigure import (
    DynamicGroup,
    DynamicParameter,
    EnumConstant,
    ReconfigureServer,
    enum_edit_method,
)
from gazelle.graph.ros2_node_parameters import NodeParameters
from gazelle.launch.node_commands import find_executable
from gazelle.workspace import Workspace

SIZES = enum_edit_method((EnumConstant("Small", 0), EnumConstant("Large", 2)), "Sizes")
GROUP = DynamicGroup(
    "Default",
    (
        DynamicParameter("p", "double", 1.0, "Gain.", -10.0, 10.0),
        DynamicParameter("size", "int", 0, "Size.", 0, 3, SIZES),
        DynamicParameter("url", "str", "", "Where."),
    ),
    (DynamicGroup("More", (DynamicParameter("on", "bool", True, "Switch."),)),),
)


class Result(NamedTuple):
    """What a command left."""

    code: int
    out: str
    err: str


@pytest.fixture
def dyn(capsys: pytest.CaptureFixture[str]) -> Callable[..., Result]:
    """Runs ``dynparam``."""

    def call(*words: str) -> Result:
        capsys.readouterr()
        code = dynparam.main(list(words))
        return Result(code, *capsys.readouterr())

    return call


@pytest.fixture
def server(graph: Graph) -> ReconfigureServer:
    """A reconfigurable node beside one of ROS 2."""
    node = graph.create_node("camera", rosout=False)
    NodeParameters(node, "/ros2_node", {"x": 1})
    return ReconfigureServer(node, "/camera", GROUP, lambda values, level: None)


def test_list_names_reconfigurable_nodes(dyn: Any, server: ReconfigureServer) -> None:
    assert dyn("list") == Result(0, "/camera\n", "")


def test_get_prints_values_and_groups(dyn: Any, server: ReconfigureServer) -> None:
    found = dyn("get", "camera")
    assert (found.code, found.err) == (0, "")
    assert found.out == (
        "{'on': True, 'size': 0, 'url': '', 'p': 1.0, 'groups': {'id': 0, 'parent': 0, "
        "'name': 'Default', 'type': '', 'state': True, 'groups': {'More': {'id': 1, 'parent': 0, "
        "'name': 'More', 'type': '', 'state': True, 'groups': {}, 'parameters': {}, 'on': True}}, "
        "'parameters': {}, 'p': 1.0, 'size': 0, 'url': ''}}\n"
    )


@pytest.mark.parametrize(
    ("words", "name", "value"),
    [
        (("p", "-2.5"), "p", -2.5),
        (("p", "99"), "p", 10.0),
        (("size", "large"), "size", 2),
        (("on", "no"), "on", False),
        (("url", "file:///x"), "url", "file:///x"),
        (("{'url': 'foo', 'size': 3}",), "size", 3),
        (("{'groups': {'More': False}}",), "p", 1.0),
    ],
)
def test_set_reads_values_as_their_types_want(
    dyn: Any, server: ReconfigureServer, words: tuple[str, ...], name: str, value: Any
) -> None:
    assert dyn("set", "/camera", *words) == Result(0, "", "")
    assert server.values[name] == value
    assert server.states["More"] is ("groups" not in words[0])


def test_wrong_values_are_told_and_the_code_is_the_original_s(
    dyn: Any, server: ReconfigureServer
) -> None:
    found = dyn("set", "camera", "sise", "3")
    text = "error updating parameters: don't know parameter: sise; did you mean 'size'"
    assert found.code == 0 and found.out.startswith(text)
    found = dyn("set", "camera", "p", "much")
    assert found.out.startswith("error updating parameters: can't set parameter 'p' of <class 'flo")
    assert server.values["p"] == 1.0
    found = dyn("set", "camera", "{size: [")
    assert found.code == 1
    assert "Argument error: while parsing a flow" in found.err
    assert "write YAML in quotes" in found.err


def test_dump_is_the_original_s_file_and_load_reads_it_and_plain_ones(
    dyn: Any, server: ReconfigureServer, tmp_path: Path
) -> None:
    file = tmp_path / "camera.yaml"
    server.set({"p": 3.0, "url": "x"})
    assert dyn("dump", "camera", str(file)) == Result(0, "", "")
    text = file.read_text()
    assert text.startswith(
        "!!python/object/new:dynamic_reconfigure.encoding.Config\ndictitems:\n  groups: !!python"
    )
    assert "        parameters: !!python/object/new:dynamic_reconfigure.encoding.Config\n" in text
    server.set({"p": 0.0, "url": ""})
    assert dyn("load", "camera", str(file)) == Result(0, "", "")
    assert (server.values["p"], server.values["url"]) == (3.0, "x")
    file.write_text("p: 4.0\n---\nsize: 1\n")
    assert dyn("load", "camera", str(file)).code == 0
    assert (server.values["p"], server.values["size"]) == (4.0, 1)
    file.write_text("!!python/object/apply:os.system [false]")
    found = dyn("load", "camera", str(file))
    assert found.code == 1 and "is not a YAML dictionary of parameters" in found.err


def test_set_from_parameters_takes_private_parameters(
    dyn: Any, server: ReconfigureServer, graph: Graph
) -> None:
    words = ("set_from_parameters", "camera")
    assert dyn(*words, "_p:=2.5", "_url:=foo").code == 0
    assert (server.values["p"], server.values["url"]) == (2.5, "foo")
    graph.parameters.set("/adjust/size", 3)
    assert dyn(*words, "__name:=adjust").code == 0
    assert server.values["size"] == 3
    found = dyn(*words, "__name:=bare")
    assert found.code == 0
    assert found.err == "error updating parameters: no parameters found on parameter server\n"


def test_nobody_there_in_time(dyn: Any, server: ReconfigureServer) -> None:
    found = dyn("get", "-t", "0.05", "camara")
    assert found.code == 1
    assert "timeout exceeded while waiting for service /camara/set_parameters" in found.err
    assert "did you mean '/camera'" in found.err
    for words in (("--timeout=0.05",), ("-t", "0.05")):
        found = dyn("set", *words, "nobody", "p", "-1")
        assert (found.code, found.out) == (0, "couldn't set parameters at node nobody\n")


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (("get",), "invalid arguments. Please specify a node name"),
        (("get", "a", "b"), "too many arguments"),
        (("set", "a"), "Please specify either a node name, parameter name and parameter value"),
        (("set", "a", "3"), "or a node name and a YAML dictionary"),
        (("set", "a", "b", "c", "d"), "too many arguments"),
        (("dump", "a"), "invalid arguments. Please specify an output file"),
        (("set", "a", "b", "1", "-t"), "-t option requires 1 argument"),
        (("load", "a"), "invalid arguments. Please specify an input file"),
        (("set_from_parameters",), "invalid arguments. Please specify a node name"),
    ],
)
def test_wrong_arguments_end_with_two(dyn: Any, words: tuple[str, ...], text: str) -> None:
    found = dyn(*words)
    assert found.code == 2
    assert "Usage: dynparam " in found.err and text in found.err


def test_launch_files_and_rosrun_find_it() -> None:
    found = find_executable(
        "dynamic_reconfigure",
        "dynparam",
        workspace=Workspace.discover(environ={}),
        diagnostics=Diagnostics(),
    )
    assert found is not None and found.command[1:] == ("-m", "gazelle.cli", "dynparam")


def test_usage_without_command_ends_with_one(dyn: Any) -> None:
    found = dyn()
    assert found.code == 1 and "list configurable nodes" in found.out
    assert dyn("got").code == 1


def test_no_graph_is_said(dyn: Any, port: int) -> None:
    found = dyn("list")
    assert found.code == 1 and "Unable to communicate with master!" in found.err
