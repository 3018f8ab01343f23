"""Launch files of a package that are started with values, or by others."""

from __future__ import annotations

from tests.doctor.conftest import Examine, Write, codes

from gazelle.doctor import Report

INNER = '<launch><arg name="ip"/><param name="ip" value="$(arg ip)"/></launch>'
OUTER = '<launch><include file="$(dirname)/inner.launch" {}/></launch>'


def told(report: Report) -> list[str]:
    """Return codes of warnings and errors that are not of the package's manifest."""
    return [code for code in codes(report) if code != "package.manifest"]


def test_argument_that_passes_through_an_include_is_asked_for(
    written: Write, examined: Examine
) -> None:
    outer = OUTER.format('pass_all_args="true"')
    folder = written(**{"launch__inner.launch": INNER, "launch__outer.launch": outer})
    report = examined(folder, "bot")
    assert told(report) == []
    (found,) = (item for item in report.findings if "pass_all_args" in item.message)
    assert found.message.startswith("'outer.launch' is not started: it takes the value of ip from")


def test_include_without_a_needed_argument_is_an_error(written: Write, examined: Examine) -> None:
    folder = written(**{"launch__inner.launch": INNER, "launch__outer.launch": OUTER.format("")})
    assert told(examined(folder, "bot")) == ["launch.arg-missing"]


def test_part_takes_the_arguments_of_the_file_around_it(written: Write, examined: Examine) -> None:
    # Which part it is, is known only when it is started.
    outer = '<launch><arg name="arm"/><arg name="part"/>'
    outer += '<include file="$(dirname)/$(arg part).launch.xml" pass_all_args="true"/></launch>'
    part = '<launch><param name="{0}" value="$(arg {0})"/></launch>'
    files = {
        "launch__outer.launch": outer,
        "launch__one.launch.xml": part.format("arm"),
        "launch__two.launch.xml": part.format("amr"),
    }
    report = examined(written(**files), "bot")
    assert told(report) == ["launch.arg-undeclared"]
    (wrong,) = (item for item in report.findings if item.code == "launch.arg-undeclared")
    assert "'amr'" in wrong.message


def test_expression_with_an_argument_without_value_is_not_told_twice(
    written: Write, examined: Examine
) -> None:
    launch = '<launch><arg name="lidar" default="$(env LIDAR_MODEL)"/>'
    launch += "<group if=\"$(eval lidar == 'one')\"/></launch>"
    folder = written(**{"launch__one.launch": launch})
    assert told(examined(folder, "bot")) == []
    assert told(examined(folder, "bot", "one.launch")) == ["launch.env-missing"]
