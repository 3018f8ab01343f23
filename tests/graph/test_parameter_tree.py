from __future__ import annotations

import datetime as dt
import math

import numpy as np
import pytest

from gazelle.errors import GraphError
from gazelle.graph.parameter_tree import ParameterTree, from_json, to_json


def test_namespaces_are_dictionaries() -> None:
    tree = ParameterTree()
    tree.set("/robot/wheel/radius", 0.033)
    tree.set("/robot/name", "r2")
    assert tree.get("/robot") == {"wheel": {"radius": 0.033}, "name": "r2"}
    assert tree.names() == ["/robot/wheel/radius", "/robot/name"]
    assert tree.has("/robot/wheel")
    assert not tree.has("/robot/wheel/width")


def test_setting_a_dictionary_replaces_the_namespace() -> None:
    tree = ParameterTree({"a": {"x": 1, "y": 2}})
    tree.set("/a", {"z": 3})
    assert tree.get("/") == {"a": {"z": 3}}


def test_setting_below_a_value_makes_it_a_namespace() -> None:
    tree = ParameterTree({"a": 1})
    tree.set("/a/b", 2)
    assert tree.get("/a") == {"b": 2}


def test_values_are_copies() -> None:
    tree, value = ParameterTree(), {"l": [1]}
    tree.set("/a", value)
    value["l"].append(2)
    tree.get("/a")["l"].append(3)
    assert tree.get("/a/l") == [1]


def test_search_goes_up_and_only_the_first_part_counts() -> None:
    tree = ParameterTree({"gains": {"p": 1}, "ns": {"gains": {"q": 2}}})
    assert tree.search("gains/p", "/ns/node") == "/ns/gains/p"
    assert tree.search("gains", "/other/node") == "/gains"
    assert tree.search("nothing", "/ns/node") is None
    assert tree.search("/gains/p", "/ns") == "/gains/p"
    assert tree.search("/gains/x", "/ns") is None


def test_missing_and_root() -> None:
    tree = ParameterTree({"a": 1})
    with pytest.raises(KeyError, match="/b"):
        tree.get("/b")
    with pytest.raises(KeyError, match="/a/b"):
        tree.delete("/a/b")
    with pytest.raises(GraphError, match="cannot delete root"):
        tree.delete("/")
    with pytest.raises(GraphError, match="cannot set root of parameter tree to non-dictionary"):
        tree.set("/", 1)
    tree.delete("/a")
    assert tree.get("/") == {}


def test_unusable_types_are_told() -> None:
    with pytest.raises(GraphError, match="parameter '/a/b' cannot be a object"):
        ParameterTree().set("/a", {"b": object()})


def test_numpy_and_tuples_become_plain() -> None:
    tree = ParameterTree()
    tree.set("/a", (np.float64(1.5), np.int32(2), np.zeros(2)))
    assert tree.get("/a") == [1.5, 2, [0.0, 0.0]]


NUMBERS = [1, 1.0, -0.0, 10**400, math.inf, True, 0.1 + 0.2]
TEXTS = ["", "ünï", b"\0\xff", dt.datetime(2020, 1, 2, 3, 4, 5), dt.date(2020, 1, 2)]
TREES = [
    [],
    {},
    {"$bytes": "x"},
    {"$a": 1, "b": 2},
    [1, [2.0, {"k": b"x"}]],
    {"$dict": {"$dict": 1}},
]
VALUES = [*NUMBERS, *TEXTS, *TREES]


@pytest.mark.parametrize("value", VALUES, ids=repr)
def test_every_value_survives_the_wire_exactly(value: object) -> None:
    back = from_json(to_json(value))
    assert back == value
    assert type(back) is type(value)
    assert repr(back) == repr(value)
