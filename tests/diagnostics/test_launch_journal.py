from __future__ import annotations

import os
from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostic, Severity, SourceSpan, launch_journal, render
from gazelle.diagnostics.launch_journal import VARIABLE, begin, end, journals, keep_error, read
from gazelle.diagnostics.source_lines import Excerpt


@pytest.fixture(autouse=True)
def own_state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.delenv(VARIABLE, raising=False)


def begun(*words: str) -> Path:
    path = begin(words or ("roslaunch", "bot", "bot.launch"), 7447)
    assert path is not None
    return path


def finding(file: Path, message: str = "no such tag") -> Diagnostic:
    via = (SourceSpan("outer.xacro", 9, 2),)
    span = SourceSpan(str(file), 2, 2, 5, via)
    return Diagnostic("xml.unknown-tag", Severity.WARNING, message, span, "write <link>", "nothing")


def test_what_is_printed_in_a_launch_is_kept_with_its_source_line(tmp_path):
    robot = tmp_path / "a.urdf"
    robot.write_text("<robot>\n\t<lnik/>\n</robot>\n")
    path = begun()
    item = finding(robot)
    render([item])
    robot.write_text("something else\n")
    end(path, 1)
    kept = read(path)
    assert kept is not None
    assert kept.words == ("roslaunch", "bot", "bot.launch")
    assert (kept.folder, kept.port) == (str(Path.cwd()), 7447)
    assert (kept.is_running, kept.code) == (False, 1)
    assert [(each.item, each.source) for each in kept.told] == [
        (item, Excerpt(2, " <lnik/>", 2, 5))
    ]


def test_a_finding_told_by_several_processes_is_there_once(tmp_path):
    path = begun()
    render([finding(tmp_path / "gone.urdf")])
    render([finding(tmp_path / "gone.urdf")])
    kept = read(path)
    end(path, 0)
    assert kept is not None
    assert kept.is_running
    assert kept.code is None
    assert len(kept.told) == 1


def test_an_error_without_a_code_is_kept_with_its_fix():
    path = begun()
    keep_error("there is no package 'bto'\n  fix: did you mean 'bot'?")
    end(path, 1)
    kept = read(path)
    assert kept is not None
    (told,) = kept.told
    assert told.item.message == "there is no package 'bto'"
    assert told.item.fix == "did you mean 'bot'?"


def test_outside_of_a_launch_nothing_is_kept(tmp_path):
    render([finding(tmp_path / "gone.urdf")])
    keep_error("no")
    assert journals() == ()


def test_what_a_launch_starts_belongs_to_its_journal():
    path = begun()
    assert os.environ[VARIABLE] == str(path)
    assert begin(["roslaunch", "inner.launch"], 7447) is None
    end(None, 0)
    assert VARIABLE in os.environ
    end(path, 0)
    assert VARIABLE not in os.environ


def test_a_launch_that_was_killed_no_longer_runs(tmp_path):
    path = begun()
    end(path, 0)
    lines = path.read_text().splitlines()
    path.write_text(lines[0].replace(f'"pid": {os.getpid()}', '"pid": 999999999') + "\n")
    kept = read(path)
    assert kept is not None
    assert (kept.is_running, kept.code) == (False, None)


def test_the_newest_journal_is_first_and_old_ones_go(monkeypatch):
    monkeypatch.setattr(launch_journal, "_MOST_JOURNALS", 3)
    for number in range(5):
        monkeypatch.setattr(launch_journal.time, "time", lambda at=number: 1e9 + at)
        end(begun("roslaunch", f"{number}.launch"), 0)
    kept = [found for path in journals() if (found := read(path))]
    assert [each.words[1] for each in kept] == ["4.launch", "3.launch", "2.launch"]


def test_a_journal_does_not_grow_for_ever(tmp_path, monkeypatch):
    monkeypatch.setattr(launch_journal, "_MOST_BYTES", 2000)
    path = begun()
    for number in range(50):
        render([finding(tmp_path / "gone.urdf", f"no tag {number}")])
    end(path, 0)
    assert path.stat().st_size < 4000


def test_only_their_user_reads_the_journals():
    path = begun()
    end(path, 0)
    assert path.stat().st_mode & 0o077 == 0


@pytest.mark.parametrize("text", ["", "{}", "no json\n", '{"launch": 3}\n', '{"launch": {}}\n'])
def test_what_is_no_journal_is_none(tmp_path, text):
    path = tmp_path / "x.jsonl"
    path.write_text(text)
    assert read(path) is None
    assert read(tmp_path / "gone") is None


def test_findings_that_cannot_be_read_are_left_out():
    path = begun()
    with path.open("a") as file:
        file.write(
            '{"finding": {"code": 3}}\n{"finding": {"via": [], "span": [1, 2, 3, 4, 5, 6, 7]'
        )
    kept = read(path)
    end(path, 0)
    assert kept is not None
    assert kept.told == ()


def test_a_folder_that_cannot_be_written_stops_no_launch(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "file"))
    assert begin(["roslaunch", "x"], 0) is None
    assert VARIABLE not in os.environ
