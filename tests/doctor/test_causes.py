"""What follows from other findings."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from gazelle.cli.doctor import main
from gazelle.diagnostics import Diagnostic, Severity, SourceSpan
from gazelle.doctor.causes import causes_first

LAUNCH = """<launch>
  <param name="robot_description" textfile="$(dirname)/robot.urdf"/>
  <node name="state" pkg="robot_state_publisher" type="robot_state_publisher"/>
  <include file="$(find gazebo_ros)/launch/empty_world.launch"/>
  <node name="spawn" pkg="gazebo_ros" type="spawn_model"
        args="-urdf -param robot_description -model r"/>
  <node name="go" pkg="controller_manager" type="spawner" args="arm"/>
</launch>
"""


def error(code: str, message: str = "", severity: Severity = Severity.ERROR) -> Diagnostic:
    return Diagnostic(code, severity, message)


def test_consequences_go_behind_their_causes() -> None:
    broken = error("xml.malformed")
    late = [error("doctor.spawn-fails"), error("doctor.no-controller-manager")]
    other = error("workspace.bad-manifest")
    assert causes_first([*late, broken, other]) == ((broken, other), tuple(late))


def test_without_a_cause_nothing_is_a_consequence() -> None:
    alone = [error("doctor.spawn-fails"), error("doctor.joint-without-state")]
    causes, late = causes_first(alone)
    assert causes[0] == alone[0]
    assert late == (alone[1],)


def test_a_notice_is_no_cause_of_an_error() -> None:
    found = [error("xml.unknown-tag", severity=Severity.INFO), error("doctor.spawn-fails")]
    assert causes_first(found) == (tuple(found), ())


def test_findings_of_other_names_stand_for_themselves() -> None:
    hardware = error("control.hardware-joint", "transmission 't' drives joint 'elbo'")
    same = error("control.names-disagree", "'elbo' is not a joint", Severity.WARNING)
    other = error("control.names-disagree", "'wrist' is not a joint", Severity.WARNING)
    assert causes_first([same, other, hardware]) == ((other, hardware), (same,))


def test_the_worst_of_several_causes_counts() -> None:
    quiet = error("robot.mesh-unit", "'arm' is large", Severity.INFO)
    loud = error("robot.size-mismatch", "'arm' is small", Severity.WARNING)
    late = error("inertia.box", "'arm' is heavy", Severity.WARNING)
    assert causes_first([quiet, late, loud]) == ((quiet, loud), (late,))
    assert causes_first([quiet, late]) == ((quiet, late), ())


@pytest.mark.parametrize(
    ("cause", "late"),
    [
        (
            error("xml.missing-attribute", "<node> lacks 'name'"),
            error("xml.unknown-attribute", "attribute 'naem' is not known"),
        ),
        (
            Diagnostic("package.import-missing", Severity.ERROR, "no msg 'Poes'", None,
                       "did you mean 'Pose'?"),
            error("package.python-name", "name 'Pose' is not defined", Severity.WARNING),
        ),
        (
            error("package.names", "<name> of the manifest is 'bto'; that of its folder is 'bot'"),
            error("urdf.mesh-missing", "'package://bot/a.stl' not found", Severity.WARNING),
        ),
        (
            error("doctor.description-not-expanded", "'/robot_description' is '/w/r.urdf.xacro'"),
            Diagnostic("xml.bad-number", Severity.ERROR, "'${x}' is no number",
                       SourceSpan("/w/r.urdf.xacro", 3)),
        ),
    ],
    ids=["a line", "what a fix asks for", "a name", "a file"],
)  # fmt: skip
def test_findings_of_one_mistake_are_one(cause: Diagnostic, late: Diagnostic) -> None:
    place = SourceSpan("f.launch", 7)
    both = [replace(item, span=item.span or place) for item in (late, cause)]
    assert causes_first(both) == ((both[1],), (both[0],))


def test_a_cause_is_told_as_severely_as_what_follows() -> None:
    cause = Diagnostic(
        "parameter.unknown", Severity.WARNING, "no key 'jonit'", None, "did you mean 'joint'?"
    )
    late = error("doctor.controller-fails", "no 'joint' given")
    (told,), consequences = causes_first([late, cause])
    assert (told, consequences) == (replace(cause, severity=Severity.ERROR), (late,))


def test_report_says_how_many_follow(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "robot.urdf").write_text('<robot name="r"><link name="a"></robot>', "utf-8")
    (tmp_path / "go.launch").write_text(LAUNCH, "utf-8")
    monkeypatch.chdir(tmp_path)
    assert main(["go.launch", "-q"]) == 2
    short = capsys.readouterr().out
    assert "robot.urdf:1:17: error" in short
    assert "doctor.no-controller-manager" not in short
    assert "more follow from these; -v shows them" in short
    assert main(["go.launch", "-q", "-v"]) == 2
    assert "doctor.no-controller-manager" in capsys.readouterr().out
