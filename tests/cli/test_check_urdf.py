"""``check_urdf`` as a command: the real one's output and codes, our findings behind them."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from gazelle.cli.check_urdf import main

_ROBOT = """<robot name="r">
  <link name="a"><inertial><mass value="-1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
</robot>
"""
_TREE = """robot name is: r
---------- Successfully Parsed XML ---------------
root Link: a has 0 child(ren)
"""
_FAILED = "ERROR: Model Parsing the xml failed"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to work in."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_recorded_files_have_the_recorded_output(
    oracles_dir: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for path in sorted((oracles_dir / "urdf").glob("*.urdf")):
        answer = (oracles_dir / "check_urdf" / f"{path.stem}.txt").read_text(encoding="utf-8")
        code = main([str(path)])
        shown = capsys.readouterr()
        real_out, _, real_err = answer.partition("[stdout]\n")[2].partition("[stderr]\n")
        assert f"[exit {code}]" in answer, path.name
        assert shown.out == real_out, path.name
        assert shown.err.startswith(real_err.strip("\n")), path.name


def test_what_urdfdom_passes_is_said_behind_its_tree(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "r.urdf").write_text(_ROBOT, encoding="utf-8")
    assert main(["r.urdf"]) == 0
    shown = capsys.readouterr()
    assert shown.out == _TREE
    assert "r.urdf:2:18: error: link 'a' has the mass -1 kg [urdf.negative-mass]" in shown.err


def test_without_a_file_it_says_what_it_expects(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 255
    assert capsys.readouterr() == ("", "Expect URDF xml file to parse\n")
    assert main(["--help"]) == 255
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "usage: check_urdf FILE [name:=value ...]" in shown.err


def test_a_missing_file_is_an_empty_document(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for word, reason in (("no.urdf", "does not exist"), (str(here), "is a folder")):
        assert main([word]) == 255
        shown = capsys.readouterr()
        assert shown.out == ""
        assert shown.err.startswith("Error:   Error document empty.\n")
        assert _FAILED in shown.err
        assert f"'{word}' {reason} [load.not-found]" in shown.err


def test_a_package_address_is_found_and_said(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = here / "src" / "bot"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(
        "<package format='2'><name>bot</name><version>1.0.0</version></package>", encoding="utf-8"
    )
    (package / "r.urdf").write_text(_ROBOT, encoding="utf-8")
    assert main(["package://bot/r.urdf"]) == 0
    shown = capsys.readouterr()
    assert shown.out == _TREE
    assert "gazelle: 'package://bot/r.urdf' is '" in shown.err
    assert main(["package://bott/r.urdf"]) == 255
    assert "did you mean" in capsys.readouterr().err


def test_xacro_is_expanded_first(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "r.urdf.xacro").write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        '  <xacro:arg name="first" default="b"/>\n'
        '  <link name="$(arg first)"/>\n</robot>\n',
        encoding="utf-8",
    )
    assert main(["r.urdf.xacro", "first:=a"]) == 0
    shown = capsys.readouterr()
    assert shown.out == _TREE
    assert "'r.urdf.xacro' is a xacro file; it was expanded first" in shown.err
    assert "r.urdf.xacro:3:3: warning" in shown.err


def test_a_xacro_mistake_is_refused_at_its_place(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "r.xacro").write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        '  <link name="${nothing}"/>\n</robot>\n',
        encoding="utf-8",
    )
    assert main(["r.xacro"]) == 255
    shown = capsys.readouterr()
    assert shown.out == ""
    assert _FAILED in shown.err
    assert "r.xacro:2:15: error" in shown.err


def test_a_loop_below_the_root_is_refused(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    joint = '<joint name="{}" type="fixed"><parent link="{}"/><child link="{}"/></joint>'
    joints = "".join(joint.format(*ends) for ends in ("iab", "jbc", "kcb"))
    text = f'<robot name="r"><link name="a"/><link name="b"/><link name="c"/>{joints}</robot>'
    (here / "r.urdf").write_text(text, encoding="utf-8")
    assert main(["r.urdf"]) == 255
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "form a loop; the one of ROS would crash here" in shown.err
    assert "[urdf.two-parents]" in shown.err


_MUCH = {
    "nested": "<a>" * 10**6 + "</a>" * 10**6 + "</robot>",
    "never-closed": "<a>" * 10**6,
    "side-by-side": "<a/>" * 10**6 + "</robot>",
}


@pytest.mark.parametrize("rest", _MUCH.values(), ids=_MUCH)
def test_a_million_elements_are_one_error_and_soon_refused(
    here: Path, capsys: pytest.CaptureFixture[str], rest: str
) -> None:
    (here / "r.urdf").write_text(f'<robot name="r"><link name="a"/>{rest}', encoding="utf-8")
    start = time.thread_time()
    assert main(["r.urdf"]) == 255
    assert time.thread_time() - start < 10.0
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.splitlines() == [
        _FAILED,
        "r.urdf: error: the document has "
        f"{10**6 + 2} elements, the limit is 500000 [limits.elements]",
        "  fix: if the file means it, set the environment variable GAZELLE_LIMITS=10 for ten times",
    ]


def test_a_million_attributes_are_one_error_and_soon_refused(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = " ".join(f'a{number}="1"' for number in range(10**6))
    (here / "r.urdf").write_text(f'<robot name="r"><link {words}/></robot>', encoding="utf-8")
    start = time.thread_time()
    assert main(["r.urdf"]) == 255
    assert time.thread_time() - start < 30.0
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.startswith(f"{_FAILED}\nr.urdf:1:17: error: <link> has 1000000 attributes")
    assert len(shown.err) < 2000


def test_a_text_of_fifty_megabytes_is_soon_read(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = _ROBOT.replace("</robot>", "x" * 50_000_000 + "</robot>")
    (here / "r.urdf").write_text(text, encoding="utf-8")
    start = time.thread_time()
    assert main(["r.urdf"]) == 0
    assert time.thread_time() - start < 10.0
    shown = capsys.readouterr()
    assert shown.out == _TREE
    assert len(shown.err) < 2000


def test_a_chain_of_twenty_thousand_links_is_not_printed(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The real program prints 800 MB of blanks for it."""
    joint = '<joint name="{1}" type="fixed"><parent link="{0}"/><child link="{1}"/></joint>'
    links = "".join(f'<link name="{number}"/>' for number in range(20_001))
    joints = "".join(joint.format(number, number + 1) for number in range(20_000))
    (here / "r.urdf").write_text(f'<robot name="r">{links}{joints}</robot>', encoding="utf-8")
    start = time.thread_time()
    assert main(["r.urdf"]) == 255
    assert time.thread_time() - start < 20.0
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err.startswith(
        "check_urdf: the tree is too deep, or its links have too many parents; "
        "the one of ROS would print gigabytes, or crash\n"
    )
