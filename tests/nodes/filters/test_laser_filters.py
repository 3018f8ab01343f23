"""Chains of scan filters: what parameters say, and what is wrong with them."""

from __future__ import annotations

import math
from typing import Any

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.navigation.laser_scans import FILTERS, REFUSED_FILTERS, FilterSetup
from gazelle.navigation.laser_scans.laser_filters import RangeOptions
from gazelle.nodes.filters.laser_filters import FILTER_TABLES, PARAMETERS, chain_of
from gazelle.nodes.parameters import node_reader


def _chain(tree: dict[str, Any], found: Diagnostics) -> list[FilterSetup]:
    return chain_of(tree, "/chain", found)


def _range(**params: Any) -> dict[str, Any]:
    return {"name": "r", "type": "laser_filters/LaserScanRangeFilter", "params": params}


def test_chains_of_both_generations_are_read() -> None:
    # Replacements are given: their default is no number, which no number equals.
    numbers = {"lower_replacement_value": 0.0, "upper_replacement_value": 9.0}
    found, one = Diagnostics(), _range(lower_threshold=1, **numbers)
    chain = _chain({"scan_filter_chain": [one]}, found)
    assert chain == _chain({"filter1": one}, found)
    assert chain[0].options.lower_threshold == 1.0
    twice = _chain({"filter1": one, "filter2": one}, found)
    assert [item.type for item in twice] == ["LaserScanRangeFilter"] * 2
    assert not list(found)


def test_unknown_filters_are_told_all_at_once() -> None:
    bad = [{"name": "a", "type": "laser_filters/LaserScanRangFilter"},
           {"name": "b", "type": "LaserScanPolygonFilter"}, "no mapping"]  # fmt: skip
    with pytest.raises(LaunchError) as caught:
        _chain({"scan_filter_chain": bad}, Diagnostics())
    text = str(caught.value)
    assert "did you mean 'LaserScanRangeFilter'" in text
    assert "LaserScanBoxFilter takes out beams by place" in text
    assert "filter 3 is 'no mapping'" in text
    assert not FILTERS.keys() & REFUSED_FILTERS.keys()


def test_values_that_a_filter_cannot_use_are_told_all_at_once() -> None:
    bad = _range(lower_threshold="near", use_message_range_limits="perhaps")
    with pytest.raises(LaunchError) as caught:
        _chain({"filter1": bad, "filter2": {**bad, "params": 5}}, Diagnostics())
    assert str(caught.value) == (
        "scan_to_scan_filter_chain: filter 'r': lower_threshold is 'near', not a number\n"
        "  filter 'r': use_message_range_limits is 'perhaps', not true or false\n"
        "  filter 'r': params is 5, not a group of parameters"
    )


def test_texts_that_say_false_or_infinity_are_that() -> None:
    found = Diagnostics()
    values = {"use_message_range_limits": "false", "upper_replacement_value": ".inf",
              "lower_replacement_value": math.nan}  # fmt: skip
    (one,) = _chain({"filter1": _range(**values)}, found)
    options: RangeOptions = one.options
    assert not options.use_message_range_limits
    assert options.upper_replacement_value == math.inf
    assert math.isnan(options.lower_replacement_value)
    assert not list(found)


def test_parameters_of_a_filter_that_it_lacks_or_does_not_use_are_told() -> None:
    found = Diagnostics()
    params = {"invert": True, "filter_override_intensity": True, "disp_histogram": 0, "lower": 1}
    _chain({"filter1": {"name": "i", "type": "LaserScanIntensityFilter", "params": params}}, found)
    assert [item.message for item in found] == [
        "/chain: filter 'i': parameter 'filter_override_intensity' (True) has no effect here: "
        "intensities stay",
        "/chain: filter 'i': parameter 'lower' is not one of LaserScanIntensityFilter; it has no "
        "effect",
    ]


def test_parameters_of_the_node_are_its_filters_and_little_else() -> None:
    found = Diagnostics()
    tree = {"filter1": {**_range(), "parms": {"a": 1}}, "lazy_subscription": True, "chain": []}
    node_reader(PARAMETERS, tree, "/chain", found).report_unknown()
    assert [item.message.partition("'")[2].partition("'")[0] for item in found] == [
        "filter1.parms.a", "lazy_subscription", "chain",
    ]  # fmt: skip


def test_every_filter_has_a_table() -> None:
    assert FILTER_TABLES.keys() == FILTERS.keys()
