"""Words copied from a printed page are named when a command fails, and only then."""

from __future__ import annotations

import pytest

from gazelle.cli.error_text import printed_characters
from gazelle.cli.main import main


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("\u2013r", "'-': -r"),
        ("\u2014rate", "'-': --rate"),
        ("\u2212a", "'-': -a"),
        ("\u2013\u2013clock", "'-': --clock"),
        ("-\u2013x", ""),
        ("\u2013", ""),
        ("\u20135", ""),
        ("a\u2013b", ""),
        ("\u201chello\u201d", "'\u201c' (U+201C), a quotation mark of printed text"),
        ("/scan\u00a0/odom", "(U+00A0), a space of printed text"),
        ("-r", ""),
    ],
)
def test_printed_characters_are_told_with_what_was_meant(word: str, meant: str) -> None:
    told = printed_characters(["fine", word])
    assert len(told) == bool(meant)
    assert all(meant in line for line in told)


def test_only_commands_that_fail_tell(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rosmsg", "show", "std_msgs/\u2019String"]) == 1
    assert "rosmsg: 'std_msgs/\u2019String' holds" in capsys.readouterr().err
    assert main(["complete", "rosmsg", "\u2013r"]) == 0
    assert capsys.readouterr().err == ""


def test_wrong_options_tell_too(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["roscore", "\u2013p", "11312"])
    assert "roscore: '\u2013p' begins with" in capsys.readouterr().err
