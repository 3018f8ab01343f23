"""``urdf_to_graphviz`` and its old name as commands."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from gazelle.cli import urdf_to_graphiz
from gazelle.cli.urdf_to_graphviz import main

_TWO = (
    '<robot name="{}"><link name="a"/><link name="b"/><joint name="j" type="fixed">'
    '<parent link="a"/><child link="b"/></joint></robot>'
)
_USAGE = "Usage: urdf_to_graphviz input.xml [OUTPUT]  Will create either $ROBOT_NAME.gv & "
_DEPRECATED = "WARNING: OUTPUT not given. This type of usage is deprecated!" + _USAGE
_OLD_NAME = "WARNING: The executable named 'urdf_to_graphiz' is deprecated. Use"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with ``r.urdf``, where no ``dot`` is on the path."""
    (tmp_path / "r.urdf").write_text(_TWO.format("r"), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", "")
    return tmp_path


def test_the_drawing_is_named_by_the_robot_or_as_told(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["r.urdf"]) == 0
    shown = capsys.readouterr()
    assert shown.out == "Created file r.gv\n"
    assert shown.err.startswith(_DEPRECATED)
    assert main(["r.urdf", "out"]) == 0
    shown = capsys.readouterr()
    assert shown.out == "Created file out.gv\n"
    assert _USAGE not in shown.err
    assert (here / "out.gv").read_bytes() == (here / "r.gv").read_bytes()
    assert '"a" -> "j" [label="xyz: 0 0 0 \\nrpy: 0 -0 0"]' in (here / "r.gv").read_text()


def test_without_dot_it_says_what_to_install(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["r.urdf", "out"]) == 0
    err = capsys.readouterr().err
    assert "'out.pdf' was not made: the program 'dot' is not here; install Graphviz" in err
    assert not (here / "out.pdf").exists()


def test_dot_typesets_and_its_failure_is_said(
    here: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    dot = here / "dot"
    dot.write_text('#!/bin/sh\n[ "$1" = -Tpdf ] && /bin/cp "$2" "$4"\n', encoding="utf-8")
    dot.chmod(0o755)
    monkeypatch.setenv("PATH", str(here))
    assert main(["r.urdf", "-out"]) == 0
    assert capsys.readouterr().out == "Created file -out.gv\nCreated file -out.pdf\n"
    assert (here / "-out.pdf").read_bytes() == (here / "-out.gv").read_bytes()
    dot.write_text("#!/bin/sh\nexit 3\n", encoding="utf-8")
    assert main(["r.urdf", "out"]) == 0
    shown = capsys.readouterr()
    assert shown.out == "Created file out.gv\n"
    assert "'out.pdf' was not made: dot ended with exit code 3" in shown.err


def test_the_real_dot_makes_a_pdf(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/usr/bin:/usr/local/bin:/opt/homebrew/bin")
    if shutil.which("dot") is None:
        pytest.skip("Graphviz is not installed (apt-get install graphviz)")
    assert main(["r.urdf", "out"]) == 0
    assert (here / "out.pdf").read_bytes().startswith(b"%PDF-")


def test_a_refused_file_makes_no_drawing(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "bad.urdf").write_text('<robot name="r"/>', encoding="utf-8")
    assert main(["bad.urdf", "out"]) == 255
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "Error:   No link elements found in urdf file\n" in shown.err
    assert "ERROR: Model Parsing the xml failed\n" in shown.err
    assert "[urdf.no-links]" in shown.err
    assert not list(here.glob("*.gv"))


def test_a_robots_name_cannot_leave_the_folder(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "r.urdf").write_text(_TWO.format("../r"), encoding="utf-8")
    assert main(["r.urdf"]) == 255
    assert "the robot's name '../r' is no file name; give OUTPUT" in capsys.readouterr().err
    assert not (here.parent / "r.gv").exists()
    assert main(["r.urdf", "nowhere/out"]) == 255
    assert "cannot write 'nowhere/out.gv': No such file" in capsys.readouterr().err


@pytest.mark.parametrize("words", [[], ["a", "b", "c"], ["--help"]])
def test_wrong_words_show_the_usage(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 255
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.startswith(_USAGE)


def test_the_old_name_says_so_and_does_the_same(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert urdf_to_graphiz.main(["r.urdf"]) == 0
    shown = capsys.readouterr()
    assert shown.err.startswith(_OLD_NAME)
    assert _DEPRECATED in shown.err
    assert (here / "r.gv").is_file()
    assert urdf_to_graphiz.main([]) == 255
    assert capsys.readouterr().err.startswith(_OLD_NAME)
