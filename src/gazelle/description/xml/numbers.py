"""Numbers in attributes and texts, read without locale, all mistakes reported."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from gazelle.description.xml.spans import attribute_span
from gazelle.description.xml.tag import Tag
from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["bool_from", "float_from", "floats_from", "int_from"]

_ZEROS = frozenset({(6, "<pose>"), (3, "<origin xyz>"), (3, "<origin rpy>")})
_TRUE = frozenset({"1", "true", "yes", "on"})
_FALSE = frozenset({"0", "false", "no", "off"})


def floats_from(
    text: str,
    count: int,
    default: tuple[float, ...],
    *,
    what: str,
    span: SourceSpan,
    diagnostics: Diagnostics,
    attribute: str = "",
) -> tuple[float, ...]:
    """Return exactly `count` finite numbers; `default` and a reported error otherwise.

    Args:
        text: numbers separated by white space.
        count: how many are needed.
        default: what to go on with when the text is unusable.
        what: the element or attribute, for the message, such as ``<origin xyz>``.
        span: where the text stands, or the element whose attribute it is.
        diagnostics: receives ``xml.bad-number``.
        attribute: the attribute that holds the text, empty when none does.
    """
    tokens = text.split()
    if len(tokens) == count and "_" not in text:
        try:
            good = tuple(map(float, tokens))
        except ValueError:
            good = (math.nan,)
        if all(map(math.isfinite, good)):
            return good
    values = [_number(token) for token in tokens]
    bad = [token for token, value in zip(tokens, values, strict=True) if value is None]
    if not bad and len(values) == count:
        return tuple(value for value in values if value is not None)
    if bad:
        comma = " (the decimal sign is a dot, not a comma)" if "," in bad[0] else ""
        message = f"{what}: '{bad[0]}' is not a finite number{comma}"
    else:
        message = f"{what} needs {count} number{'s' * (count != 1)}, found {len(values)}: '{text}'"
    span = attribute_span(span, attribute, bad[0] if bad else "") if attribute else span
    fix = _instead(text, bad, count, what)
    word = what.strip("<>")
    if not fix and what == f"<{word}>" and count == 1:
        # What counts in its place is plain: the default, or nothing.
        fix = f"write a number, or remove <{word}>: it counts as if it were not there"
        if default:
            fix = f"write a number such as <{word}>{default[0]:g}</{word}>, which counts now"
    diagnostics.report("xml.bad-number", message, span, fix=fix)
    return default


def _instead(text: str, bad: Sequence[str], count: int, what: str) -> str:
    """Say what to write for numbers that are nearly right, nothing where nobody can know."""
    if not bad:
        # A pose of three numbers turns nothing; what lies flat has no third place.
        if count > len(text.split()) and (count, what) in _ZEROS:
            return f"write {' '.join([*text.split(), *['0'] * (count - len(text.split()))])}"
        return ""
    with_dots, with_spaces = text.replace(",", "."), text.replace(",", " ")
    for written in (with_spaces, with_dots):
        values = [_number(token) for token in written.split()]
        if "," in text and len(values) == count and None not in values:
            return f"write {' '.join(written.split())}"
    if len(bad) == 1 and re.fullmatch(r"-?\d*\.\d*\.\d+", bad[0]):
        first, second = bad[0].index("."), bad[0].rindex(".")
        one = bad[0][:second] + bad[0][second + 1 :]
        other = bad[0][:first] + bad[0][second:]
        return f"write {one} or {other}: a number has one decimal point"
    return ""


def float_from(tag: Tag | None, default: float, diagnostics: Diagnostics) -> float:
    """Return the number in a tag's text; `default` when the tag is None or empty."""
    if tag is None or not tag.text:
        return default
    what = f"<{tag.name}>"
    found = floats_from(tag.text, 1, (default,), what=what, span=tag.span, diagnostics=diagnostics)
    return found[0]


def int_from(tag: Tag | None, default: int, diagnostics: Diagnostics) -> int:
    """Return the integer in a tag's text; a fraction is cut off as the C++ readers do."""
    return int(float_from(tag, float(default), diagnostics))


def bool_from(tag: Tag | None, default: bool, diagnostics: Diagnostics) -> bool:
    """Return the truth value in a tag's text: 1/true/yes/on or 0/false/no/off, any case."""
    if tag is None or not tag.text:
        return default
    token = tag.text.strip().lower()
    if token in _TRUE:
        return True
    if token not in _FALSE:
        message = f"<{tag.name}>: '{tag.text}' is neither true nor false; {default} is used"
        diagnostics.report("xml.bad-number", message, tag.span, fix="write true or false")
        return default
    return False


def _number(token: str) -> float | None:
    try:
        value = float(token)
    except ValueError:
        return None
    # float() also takes underscores and words such as 'infinity', C++ readers do not.
    return value if math.isfinite(value) and "_" not in token else None
