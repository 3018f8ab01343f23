"""Parameters: values by a table, and what is said about those that do not fit."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.navigation.costmap import CostmapOptions, SourceOptions
from gazelle.nodes.parameters import node_reader
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.dataclass_tables import table_of
from gazelle.parameters.reader import ParameterReader
from gazelle.parameters.trees import nested

_TABLE = ParameterTable(
    "thing",
    "A thing.",
    ("pkg/Thing",),
    (
        Parameter("rate", "number", 5.0, "how often", "Hz", 0, 10),
        Parameter("count", "integer", 3, "how many"),
        Parameter("on", "flag", True, "whether"),
        Parameter("frame", "text", "map", "where"),
        Parameter("names", "words", ("a",), "who"),
        Parameter("inner", "group", None, "more"),
        Parameter("<any>.plugin", "text", "", "of each"),
        *refused("there is no such thing here", "ghost"),
        *refused("nobody is told", "verbose", unless=False),
    ),
)


def _settings(tree: dict[str, Any]) -> tuple[ParameterReader, Diagnostics]:
    diagnostics = Diagnostics()
    return node_reader(_TABLE, tree, "/node", diagnostics), diagnostics


def test_values_and_defaults() -> None:
    settings, diagnostics = _settings({"rate": 2, "names": "x y", "inner": {"deep": 1}})
    assert settings.number("rate") == 2.0
    assert (settings.integer("count"), settings.flag("on"), settings.text("frame")) == (
        3, True, "map",
    )  # fmt: skip
    assert settings.texts("names") == ("x", "y")
    assert settings.group("inner") == {"deep": 1}
    assert not list(diagnostics)


@pytest.mark.parametrize(
    ("key", "value", "used", "words"),
    [
        ("rate", "fast", 5.0, "'rate' is 'fast', not a number; 5.0 is used"),
        ("rate", 11, 10.0, "'rate' is 11.0, not a number of 0 to 10; 10 is used"),
        ("rate", 10**400, 5.0, "'rate' is 1000000"),
        ("rate", float("nan"), 5.0, "'rate' is nan, not a number of 0 to 10; 5.0 is used"),
        ("rate", True, 5.0, "'rate' is True, not a number"),
        ("count", 2.5, 3, "'count' is 2.5, not a whole number; 3 is used"),
        ("on", "maybe", True, "'on' is 'maybe', not true or false; True is used"),
        ("frame", ["a"], "map", "'frame' is ['a'], not a text; 'map' is used"),
        ("names", 5, (), "'names' is 5, not a list of texts; () is used"),
    ],
)
def test_values_that_do_not_fit_are_told(key, value, used, words) -> None:
    settings, diagnostics = _settings({key: value})
    assert settings.value(_TABLE.row(key)) == used
    (found,) = diagnostics
    assert words in found.message
    assert found.code == "parameter.bad-value"


def test_a_number_that_is_written_as_text_is_taken_and_told() -> None:
    settings, diagnostics = _settings({"rate": "1e-3"})
    assert settings.number("rate") == 0.001
    (found,) = diagnostics
    assert found.code == "parameter.number-as-text"
    assert found.message == (
        "/node: parameter 'rate' is the text '1e-3', used as the number 0.001; real ROS would not"
        " take it (YAML 1.1 reads 1e-3 as a text)"
    )


def test_what_a_table_has_no_row_for_cannot_be_read() -> None:
    settings, _ = _settings({})
    with pytest.raises(KeyError, match="thing has no parameter speed"):
        settings.number("speed")


def test_unknown_and_idle_parameters_are_told_with_what_is_near() -> None:
    settings, diagnostics = _settings(
        {"rat": 1, "ghost": 2, "inner": {"x": 1}, "a": {"plugin": "p"}, "use_sim_time": True}
    )
    settings.report_unknown()
    unknown, idle = diagnostics
    assert unknown.code == "parameter.unknown"
    assert "'rat' is not one of thing; it has no effect" in unknown.message
    assert "rate" in unknown.fix
    assert idle.code == "parameter.idle"
    assert "'ghost' (2) has no effect here: there is no such thing here" in idle.message


@pytest.mark.parametrize(("value", "told"), [(False, 0), (True, 1), ("true", 1)])
def test_what_asks_for_nothing_is_not_told(value: Any, told: int) -> None:
    settings, diagnostics = _settings({"verbose": value})
    settings.report_unknown()
    assert len(list(diagnostics)) == told


def test_a_long_value_is_told_by_its_beginning() -> None:
    settings, diagnostics = _settings({"ghost": [f"library_{number}" for number in range(50)]})
    settings.report_unknown()
    (idle,) = diagnostics
    assert "library_0" in idle.message and "… of 50) has no effect here" in idle.message
    assert len(idle.message) < 200


def test_names_with_slashes_and_dots_become_trees() -> None:
    tree = nested({"a/b": 1, "a.c": {"d": 2}, "e": 3})
    assert tree == {"a": {"b": 1, "c": {"d": 2}}, "e": 3}


def test_option_classes_are_tables_and_are_filled() -> None:
    table = table_of(SourceOptions, "sensor", "A sensor.", defaults={"raytrace_range": 4.0})
    diagnostics = Diagnostics()
    tree = {"obstacle_max_range": 1.5, "data_type": "PointCloud2", "transport_type": "raw"}
    settings = node_reader(table, tree, "/costmap/scan", diagnostics)
    options = settings.fill(SourceOptions, marking=False)
    assert (options.obstacle_range, options.raytrace_range) == (1.5, 4.0)
    assert (options.data_type, options.marking) == ("PointCloud2", False)
    settings.report_unknown()
    assert [item.code for item in diagnostics] == ["parameter.idle"]
    assert node_reader(
        table_of(CostmapOptions, "costmap", ""), {}, "", Diagnostics()
    ).fill(CostmapOptions) == CostmapOptions()  # fmt: skip
