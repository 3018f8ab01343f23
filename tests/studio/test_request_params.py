"""Parameters of calls: whatever JSON a page sends, it is taken or refused with words."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import hypothesis.strategies as st
import pytest
from hypothesis import given

from gazelle.studio.errors import StudioError
from gazelle.studio.json_text import finite_number
from gazelle.studio.request_params import Params

_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=80)
    | st.sampled_from([10**400, -(10**400), 1e300]),
    lambda inner: st.lists(inner, max_size=5) | st.dictionaries(st.text(max_size=4), inner),
    max_leaves=8,
)  # fmt: skip
_READERS: list[Callable[[Params], Any]] = [
    lambda params: params.text("x"),
    lambda params: params.number("x"),
    lambda params: params.number("x", least=0.0, most=1.0),
    lambda params: params.whole("x"),
    lambda params: params.flag("x"),
    lambda params: params.texts("x"),
    lambda params: params.numbers("x"),
    lambda params: params.numbers("x", count=3),
    lambda params: params.object("x"),
    lambda params: params.any("x"),
]


@given(value=_JSON, reader=st.sampled_from(_READERS))
def test_every_value_is_taken_or_refused_with_the_parameters_name(
    value: Any, reader: Callable[[Params], Any]
) -> None:
    try:
        found = reader(Params("m", {"x": value}))
    except StudioError as error:
        assert str(error).startswith("m: parameter 'x' is ")
        assert len(str(error)) < 150
        return
    numbers = found if isinstance(found, list) else [found]
    assert all(math.isfinite(one) for one in numbers if isinstance(one, float)) or found is value


@given(value=_JSON)
def test_params_are_an_object_or_refused(value: Any) -> None:
    try:
        params = Params("m", value)
    except StudioError as error:
        assert "m: 'params' is an object, not " in str(error)
    else:
        assert params.values == (value or {})


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (10**400, "parameter 'x' is a number from -inf to inf, not 1000000"),
        (-(10**400), "parameter 'x' is a number from -inf to inf, not -1000000"),
        (math.nan, "parameter 'x' is a number from -inf to inf, not nan"),
        ("1", "parameter 'x' is a number, not '1'"),
        (True, "parameter 'x' is a number, not True"),
    ],
)
def test_number_that_is_none_is_told(value: Any, words: str) -> None:
    with pytest.raises(StudioError, match=words):
        Params("m", {"x": value}).number("x")
    with pytest.raises(StudioError, match="parameter 'x' is a list of numbers, not"):
        Params("m", {"x": [1.0, value]}).numbers("x")


def test_value_that_is_nested_without_end_is_shown_in_short() -> None:
    value: list[Any] = []
    value.append(value)
    with pytest.raises(StudioError, match=r"is a text, not \[\[\["):
        Params("m", {"x": value}).text("x")
    nested: Any = 0
    for _ in range(100_000):
        nested = [nested]
    with pytest.raises(StudioError, match=r"is a text, not \[\[\["):
        Params("m", {"x": nested}).text("x")


@pytest.mark.parametrize("value", [True, None, "1", [1], {}, math.inf, math.nan, 10**400])
def test_finite_number_of_what_is_none(value: Any) -> None:
    assert finite_number(value) is None
