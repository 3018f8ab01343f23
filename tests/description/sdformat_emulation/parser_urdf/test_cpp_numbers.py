from __future__ import annotations

import math

import pytest

from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import (
    NumberCrashError,
    brief_text,
    exact_text,
    leading_integer,
    leading_number,
    streamed_numbers,
)


@pytest.mark.parametrize(
    ("text", "value"),
    [(" 1.5e3x", 1500.0), ("-.5", -0.5), ("0x1p4", 16.0), ("0x", 0.0), ("0e-999", 0.0),
     ("-inf", -math.inf), ("1e", 1.0), ("0.0", 0.0)],
)  # fmt: skip
def test_leading_numbers(text: str, value: float) -> None:
    assert leading_number(text) == value


def test_no_number_is_one() -> None:
    assert math.isnan(leading_number("nan"))


@pytest.mark.parametrize(
    ("text", "kind"),
    [("", "invalid_argument"), (".", "invalid_argument"), ("e5", "invalid_argument"),
     ("1e400", "out_of_range"), ("-4e-310", "out_of_range"), ("0x1p9999", "out_of_range")],
)  # fmt: skip
def test_numbers_that_end_the_program(text: str, kind: str) -> None:
    with pytest.raises(NumberCrashError, match=f"'std::{kind}'\n  what\\(\\):  stod"):
        leading_number(text)


def test_integers_stop_at_the_point() -> None:
    assert leading_integer(" -7.9") == -7
    with pytest.raises(NumberCrashError, match="out_of_range"):
        leading_integer("2147483648")
    with pytest.raises(NumberCrashError, match="out_of_range"):
        leading_integer("9" * 5000)


def test_streams_stop_at_what_is_no_number() -> None:
    assert streamed_numbers("1 -2\t3e1 and", 3) == (1.0, -2.0, 30.0)
    assert streamed_numbers("1, 2, 3", 3) is None
    assert streamed_numbers("1 2", 3) is None
    assert streamed_numbers("1 1e999", 2) is None


def test_texts_of_numbers() -> None:
    assert exact_text((0.1, -0.0, 1e16, 1 / 3)) == "0.1 0 1e+16 0.3333333333333333"
    assert brief_text((0.1234567, -0.0, 1e16)) == "0.123457 -0 1e+16"
    assert exact_text((math.nan, math.inf)) == "nan inf"
