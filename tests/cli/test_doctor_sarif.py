"""``gazelle doctor --sarif``: what code scanning and editors take."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlparse

import pytest

from gazelle.cli.doctor import main
from gazelle.cli.doctor.sarif import sarif_text
from gazelle.diagnostics import Diagnostic, Severity, SourceSpan
from gazelle.diagnostics.catalogue import all_entries, entry_for
from gazelle.diagnostics.documentation import anchor
from gazelle.doctor import Report

BROKEN = Path(__file__).parents[1] / "doctor" / "fixtures" / "pain_03_uris" / "broken"
LEVELS = {"none", "note", "warning", "error"}


@pytest.fixture(autouse=True)
def _home(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """No ROS and no Gazebo of this machine is in sight."""
    monkeypatch.setenv("HOME", str(tmp_path))
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "ROS_DISTRO"):
        monkeypatch.delenv(name, raising=False)


def check_message(value: Any) -> None:
    assert isinstance(value["text"], str) and value["text"]


def check_location(value: Any, bases: Any) -> None:
    place = value["physicalLocation"]
    artifact = place["artifactLocation"]
    uri = urlparse(artifact["uri"])
    assert " " not in artifact["uri"]
    assert artifact["uriBaseId"] in bases if not uri.scheme else uri.scheme == "file"
    region = place.get("region", {"startLine": 1})
    assert region["startLine"] >= 1
    assert region.get("startColumn", 1) >= 1
    assert region.get("endColumn", 10**6) > region.get("startColumn", 1)


def check_sarif(log: Any) -> None:
    """Check what SARIF 2.1.0 requires, and what readers rely on."""
    assert log["version"] == "2.1.0"
    assert log["$schema"].endswith("sarif-2.1.0.json")
    for run in log["runs"]:
        driver = run["tool"]["driver"]
        assert driver["name"]
        rules = driver["rules"]
        assert len({rule["id"] for rule in rules}) == len(rules)
        for rule in rules:
            check_message(rule["shortDescription"])
            check_message(rule["help"])
            assert rule["defaultConfiguration"]["level"] in LEVELS
        for base in run["originalUriBaseIds"].values():
            assert base["uri"].startswith("file:///") and base["uri"].endswith("/")
        for result in run["results"]:
            check_message(result["message"])
            assert result["level"] in LEVELS
            assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
            assert len(result["locations"]) == 1
            for place in result["locations"]:
                check_location(place, run["originalUriBaseIds"])
            for place in result.get("relatedLocations", ()):
                check_message(place["message"])
                check_location(place, run["originalUriBaseIds"])


def sarif(*findings: Diagnostic, **words: Any) -> Any:
    log = json.loads(sarif_text(Report("bot", "package", findings, **words)))
    check_sarif(log)
    return log["runs"][0]


def test_sarif_is_all_there_is_on_standard_output(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(BROKEN)
    assert main(["pain_03_uris", "robot.launch", "--sarif"]) == 1
    output = capsys.readouterr()
    log = json.loads(output.out)
    check_sarif(log)
    (run,) = log["runs"]
    assert output.err == ""
    assert run["invocations"] == [{"executionSuccessful": True, "exitCode": 1}]
    mesh = next(item for item in run["results"] if item["level"] == "warning")
    place = mesh["locations"][0]["physicalLocation"]
    assert mesh["ruleId"] == "urdf.mesh-missing"
    assert place["artifactLocation"] == {
        "uri": "pain_03_uris/urdf/robot.urdf",
        "uriBaseId": "SRCROOT",
    }
    assert (place["region"]["startLine"], place["region"]["startColumn"]) == (106, 17)


def test_a_result_has_the_remedy_the_way_there_and_the_words_of_ros(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    via = (SourceSpan("/opt/other/arm.xacro", 4, 1), SourceSpan(f"{tmp_path}/a b.xacro", 9))
    span = SourceSpan(f"{tmp_path}/x/r.urdf", 3, 2, 5, via)
    item = Diagnostic("urdf.no-links", Severity.WARNING, "no <link>", span, "add one", "empty tree")
    run = sarif(item)
    assert run["originalUriBaseIds"]["SRCROOT"]["uri"] == f"{tmp_path.as_uri()}/"
    (result,) = run["results"]
    assert result["message"]["text"] == "no <link>\nfix: add one"
    assert result["level"] == "warning"
    assert result["properties"] == {"phrase": "empty tree"}
    assert result["locations"][0]["physicalLocation"] == {
        "artifactLocation": {"uri": "x/r.urdf", "uriBaseId": "SRCROOT"},
        "region": {"startLine": 3, "startColumn": 2, "endColumn": 7},
    }
    inner, outer = (one["physicalLocation"] for one in result["relatedLocations"])
    assert inner["artifactLocation"] == {"uri": "file:///opt/other/arm.xacro"}
    assert unquote(outer["artifactLocation"]["uri"]) == "a b.xacro"
    assert outer["region"] == {"startLine": 9}


def test_what_has_no_file_stands_at_the_folder() -> None:
    somewhere = Diagnostic(
        "urdf.no-links", Severity.INFO, "m", SourceSpan("<robot_description>", 3)
    )
    run = sarif(Diagnostic("urdf.no-links", Severity.INFO, "m"), somewhere)
    nowhere, named = (result["locations"][0] for result in run["results"])
    assert nowhere == {
        "physicalLocation": {"artifactLocation": {"uri": ".", "uriBaseId": "SRCROOT"}}
    }
    assert named["logicalLocations"] == [{"fullyQualifiedName": "<robot_description>"}]


def test_what_follows_from_others_is_no_result() -> None:
    late = Diagnostic("doctor.spawn-fails", Severity.ERROR, "late")
    run = sarif(Diagnostic("xml.malformed", Severity.ERROR, "broken"), consequences=(late,))
    assert [result["ruleId"] for result in run["results"]] == ["xml.malformed"]


def test_findings_below_the_severity_asked_for_are_left_out() -> None:
    report = Report("bot", "file", (Diagnostic("urdf.no-links", Severity.INFO, "m"),))
    run = json.loads(sarif_text(report, Severity.WARNING))["runs"][0]
    assert run["results"] == run["tool"]["driver"]["rules"] == []


def test_rules_are_entries_of_the_catalogue() -> None:
    entry = entry_for("package.script-not-executable")
    (rule,) = sarif(Diagnostic(entry.code, Severity.ERROR, "m"))["tool"]["driver"]["rules"]
    assert rule["shortDescription"] == {"text": f"{entry.title}."}
    assert rule["fullDescription"] == {"text": entry.why}
    assert f"Fix: {entry.fix}." in rule["help"]["markdown"]
    assert rule["defaultConfiguration"] == {"level": entry.severity}


def test_rules_point_at_the_published_page_where_there_is_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("gazelle.cli.doctor.sarif.pages_address", lambda: "https://docs.invalid")
    driver = sarif(Diagnostic("urdf.no-links", Severity.ERROR, "m"))["tool"]["driver"]
    assert driver["informationUri"] == "https://docs.invalid/howto/doctor/"
    assert driver["rules"][0]["helpUri"] == ("https://docs.invalid/diagnostics/#urdfno-links-error")


def test_every_entry_of_the_page_has_an_anchor_of_its_own() -> None:
    entries = all_entries().values()
    assert len({anchor(entry) for entry in entries}) == len(entries)


def test_json_and_sarif_are_not_printed_together(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["--json", "--sarif"])
    assert caught.value.code == 2
    assert "not allowed with argument" in capsys.readouterr().err
