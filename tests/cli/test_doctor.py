"""``gazelle doctor`` as a person and as a program see it."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from gazelle.cli.doctor import main
from gazelle.cli.doctor.report_text import Level, print_report, verdict
from gazelle.cli.main import main as gazelle
from gazelle.diagnostics import Diagnostic, Severity, SourceSpan
from gazelle.doctor import Report, Section

FIXTURES = Path(__file__).parents[1] / "doctor" / "fixtures"
CLEAN = FIXTURES / "pain_03_uris" / "clean"
BROKEN = FIXTURES / "pain_03_uris" / "broken"
FINDING_KEYS = {
    "code",
    "severity",
    "message",
    "file",
    "line",
    "column",
    "via",
    "fix",
    "phrase",
}


@pytest.fixture(autouse=True)
def _home(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """No ROS and no Gazebo of this machine is in sight."""
    monkeypatch.setenv("HOME", str(tmp_path))
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "ROS_DISTRO"):
        monkeypatch.delenv(name, raising=False)


def test_clean_launch_ends_with_0_and_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(CLEAN)
    assert gazelle(["doctor", "pain_03_uris", "world.launch"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("launch pain_03_uris world.launch: nothing to complain about in ")
    assert out.count("\n") == 1
    assert gazelle(["doctor", "pain_03_uris", "world.launch", "-v"]) == 0
    assert "nodes of world.launch" in capsys.readouterr().out


def test_warnings_end_with_1_and_show_the_source_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(BROKEN)
    assert main(["pain_03_uris", "robot.launch"]) == 1
    lines = capsys.readouterr().out.splitlines()
    source = next(line for line in lines if line.startswith("    106 |"))
    caret = lines[lines.index(source) + 1]
    assert source[caret.index("^") :].startswith("<mesh ")
    assert lines[-1].startswith("launch pain_03_uris robot.launch: 1 warning, 2 notices in ")
    assert "nodes of robot.launch" not in "\n".join(lines)


def test_errors_end_with_2(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(BROKEN)
    assert main(["pain_03_uris", "world.launch", "--least", "error"]) == 2


def test_json_is_all_there_is_on_standard_output(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(BROKEN)
    assert main(["pain_03_uris", "robot.launch", "--json"]) == 1
    output = capsys.readouterr()
    report = json.loads(output.out)
    assert output.err == ""
    assert set(report) == {
        "schema", "target", "kind", "exit_code", "counts", "findings", "consequences", "sections",
    }  # fmt: skip
    assert (report["schema"], report["kind"], report["exit_code"]) == (1, "launch", 1)
    assert report["counts"] == {"info": 2, "warning": 1, "error": 0}
    assert all(set(item) == FINDING_KEYS for item in report["findings"])
    mesh = next(item for item in report["findings"] if item["severity"] == "warning")
    assert (mesh["code"], mesh["line"], mesh["column"]) == ("urdf.mesh-missing", 106, 17)
    assert [section["name"] for section in report["sections"]] == ["plugins", "nodes", "frames"]
    assert all(
        len(row) == len(section["columns"])
        for section in report["sections"]
        for row in section["rows"]
    )


def test_json_leaves_out_what_is_below_the_severity_asked_for(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(BROKEN)
    main(["pain_03_uris", "robot.launch", "--json", "--least", "warning"])
    report = json.loads(capsys.readouterr().out)
    assert [item["severity"] for item in report["findings"]] == ["warning"]
    assert report["counts"]["info"] == 2


def test_arguments_of_a_launch_are_given_as_for_roslaunch(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "one.launch"
    file.write_text('<launch><arg name="rate"/><param name="a" value="$(arg rate)"/></launch>')
    monkeypatch.chdir(tmp_path)
    assert main(["one.launch", "rate:=5"]) == 0
    assert main(["one.launch"]) == 2
    assert f"RLException: [{file}] requires the 'rate' arg to be set" in capsys.readouterr().out


def test_unknown_target_ends_with_2_and_names_the_nearest(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(CLEAN)
    assert main(["pain_03_uri"]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert "gazelle doctor: package, file, model or world 'pain_03_uri' not found" in output.err
    assert "did you mean 'pain_03_uris'?" in output.err


def test_wrong_option_ends_with_2(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["--jsn"])
    assert caught.value.code == 2
    assert "unrecognized arguments: --jsn" in capsys.readouterr().err


def test_verdict_counts_one_and_many() -> None:
    def finding(severity: Severity, line: int) -> Diagnostic:
        return Diagnostic("doctor.nothing", severity, "m", SourceSpan("f", line))

    error, warning, info = Severity.ERROR, Severity.WARNING, Severity.INFO
    rows = (error, error, warning, *([info] * 5))
    report = Report("bot", "package", tuple(finding(row, n) for n, row in enumerate(rows)))
    assert verdict(report, 0.84) == "package bot: 2 errors, 1 warning, 5 notices in 0.8 s"


def _printed(report: Report, level: Level = Level.NORMAL, **options: bool) -> list[str]:
    out = io.StringIO()
    print_report(report, level=level, stream=out, **options)
    return out.getvalue().splitlines()


def _finding(
    severity: Severity, line: int, message: str = "m", file: str = "f", **words: str
) -> Diagnostic:
    code = words.pop("code", "urdf.no-links")
    return Diagnostic(code, severity, message, SourceSpan(file, line), **words)


def _titles(report: Report, level: Level = Level.NORMAL, **options: bool) -> list[str]:
    lines = _printed(report, level, **options)
    return [line.split()[2] for line in lines if line.startswith("table of ")]


def test_the_worst_stands_last_next_to_the_verdict_and_files_from_top_to_bottom() -> None:
    error, warning, info = Severity.ERROR, Severity.WARNING, Severity.INFO
    found = (
        _finding(error, 5, file="b"),
        _finding(warning, 9),
        _finding(info, 1),
        _finding(error, 7, "other", file="a"),
        _finding(warning, 2, "other"),
        _finding(error, 3, "third", file="b"),
    )
    late = (_finding(error, 1, "late"),)
    lines = _printed(Report("bot", "package", found, consequences=late), Level.FULL)
    assert [line for line in lines if line] == [
        "notices:",
        "  f:1: m [urdf.no-links]",
        "follows from what stands below, and goes with it:",
        "  f:1: error: late [urdf.no-links]",
        "f:2: warning: other [urdf.no-links]",
        "f:9: warning: m [urdf.no-links]",
        "b:3: error: third [urdf.no-links]",
        "b:5: error: m [urdf.no-links]",
        "a:7: error: other [urdf.no-links]",
        "package bot: 3 errors, 2 warnings, 1 notice in 0.0 s",
    ]


def test_of_notices_the_first_of_each_kind_is_a_line_and_all_are_whole_with_v() -> None:
    idle = [
        _finding(Severity.INFO, 3, f"<{tag}> is idle\nmore", tag, fix="nothing to do",
                 code="sdf.not-simulated")
        for tag in "abc"
    ]  # fmt: skip
    inertia = Diagnostic("inertia.box", Severity.INFO, "too large", None, "paste\n<inertial/>")
    report = Report("bot", "package", (*idle, inertia))
    assert _printed(report) == [
        "notices, the first of each kind (-v: all, and what to do):",
        "  too large [inertia.box]",
        "  a:3: <a> is idle [sdf.not-simulated] and 2 more",
        "",
        "package bot: 4 notices in 0.0 s",
    ]
    assert _printed(report, Level.FULL)[:-2] == [
        "notices:",
        "  too large [inertia.box]",
        "    fix: paste",
        "    <inertial/>",
        "  a:3: <a> is idle",
        "    more",
        "      the same 2 more times: <b> (b:3), <c> (c:3) [sdf.not-simulated]",
    ]


def test_notices_of_one_each_do_not_speak_of_a_first_one() -> None:
    report = Report("bot", "package", (_finding(Severity.INFO, 1),))
    assert _printed(report)[0] == "notices (-v: what to do):"


def test_long_notices_end_at_a_word() -> None:
    report = Report("bot", "package", (_finding(Severity.INFO, 1, "word " * 100),))
    line = _printed(report)[1]
    assert line.endswith("word … [urdf.no-links]")
    assert len(line) < 200


def test_q_prints_warnings_and_errors_in_a_line_each() -> None:
    warning = [_finding(Severity.WARNING, line, f"'{line}' is bare", fix="f") for line in (1, 2, 3)]
    error = _finding(Severity.ERROR, 4, "broken\n  looked in: x", phrase="p")
    section = Section("nodes", "table of nodes", ("column",), (("cell",),))
    late = (_finding(Severity.ERROR, 1), _finding(Severity.ERROR, 2))
    found = (*warning, error, _finding(Severity.INFO, 5))
    report = Report("bot", "launch", found, (section,), consequences=late)
    assert _printed(report, Level.BRIEF) == [
        "f:1: warning: '1' is bare [urdf.no-links] and 2 more",
        "f:4: error: broken [urdf.no-links]",
        "2 findings more follow from these; -v shows them",
        "launch bot: 1 error, 3 warnings, 1 notice in 0.0 s",
    ]


def test_what_ros_says_to_findings_of_a_kind_is_said_once() -> None:
    found = tuple(_finding(Severity.ERROR, at, f"m{at}", phrase="no such thing") for at in (1, 2))
    lines = _printed(Report("bot", "package", found))
    assert lines == [
        "f:1: error: m1 [urdf.no-links]",
        "  ROS/Gazebo says: no such thing",
        "",
        "f:2: error: m2 [urdf.no-links]",
        "",
        "package bot: 2 errors in 0.0 s",
    ]


def test_all_places_of_merged_findings_are_named_with_v() -> None:
    found = tuple(_finding(Severity.WARNING, at, f"'l{at}' is bare") for at in range(1, 31))
    report = Report("bot", "package", found)
    assert any(line.endswith(" and 21 more [urdf.no-links]") for line in _printed(report))
    assert any("'l30' (line 30) [" in line for line in _printed(report, Level.FULL))


def test_tables_are_printed_where_asked_for() -> None:
    sections = tuple(
        Section(name, f"table of {name}", ("column",), (("cell",),), subject)
        for name, subject in (("generations", ""), ("nodes", "a.launch"), ("tags", "a.launch"))
    )
    package, launch = (Report("bot", kind, (), sections) for kind in ("package", "launch"))
    assert _titles(package) == _titles(launch) == _titles(launch, Level.BRIEF) == []
    assert _titles(package, Level.FULL) == ["generations"]
    assert _titles(launch, Level.FULL) == ["generations", "nodes"]
    assert _titles(package, tables=True) == ["generations", "nodes", "tags"]
    assert _titles(package, Level.BRIEF, tables=True) == ["generations", "nodes", "tags"]


def test_tables_of_probes_are_asked_for_by_the_probes() -> None:
    section = Section("probe_drive", "table of drive", ("column",), (("cell",),))
    for kind in ("package", "robot"):
        report = Report("bot", kind, (), (section,))
        assert _titles(report) == _titles(report, Level.FULL) == ["drive"]
        assert _titles(report, Level.BRIEF) == []


def test_names_are_shown_where_they_disagree_and_whole_with_v() -> None:
    columns = ("name", "URDF", "hardware", "controllers", "MoveIt")
    agreed = ("elbow", "revolute", "effort", "arm", "")
    unknown, idle = ("elbo", "", "", "arm", ""), ("wrist", "revolute", "", "arm", "")
    title = "arm: who names which joint"
    section = Section("names", title, columns, (agreed, unknown, idle))
    lines = _printed(Report("bot", "package", (), (section,)))
    assert lines[0] == f"{title}, 2 of 3: where they disagree"
    assert [line.split()[0] for line in lines[3:5]] == ["elbo", "wrist"]
    assert _printed(Report("bot", "package", (), (section,)), Level.FULL)[0] == title
    fine = Section("names", title, columns, (agreed,))
    assert len(_printed(Report("bot", "package", (), (fine,)))) == 1
    without_hardware = Section("names", title, columns, (idle,))
    assert len(_printed(Report("bot", "package", (), (without_hardware,)))) == 1
