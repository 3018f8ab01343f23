"""``gazelle doctor`` as a person and as a program see it."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest

from gazelle.cli.doctor import Tables, main, print_report, verdict
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
    assert "launch pain_03_uris world.launch: nothing to complain about in " in out
    assert "nodes of world.launch" in out
    assert max(map(len, out.splitlines())) <= 80


def test_warnings_end_with_1_and_show_the_source_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(BROKEN)
    assert main(["pain_03_uris", "robot.launch", "-q"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "── pain_03_uris/urdf/robot.urdf"
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


def _printed(report: Report, tables: Tables = Tables.FITTING) -> list[str]:
    out = io.StringIO()
    print_report(report, tables=tables, stream=out)
    return out.getvalue().splitlines()


def test_notices_of_all_files_are_grouped_in_a_line_each_before_the_mistakes() -> None:
    notice = [
        Diagnostic("sdf.not-simulated", Severity.INFO, f"<{tag}> is idle", SourceSpan(tag, 3), fix)
        for tag, fix in (("a", "nothing to do"), ("b", "nothing to do"), ("c", "nothing to do"))
    ]
    mend = Diagnostic("urdf.no-links", Severity.ERROR, "no <link>", SourceSpan("r.urdf", 1), "add")
    inertia = Diagnostic("inertia.box", Severity.INFO, "too large", None, "paste\n<inertial/>")
    lines = _printed(Report("bot", "package", (mend, *notice, inertia)))
    assert lines[:7] == [
        "── notices",
        "too large [inertia.box]",
        "  fix: paste …",
        "a:3: <a> is idle",
        "  the same 2 more times: <b> (b:3), <c> (c:3) [sdf.not-simulated]",
        "",
        "── r.urdf",
    ]


def test_package_has_its_own_tables_and_a_launch_has_its_own() -> None:
    sections = tuple(
        Section(name, f"table of {name}", ("column",), (("cell",),), subject)
        for name, subject in (("generations", ""), ("nodes", "a.launch"), ("tags", "a.launch"))
    )

    def titles(kind: str, tables: Tables = Tables.FITTING) -> list[str]:
        lines = _printed(Report("bot", kind, (), sections), tables)
        return [line.split()[2] for line in lines if line.startswith("table of ")]

    assert titles("package") == ["generations"]
    assert "tables of nodes, frames and plug-ins: examine one file, or add --tables" in _printed(
        Report("bot", "package", (), sections)
    )
    assert titles("launch") == ["generations", "nodes"]
    assert titles("package", Tables.ALL) == ["generations", "nodes", "tags"]
    assert titles("launch", Tables.NONE) == []
