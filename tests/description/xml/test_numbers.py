from __future__ import annotations

import locale

import pytest

from gazelle.description.xml import bool_from, float_from, floats_from, int_from, parse_xml
from gazelle.diagnostics import Diagnostics, SourceSpan

SPAN = SourceSpan("a.urdf", 3, 5)


def floats(text: str, count: int = 3):
    diagnostics = Diagnostics()
    default = (9.0,) * count
    found = floats_from(
        text, count, default, what="<origin xyz>", span=SPAN, diagnostics=diagnostics
    )
    return found, [item.message for item in diagnostics.by_code("xml.bad-number")]


def tag(text: str):
    return parse_xml(f"<v>{text}</v>", "a.sdf", Diagnostics())


def test_numbers_are_separated_by_any_white_space():
    assert floats(" 1\t-2.5\n 3e-2 ") == ((1.0, -2.5, 0.03), [])


@pytest.mark.parametrize("word", ["1,5", "nan", "inf", "-infinity", "1_000", "0x10", "abc"])
def test_what_is_no_finite_number_is_reported(word):
    found, messages = floats(f"0 {word} 0")
    assert found == (9, 9, 9)
    assert messages[0].startswith(f"<origin xyz>: '{word}' is not a finite number")


def test_a_decimal_comma_is_named():
    assert "the decimal sign is a dot, not a comma" in floats("0,5 0 0")[1][0]


@pytest.mark.parametrize(("text", "count"), [("1 2", 2), ("1 2 3 4", 4), ("", 0)])
def test_too_few_and_too_many_numbers_are_reported(text, count):
    found, messages = floats(text)
    assert found == (9, 9, 9)
    assert messages == [f"<origin xyz> needs 3 numbers, found {count}: '{text}'"]


def test_one_missing_number_is_singular():
    assert floats("", 1)[1] == ["<origin xyz> needs 1 number, found 0: ''"]


def test_the_locale_does_not_matter():
    before = locale.setlocale(locale.LC_NUMERIC)
    try:
        locale.setlocale(locale.LC_NUMERIC, "")
        assert floats("0.5 0 0") == ((0.5, 0, 0), [])
    finally:
        locale.setlocale(locale.LC_NUMERIC, before)


def test_single_values_have_defaults():
    diagnostics = Diagnostics()
    assert float_from(None, 1.5, diagnostics) == 1.5
    assert float_from(tag(""), 1.5, diagnostics) == 1.5
    assert float_from(tag("2"), 1.5, diagnostics) == 2
    assert int_from(tag("3.9"), 1, diagnostics) == 3
    assert int_from(None, 7, diagnostics) == 7
    assert not len(diagnostics)
    assert float_from(tag("x"), 1.5, diagnostics) == 1.5
    (found,) = diagnostics
    assert found.message == "<v>: 'x' is not a finite number"


@pytest.mark.parametrize("word", ["1", "true", "True", "YES", "on", " true "])
def test_words_for_true(word):
    assert bool_from(tag(word), False, Diagnostics()) is True


@pytest.mark.parametrize("word", ["0", "false", "FALSE", "no", "off"])
def test_words_for_false(word):
    assert bool_from(tag(word), True, Diagnostics()) is False


def test_other_words_are_reported_and_the_default_used():
    diagnostics = Diagnostics()
    assert bool_from(tag("maybe"), True, diagnostics) is True
    assert bool_from(None, True, diagnostics) is True
    (found,) = diagnostics.by_code("xml.bad-number")
    assert found.message == "<v>: 'maybe' is neither true nor false; True is used"
    assert found.fix == "write true or false"


@pytest.mark.parametrize(
    ("text", "count", "what", "fix"),
    [
        ("0,09", 1, "<cylinder length>", "write 0.09"),
        ("1,2,3", 3, "<origin xyz>", "write 1 2 3"),
        ("1 2 0.5", 6, "<pose>", "write 1 2 0.5 0 0 0"),
        ("0.1 0.2", 3, "<origin xyz>", "write 0.1 0.2 0"),
        ("0.0.2", 1, "<box>", "write 0.02 or 0.2: a number has one decimal point"),
        ("ten", 1, "<update_rate>", "write a number such as <update_rate>4</update_rate>, which "
                                    "counts now"),
    ],
)  # fmt: skip
def test_what_to_write_for_numbers_that_are_nearly_right(text, count, what, fix):
    found = Diagnostics()
    default = (4.0,) * count
    floats_from(text, count, default, what=what, span=SourceSpan("f", 1), diagnostics=found)
    assert [item.fix for item in found] == [fix]


def test_sizes_that_are_missing_are_not_made_up():
    found = Diagnostics()
    span = SourceSpan("f", 1)
    floats_from("0.1 0.2", 3, (1.0,) * 3, what="<box size>", span=span, diagnostics=found)
    assert [item.fix for item in found] == [
        "write plain numbers separated by spaces, such as 0.5 0 1e-3"
    ]
