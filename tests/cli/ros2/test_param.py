"""ros2 param."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.cli.ros2 import param
from gazelle.graph import Node
from gazelle.graph.ros2_node_parameters import Descriptor, NodeParameters

VALUES = {"gains.joint_1.p": 1.0, "joints": ["joint_1"], "rate": 100, "name": "arm"}


@pytest.fixture
def parameters(robot: Node) -> NodeParameters:
    """Parameters of the node /arm."""
    rows = {
        "gains.joint_1.p": Descriptor("proportional gain", lowest=0.0, highest=50.0),
        "joints": Descriptor(read_only=True),
    }
    return NodeParameters(robot, "/arm", VALUES, descriptors=rows)


@pytest.fixture
def ros2_param(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str, str]]:
    """Runs ``ros2 param …``."""

    def run(*words: str) -> tuple[int, str, str]:
        capsys.readouterr()
        code = param.main(list(words))
        return code, *capsys.readouterr()

    return run


def test_list_of_one_node_and_of_all(parameters: NodeParameters, ros2_param: Any) -> None:
    rows = "  gains.joint_1.p\n  joints\n  name\n  rate\n"
    assert ros2_param("list", "/arm") == (0, rows, "")
    assert ros2_param("list") == (0, f"/arm:\n{rows}", "")
    typed = ros2_param("list", "arm", "--param-type", "--filter", "rate|joints")[1]
    assert typed == "  joints (type: string array)\n  rate (type: integer)\n"
    assert ros2_param("list", "arm", "--param-prefixes", "gains")[1] == "  gains.joint_1.p\n"


def test_get_names_the_type(parameters: NodeParameters, ros2_param: Any) -> None:
    assert ros2_param("get", "/arm", "gains.joint_1.p") == (0, "Double value is: 1.0\n", "")
    assert ros2_param("get", "/arm", "joints")[1] == "String values are: ['joint_1']\n"
    assert ros2_param("get", "/arm", "rate", "--hide-type")[1] == "100\n"
    code, _, error = ros2_param("get", "/arm", "rat")
    assert code == 1
    assert error == "Parameter not set.\n  did you mean 'rate'?\n"


def test_set_changes_the_value_and_tells_refusals(
    parameters: NodeParameters, ros2_param: Any
) -> None:
    done = ros2_param("set", "/arm", "gains.joint_1.p", "1e1")
    assert done == (0, "Set parameter successful\n", "")
    assert parameters.values["gains.joint_1.p"] == 10.0
    code, _, error = ros2_param("set", "/arm", "gains.joint_1.p", "99")
    assert code == 1
    assert error.startswith("Setting parameter failed: Parameter {gains.joint_1.p} doesn't comply")
    assert "read-only" in ros2_param("set", "/arm", "joints", "[a]")[2]
    assert "not YAML" in ros2_param("set", "/arm", "joints", "[a")[2]


def test_describe(parameters: NodeParameters, ros2_param: Any) -> None:
    assert ros2_param("describe", "/arm", "gains.joint_1.p", "joints")[1] == (
        "Parameter name: gains.joint_1.p\n  Type: double\n  Description: proportional gain\n"
        "  Constraints:\n    Min value: 0.0\n    Max value: 50.0\n"
        "Parameter name: joints\n  Type: string array\n  Constraints:\n    Read only: true\n"
    )


def test_dump_and_load_are_a_round_trip(
    parameters: NodeParameters, ros2_param: Any, tmp_path: Path
) -> None:
    code, text, _ = ros2_param("dump", "/arm", "--output-dir", str(tmp_path))
    path = tmp_path / "arm.yaml"
    assert (code, text) == (0, f"Saving to:  {path}\n")
    written = path.read_text(encoding="utf-8")
    assert ros2_param("dump", "/arm")[1] == f"{written}\n"
    path.write_text(written.replace("p: 1.0", "p: 7.5"), encoding="utf-8")
    code, out, error = ros2_param("load", "/arm", str(path))
    assert code == 1
    assert "Set parameter gains.joint_1.p successful\n" in out
    assert "Set parameter joints failed: parameter 'joints' cannot be set because" in error
    assert parameters.values["gains.joint_1.p"] == 7.5


def test_unknown_node_is_an_error_with_the_nearest_name(
    parameters: NodeParameters, ros2_param: Any
) -> None:
    code, out, error = ros2_param("get", "/am", "rate")
    assert (code, out) == (1, "")
    assert error == "Node not found: '/am' offers no parameters\n  did you mean '/arm'?\n"


def test_without_a_graph_it_says_so(port: int, ros2_param: Any) -> None:
    code, _, error = ros2_param("list")
    assert code == 1
    assert "Unable to communicate with master!" in error
