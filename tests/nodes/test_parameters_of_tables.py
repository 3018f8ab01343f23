"""What lies below a node's name is read by its table, and what is wrong with it is logged."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.nodes import parameters
from gazelle.nodes.arguments import read_arguments
from gazelle.nodes.parameters import (
    namespace_parameters,
    number_or_end,
    parameter_tree,
    private_parameters,
    start_node,
)
from gazelle.parameters import Parameter, ParameterTable, refused

_TABLE = ParameterTable(
    "thing",
    "A thing.",
    ("pkg/thing",),
    (
        Parameter("rate", "number", 50.0, "how often", "Hz", ros2_default=20.0),
        Parameter("prefix", "text", "", "before frames", ros_versions=(1,)),
        *refused("there is no such thing here", "ghost"),
    ),
)


@pytest.fixture
def said(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    found: list[str] = []

    def log(_node: Any, diagnostics: Diagnostics) -> None:
        found.extend(f"{item.code} {item.message}" for item in diagnostics)

    monkeypatch.setattr(parameters, "log_findings", log)
    return found


def _rate(bench: Any, *words: str) -> float:
    arguments = read_arguments(list(words), "thing")
    node = start_node(arguments, bench.graph)
    with private_parameters(node, arguments, _TABLE) as own:
        return own.number("rate")


def test_the_command_line_counts_more_than_the_store(bench: Any, said: list[str]) -> None:
    bench.graph.parameters.set("/thing", {"rate": 5, "prefix": "a"})
    assert _rate(bench, "_rate:=7") == 7.0
    assert not said


def test_names_that_nobody_reads_are_told_also_where_the_node_ends(
    bench: Any, said: list[str]
) -> None:
    arguments = read_arguments(["_raet:=5", "_rate:=fast"], "thing")
    node = start_node(arguments, bench.graph)
    with (
        pytest.raises(LaunchError, match="is no thing"),
        private_parameters(node, arguments, _TABLE) as own,
    ):
        raise LaunchError(f"{own.number('rate')} is no thing")
    assert [line.split()[0] for line in said] == ["parameter.bad-value", "parameter.unknown"]


def test_what_is_wrong_is_logged_once_with_the_node_s_name(bench: Any, said: list[str]) -> None:
    bench.graph.parameters.set("/thing", {"rate": "fast", "raet": 5, "ghost": 1})
    assert _rate(bench) == 50.0
    assert said == [
        "parameter.bad-value /thing: parameter 'rate' is 'fast', not a number; 50.0 is used",
        "parameter.unknown /thing: parameter 'raet' is not one of thing; it has no effect",
        "parameter.idle /thing: parameter 'ghost' (1) has no effect here: there is no such thing"
        " here",
    ]


def test_a_node_of_ros2_has_its_own_defaults_and_not_ros1_s_names(
    bench: Any, said: list[str]
) -> None:
    assert _rate(bench, "--ros-args", "-p", "prefix:=a") == 20.0
    assert said == [
        "parameter.idle /thing: parameter 'prefix' ('a') has no effect here: it is one of ROS 1"
    ]


@pytest.mark.parametrize(
    "node",
    [
        "amcl/amcl",
        "explore_lite/explore",
        "frontier_exploration/explore_server",
        "gmapping/slam_gmapping",
        "move_base/move_base",
        "robot_localization/ekf_localization_node",
    ],
)
def test_a_file_of_ros2_counts_in_every_node_of_ros1(bench: Any, capfd: Any, node: str) -> None:
    bench.node.parameters.set("/me", {"me": {"ros__parameters": {"slip": 1}}})
    bench.start(node, "__name:=me")
    told: list[str] = []

    def has_said() -> bool:
        told.extend(capfd.readouterr())
        return "parameter 'slip' is not one of" in "".join(told)

    bench.eventually(has_said)


def test_parameters_of_the_namespace_are_read_there_and_told_below_the_node(
    bench: Any, said: list[str]
) -> None:
    arguments = read_arguments(["_rate:=7", "_raet:=7"], "thing", namespace="/here")
    node = start_node(arguments, bench.graph)
    bench.graph.parameters.set("/here/rate", 5)
    with namespace_parameters(node, arguments, _TABLE) as beside:
        assert beside.number("rate") == 5.0
    assert said == [
        "parameter.idle /here/thing: parameter 'rate' (7) has no effect here: the node reads"
        " /here/rate",
        "parameter.unknown /here/thing: parameter 'raet' is not one of thing; it has no effect",
    ]


def test_a_number_that_is_none_may_end_a_node(bench: Any) -> None:
    arguments = read_arguments(["_rate:=fast"], "thing")
    node = start_node(arguments, bench.graph)
    wrong = "^parameter '/thing/rate' is 'fast', not a number$"
    with (
        private_parameters(node, arguments, _TABLE) as own,
        pytest.raises(LaunchError, match=wrong),
    ):
        number_or_end(own, "rate")
    bench.graph.parameters.set("/rate", True)
    wrong = "^parameter '/rate' is True, not a number$"
    with (
        namespace_parameters(node, arguments, _TABLE) as beside,
        pytest.raises(LaunchError, match=wrong),
    ):
        number_or_end(beside, "rate")


def test_what_the_command_line_says_of_a_branch_leaves_the_rest_of_it(bench: Any) -> None:
    bench.graph.parameters.set("/thing", {"costmap": {"width": 4, "rate": 5}})
    arguments = read_arguments(["_costmap/width:=7"], "thing")
    node = start_node(arguments, bench.graph)
    assert parameter_tree(node, arguments) == {"costmap": {"width": 7, "rate": 5}}
