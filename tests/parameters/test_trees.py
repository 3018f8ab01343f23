"""Trees of parameters and lists of their leaves."""

from __future__ import annotations

from gazelle.parameters.trees import flattened, leaves_at, nested, values_only


def test_dots_slashes_and_branches_are_the_same() -> None:
    assert nested({"a.b": 1, "a": {"c": 2}, "d/e": 3}) == {"a": {"b": 1, "c": 2}, "d": {"e": 3}}
    assert nested({"a/b": 1, "a.c": {"d": 2}, "/e/": 3}) == {"a": {"b": 1, "c": {"d": 2}}, "e": 3}


def test_branches_that_are_written_in_parts_hold_all_of_them() -> None:
    assert nested({"a.b.c": 1, "a": {"b": {"d": 2}}}) == {"a": {"b": {"c": 1, "d": 2}}}


def test_the_last_one_counts_where_a_value_and_a_branch_have_one_name() -> None:
    assert nested({"a": 1, "a.b": 2}) == {"a": {"b": 2}}
    assert nested({"a.b": 2, "a": 1}) == {"a": 1}


def test_an_empty_branch_is_a_leaf_without_a_value() -> None:
    leaves = list(flattened({"a": {"b": 1}, "c": {}}))
    assert leaves == [("a.b", 1), ("c", {})]
    assert list(values_only(leaves)) == [("a.b", 1)]
    assert nested(dict(leaves)) == {"a": {"b": 1}, "c": {}}


def test_names_of_ros1_have_slashes() -> None:
    tree = {"a": {"b.c": 1}, "d": 2}
    assert dict(flattened(tree, "/", separator="/")) == {"/a/b.c": 1, "/d": 2}


def test_what_stands_at_a_name_is_a_value_or_its_leaves() -> None:
    assert list(leaves_at("/rate", 5)) == [("/rate", 5)]
    assert list(leaves_at("/", {"a": {"b": 1}, "c": {}})) == [("/a/b", 1), ("/c", {})]
    assert list(leaves_at("/robot", {"a": 1})) == [("/robot/a", 1)]
    assert list(leaves_at("", {})) == [("/", {})]
