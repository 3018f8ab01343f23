"""Two SDF texts compared as structure: order of siblings does not count, numbers to 1e-9."""

from __future__ import annotations

import math
from collections.abc import Iterator

from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics

__all__ = ["differences"]

_TOLERANCE = 1e-9


def differences(ours: str, theirs: str, *, tolerance: float = _TOLERANCE) -> list[str]:
    """Return what differs, one line each with the path of the element; empty when nothing does.

    Siblings are paired by element name and, where they have one, by their attribute ``name``;
    others by equal content first, then by order. Comments do not count. Texts and attribute values
    that consist of numbers are equal when every number is, absolutely or relatively.

    Args:
        ours: text to judge.
        theirs: text it should equal.
        tolerance: largest absolute or relative difference of two numbers.
    """
    roots = [_parsed(ours, "ours"), _parsed(theirs, "theirs")]
    if roots[0].name != roots[1].name:
        return [f"root: <{roots[0].name}> instead of <{roots[1].name}>"]
    return list(_compared(roots[0], roots[1], f"/{roots[1].name}", tolerance))


def _parsed(text: str, name: str) -> Tag:
    diagnostics = Diagnostics()
    root = parse_xml(text, name, diagnostics)
    if root is None:
        raise ValueError(f"{name} is no XML: {[str(item) for item in diagnostics]}\n{text[:500]}")
    return root


def _compared(ours: Tag, theirs: Tag, path: str, tolerance: float) -> Iterator[str]:
    if not _same_text(ours.text, theirs.text, tolerance):
        yield f"{path}: text {ours.text!r} instead of {theirs.text!r}"
    yield from _compared_attributes(ours.attributes, theirs.attributes, path, tolerance)
    names = dict.fromkeys(child.name for child in (*theirs.children, *ours.children))
    for name in names:
        yield from _compared_siblings(ours.find_all(name), theirs.find_all(name), path, tolerance)


def _compared_attributes(
    ours: dict[str, str], theirs: dict[str, str], path: str, tolerance: float
) -> Iterator[str]:
    for key in sorted(ours.keys() | theirs.keys()):
        if key not in ours:
            yield f"{path}: lacks {key}={theirs[key]!r}"
        elif key not in theirs:
            yield f"{path}: has {key}={ours[key]!r} too much"
        elif not _same_text(ours[key], theirs[key], tolerance):
            yield f"{path}: {key}={ours[key]!r} instead of {theirs[key]!r}"


def _compared_siblings(
    ours: tuple[Tag, ...], theirs: tuple[Tag, ...], path: str, tolerance: float
) -> Iterator[str]:
    left = list(ours)
    missing: list[Tag] = []
    for wanted in theirs:
        found = next((tag for tag in left if _same(tag, wanted, tolerance)), None)
        if found is None:
            missing.append(wanted)
        else:
            left.remove(found)
    for wanted in missing:
        label = wanted.attributes.get("name")
        near = [tag for tag in left if tag.attributes.get("name") == label]
        place = f"{path}/{wanted.name}" + (f"[{label}]" if label is not None else "")
        if not near:
            yield f"{place}: is missing: {_short(wanted)}"
            continue
        left.remove(near[0])
        yield from _compared(near[0], wanted, place, tolerance)
    for tag in left:
        yield f"{path}/{tag.name}: is too much: {_short(tag)}"


def _same(ours: Tag, theirs: Tag, tolerance: float) -> bool:
    if ours.attributes.keys() != theirs.attributes.keys():
        return False
    return next(_compared(ours, theirs, "", tolerance), None) is None


def _same_text(ours: str, theirs: str, tolerance: float) -> bool:
    if ours == theirs:
        return True
    words, wanted = ours.split(), theirs.split()
    return len(words) == len(wanted) and all(
        _same_word(word, want, tolerance) for word, want in zip(words, wanted, strict=True)
    )


def _same_word(ours: str, theirs: str, tolerance: float) -> bool:
    if ours == theirs:
        return True
    try:
        return math.isclose(float(ours), float(theirs), rel_tol=tolerance, abs_tol=tolerance)
    except ValueError:
        return False


def _short(tag: Tag) -> str:
    text = " ".join(tag.to_xml().split())
    return text if len(text) <= 120 else f"{text[:117]}..."
