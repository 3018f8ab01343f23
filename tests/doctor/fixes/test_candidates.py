"""What could be written for a finding, the most likely first."""

from __future__ import annotations

import pytest

from gazelle.diagnostics import Diagnostic, Severity, SourceSpan
from gazelle.doctor.fixes import SourceText, candidates, edited


def first(text: str, finding: Diagnostic) -> tuple[str, bool]:
    source = SourceText("f", text)
    one = next(candidates(finding, lambda file: source if file == "f" else None))
    return edited(text, one.edits), one.is_certain


def told(message: str, fix: str, line: int, column: int = 1, code: str = "x.y") -> Diagnostic:
    return Diagnostic(code, Severity.ERROR, message, SourceSpan("f", line, column), fix)


@pytest.mark.parametrize(
    ("text", "finding", "after"),
    [
        # The word that is told of, not one that is like it.
        (
            '<joint name="base_likn_joint">\n  <child link="base_likn"/>\n</joint>',
            told("child link 'base_likn' not found", "did you mean 'base_link'?", 2, 3),
            '<joint name="base_likn_joint">\n  <child link="base_link"/>\n</joint>',
        ),
        # Both ends of an element.
        (
            "<a>\n  <visaul>\n    <b/>\n  </visaul>\n</a>",
            told("<visaul> is not known inside <a>", "did you mean 'visual'?", 2, 3),
            "<a>\n  <visual>\n    <b/>\n  </visual>\n</a>",
        ),
        # A word of a path.
        (
            '<mesh filename="package://bot/meshes/lgi.stl"/>',
            told(
                "'package://bot/meshes/lgi.stl' not found; did you mean "
                "'package://bot/meshes/leg.stl'?",
                "correct the address",
                1,
            ),
            '<mesh filename="package://bot/meshes/leg.stl"/>',
        ),
        (
            '<axis xyz="1 0 0"/>',
            told("off", 'write <axis xyz="0 1 0"/>, and turn it', 1, 1),
            '<axis xyz="0 1 0"/>',
        ),
        (
            '<limit lower="1" upper="-1"/>',
            told("exchanged", 'write lower="-1" upper="1"', 1, 1),
            '<limit lower="-1" upper="1"/>',
        ),
        (
            '<node pkg="a" name="b"/>',
            told("it has no type", 'add type="c"', 1, 1),
            '<node pkg="a" name="b" type="c"/>',
        ),
        (
            "<package>\n  <name>a</name>\n  <depend>b</depend>\n  <export/>\n</package>",
            told("undeclared", "add <exec_depend>c</exec_depend>", 1, 1),
            "<package>\n  <name>a</name>\n  <depend>b</depend>\n  <exec_depend>c</exec_depend>\n"
            "  <export/>\n</package>",
        ),
        (
            "a:\n  b\n",
            told("", "", 2, 3, code="control.parameter-file"),
            "a:\n  b:\n",
        ),
        (
            "a:\n  b:1\n",
            told("", "", 2, 3, code="control.parameter-file"),
            "a:\n  b: 1\n",
        ),
        (
            "cmake_minimum_required(VERSION 3.5)\nament_package()\n",
            told("", "install(DIRECTORY urdf DESTINATION share/a)", 1, 1, "package.not-installed"),
            "cmake_minimum_required(VERSION 3.5)\ninstall(DIRECTORY urdf DESTINATION share/a)\n"
            "ament_package()\n",
        ),
    ],
)
def test_certain_fix_is_written_where_it_belongs(
    text: str, finding: Diagnostic, after: str
) -> None:
    assert first(text, finding) == (after, True)


@pytest.mark.parametrize(
    ("text", "finding", "after"),
    [
        (
            '<link name="a">\n  <visual/>\n</link>',
            told("", 'paste into <link name="a">\n<inertial>\n  <mass value="1"/>\n</inertial>', 1),
            '<link name="a">\n  <visual/>\n  <inertial>\n    <mass value="1"/>\n  </inertial>\n'
            "</link>",
        ),
        (
            '<a v="0.0.2"/>',
            told("'0.0.2' is not a finite number", "write 0.02 or 0.2: one point", 1, 1,
                 "xml.bad-number"),
            '<a v="0.02"/>',
        ),
        (
            "<a>\n  <b>\n    <c/>\n</a>",
            told("<b> has no end", "write </b> where it ends", 2, 3, "xml.malformed"),
            "<a>\n  <b>\n    <c/>\n  </b>\n</a>",
        ),
    ],
)  # fmt: skip
def test_estimates_are_not_certain(text: str, finding: Diagnostic, after: str) -> None:
    assert first(text, finding) == (after, False)


def test_where_the_place_does_not_have_the_word_the_way_there_does() -> None:
    inner, outer = SourceSpan("other", 3), SourceSpan("f", 1, 1)
    span = SourceSpan("other", 3, via=(inner, outer))
    finding = Diagnostic("x.y", Severity.ERROR, "no 'lgi' here", span, "did you mean 'leg'?")
    assert first("use lgi", finding) == ("use leg", True)


def test_no_words_no_candidates() -> None:
    finding = told("it is broken", "mend it", 1)
    assert list(candidates(finding, lambda file: SourceText(file, "a b c"))) == []
