from __future__ import annotations

import io

from gazelle.diagnostics import Diagnostic, Severity, SourceSpan, render, render_text
from gazelle.diagnostics.render import styled
from gazelle.diagnostics.source_lines import SourceLines


def finding(span: SourceSpan | None = None, fix: str = "", phrase: str = "") -> Diagnostic:
    return Diagnostic("xml.unknown-tag", Severity.WARNING, "no such tag", span, fix, phrase)


def test_the_source_line_is_shown_with_a_caret_under_the_place(tmp_path):
    file = tmp_path / "a.urdf"
    file.write_text("<robot>\n\t<lnik/>\n</robot>\n")
    text = render_text(finding(SourceSpan(str(file), 2, 2, 5), "write <link>", "nothing"))
    assert text.splitlines() == [
        f"{file}:2:2: warning: no such tag [xml.unknown-tag]",
        "      2 |  <lnik/>",
        "        |  ^^^^^",
        "  fix: write <link>",
        "  ROS/Gazebo says: nothing",
    ]


def test_the_caret_stays_within_the_line():
    sources = {"<robot_description>": "<a/>"}
    text = render_text(finding(SourceSpan("<robot_description>", 1, 3, 99)), sources)
    assert text.splitlines()[-1].endswith("|   ^^")


def test_the_way_there_is_shown_innermost_first():
    via = (SourceSpan("inner.xacro", 4, 1), SourceSpan("outer.xacro", 9, 2))
    text = render_text(finding(SourceSpan("gone.xacro", 1, 1, 0, via)))
    assert text.splitlines()[-2:] == ["  from inner.xacro:4:1", "  from outer.xacro:9:2"]


def test_a_place_that_cannot_be_read_is_only_named():
    for span in (SourceSpan("gone.urdf", 3, 1), SourceSpan("a\0b", 1), SourceSpan("x")):
        assert len(render_text(finding(span)).splitlines()) == 1


def test_a_line_beyond_the_end_is_only_named():
    text = render_text(finding(SourceSpan("t", 9, 1)), {"t": "one line"})
    assert len(text.splitlines()) == 1


def test_printing_keeps_the_order_and_long_lines(tmp_path):
    stream = io.StringIO()
    long = Diagnostic("xml.malformed", Severity.ERROR, "x" * 300)
    render([finding(), long], stream=stream)
    lines = stream.getvalue().splitlines()
    assert lines[0] == "warning: no such tag [xml.unknown-tag]"
    assert lines[1] == f"error: {'x' * 300} [xml.malformed]"


def test_brackets_in_messages_are_no_markup():
    stream = io.StringIO()
    render([Diagnostic("xml.malformed", Severity.ERROR, "[bold]a[/bold]")], stream=stream)
    assert "[bold]a[/bold]" in stream.getvalue()


def test_of_an_endless_line_the_place_is_shown() -> None:
    line = "x" * 200_000 + "<lnik/>" + "y" * 200_000
    sources = {"<text>": line}
    text = render_text(finding(SourceSpan("<text>", 1, 200_001, 7)), sources)
    _head, shown, caret = text.splitlines()
    assert len(shown) < 200
    assert shown.startswith("      1 | …xx") and shown.endswith("yy…")
    column = caret.index("^")
    assert shown[column : column + 7] == "<lnik/>"
    assert caret.endswith(" ^^^^^^^")
    first = render_text(finding(SourceSpan("<text>", 1, 1, 1)), sources).splitlines()
    assert first[1].startswith("      1 | xxx") and first[2].endswith("|" + " " + "^")


def test_of_an_endless_message_the_ends_are_shown() -> None:
    text = render_text(Diagnostic("xml.unknown-tag", Severity.ERROR, "a" * 400_000, None, "", ""))
    assert len(text) < 2_200
    assert "(400000 characters)" in text


def test_a_file_does_not_steer_the_terminal() -> None:
    sources = {"<text>": "a\x1b[2Jb"}
    assert "a·[2Jb" in render_text(finding(SourceSpan("<text>", 1, 1, 1)), sources)


def test_a_file_is_read_once_for_all_of_its_findings(tmp_path) -> None:
    file = tmp_path / "a.urdf"
    file.write_text("one\ntwo\n")
    lines = SourceLines()
    assert lines.line(SourceSpan(str(file), 1)) == "one"
    file.unlink()
    assert lines.line(SourceSpan(str(file), 2)) == "two"
    assert lines.line(SourceSpan(str(file), 3)) is None


def test_words_of_ros_can_be_left_out() -> None:
    text = styled(finding(phrase="nothing"), SourceLines(), with_phrase=False).plain
    assert text == "warning: no such tag [xml.unknown-tag]"


def test_a_remedy_that_points_at_the_message_is_left_out() -> None:
    assert render_text(finding(fix="see the message")) == "warning: no such tag [xml.unknown-tag]"
