from __future__ import annotations

import pytest

from gazelle.diagnostics import SourceSpan


@pytest.mark.parametrize(
    ("span", "text"),
    [
        (SourceSpan("a.urdf"), "a.urdf"),
        (SourceSpan("a.urdf", 3), "a.urdf:3"),
        (SourceSpan("a.urdf", 3, 7), "a.urdf:3:7"),
        (SourceSpan("a.urdf", 0, 7), "a.urdf"),
    ],
)
def test_a_place_reads_like_a_compilers(span, text):
    assert str(span) == text


def test_places_sort_by_file_line_and_column():
    places = [SourceSpan("b", 1), SourceSpan("a", 2, 1), SourceSpan("a", 1, 9)]
    assert sorted(places) == places[::-1]
