"""launch of ROS 2, run by its own tests: frontends, actions, event handlers (Humble)."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from stage import Finished, Stage

PYTEST = "shell python3 -m pytest -q -p no:cacheprovider"
BEHAVIOUR = """<launch>
  <arg name="my_arg" default="asd"><choice value="asd"/><choice value="bsd"/></arg>
  <let name="yes" value="true"/><let name="no" value="false"/>
  <log level="INFO" message="$(not $(var no)) $(and $(var yes) $(var no))"/>
  <log level="INFO" message="$(or $(var yes) $(var no))"/>
  <timer period="0.5"><log level="INFO" message="after the timer"/></timer>
  <set_env name="PIPED" value="first"/>
  <append_env name="PIPED" value="second" separator="|"/>
  <log level="INFO" message="piped $(env PIPED)"/>
  <let name="bar" value="BAR"/>
  <group scoped="true" forwarding="false">
    <keep name="bar" value="$(var bar)"/><keep name="baz" value="BAZ"/>
    <log level="INFO" message="kept $(var bar) $(var baz)"/>
  </group>
</launch>"""
FORGETS = """<launch><let name="foo" value="FOO"/>
  <group scoped="true" forwarding="false"><log level="INFO" message="$(var foo)"/></group>
</launch>"""


def passed(ran: Finished) -> int:
    """How many tests of a run passed, when none failed."""
    assert ran.code == 0, ran.output
    return int(re.findall(r"(\d+) passed", ran.stdout)[-1])


def test_the_frontends_pass_their_25_tests(stage: Stage) -> None:
    xml = stage.run(f"{PYTEST} launch/launch_xml/test/launch_xml")
    yaml = stage.run(f"{PYTEST} launch/launch_yaml/test/launch_yaml")
    assert passed(xml) + passed(yaml) == 25


def test_event_handlers_conditions_and_timers_pass_their_tests(stage: Stage) -> None:
    own = " ".join(
        f"launch/launch/test/launch/{name}"
        for name in (
            "event_handlers", "conditions", "test_condition.py", "test_event.py",
            "test_event_handler.py", "test_on_process_exit.py", "test_on_process_io.py",
            "test_on_process_start.py", "test_on_shutdown.py", "test_timer_action.py",
            "test_on_include_launch_description.py",
        )
    )  # fmt: skip
    assert passed(stage.run(f"{PYTEST} {own}")) > 0


def test_an_executable_runs_and_ends(stage: Stage) -> None:
    ran = stage.run("ros2 launch launch/launch_xml/test/launch_xml/executable.xml")
    assert ran.code == 0, ran.output
    assert "[my_ls-1]: process has finished cleanly" in ran.output
    # Its output goes to the log: a list of the folder "/".
    log = next(Path(stage.environment["ROS_HOME"]).rglob("launch.log")).read_text()
    assert re.search(r"\d root .* usr$", log, re.M), log


def test_show_args_lists_arguments(stage: Stage) -> None:
    file = "launch/launch/test/launch/launch_file_with_argument.launch.py"
    shown = stage.run(f"ros2 launch {file} --show-args")
    assert shown.code == 0
    assert "    'example':\n        example argument\n        (default: 'example')" in shown.stdout


@pytest.fixture
def write(tmp_path: Path) -> Path:
    """A launch file's path."""
    return tmp_path / "own.launch.xml"


def test_an_unknown_child_is_told_with_its_parent(stage: Stage, write: Path) -> None:
    write.write_text('<launch><executable cmd="ls"><whats_this/></executable></launch>')
    ran = stage.run(f"ros2 launch {write}")
    assert ran.code == 1
    assert "Unexpected nested tag(s) found in `executable`: {'whats_this'}" in ran.output


def test_substitutions_timers_environment_and_scopes_work_in_xml(stage: Stage, write: Path) -> None:
    write.write_text(BEHAVIOUR)
    ran = stage.run(f"ros2 launch {write}", env={"ROS_HOME": str(write.parent)})
    assert ran.code == 0, ran.output
    said = re.findall(r"\[launch.user\]: (.*)", ran.output)
    assert said == [
        "true false", "true", "piped first|second", "kept BAR BAZ", "after the timer",
    ]  # fmt: skip
    wrong = stage.run(f"ros2 launch {write} my_arg:=x")
    assert wrong.code == 1
    assert "Valid options are: ['asd', 'bsd']" in wrong.output


def test_a_scope_without_forwarding_forgets_the_rest(stage: Stage, write: Path) -> None:
    write.write_text(FORGETS)
    ran = stage.run(f"ros2 launch {write}")
    assert ran.code == 1
    assert "launch configuration 'foo' does not exist" in ran.output
