"""The fixtures as users' tests meet them: what they give, and what they say when a test fails."""

from __future__ import annotations

import signal
import subprocess
import sys
import tomllib
from pathlib import Path

import psutil
import pytest
from tests.patience import stretched
from tests.testing.conftest import Pytest, run_pytest

ROOT = Path(__file__).parents[2]
_START = """
def start(gazelle_launch, **more):
    launch = gazelle_launch("speech", "speech.launch", **more)
    launch.wait_for_line("speaker is ready")
    return launch
"""


def test_the_module_that_pytest_loads_imports_nothing_heavy() -> None:
    code = (
        "import sys, gazelle.testing.plugin; "
        "print({'numpy', 'zenoh', 'mujoco', 'yaml', 'gazelle.graph'} & set(sys.modules))"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "set()"


def test_the_entry_point_names_the_module() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["entry-points"]["pytest11"] == {"gazelle": "gazelle.testing.plugin"}


def test_a_launch_is_talked_to_and_ends_with_the_test(speech_tests: Pytest) -> None:
    ran = speech_tests(
        _START
        + """
import os
def test_it(gazelle_launch, gazelle_graph, tmp_path):
    launch = start(gazelle_launch, args={"end": "?"})
    assert launch.exit_code is None
    assert launch.graph is gazelle_graph and gazelle_graph.is_hub
    assert launch.param("/speaker/end") == "?"
    launch.wait_for_node("speaker")
    launch.wait_for_node("/rosout")
    assert launch.nodes() == ("/rosout", "/speaker")
    words = launch.topic("/words")
    launch.publish("/echo", data="one")
    assert words.next().data == "one?"
    for text in ("two", "three", "four"):
        launch.publish("/echo", "std_msgs/String", data=text)
    assert [m.data for m in words.messages(2)] == ["two?", "three?"]
    assert words.wait_for(lambda m: m.data.startswith("f")).data == "four?"
    answer = launch.call("/answer", data=True)
    assert (answer.success, answer.message) == (True, "heard")
    print("port", launch.graph.port)
    assert launch.stop() == 0
    assert launch.exit_code == 0
    assert launch.param("/speaker/end") == "?"
""",
        "-s",
    )
    assert "1 passed" in ran.stdout, ran.stdout


def test_a_failing_test_shows_the_output_and_what_is_there_instead(speech_tests: Pytest) -> None:
    ran = speech_tests(
        _START
        + """
def test_topic(gazelle_launch):
    start(gazelle_launch).topic("/wordz", timeout_s=0.5)

def test_listener(gazelle_launch):
    launch = start(gazelle_launch)
    with pytest.raises(AssertionError, match="on '/words' within 0.2 s; published by /speaker, "
                       "with nothing sent"):
        launch.topic("/words").next(timeout_s=0.2)
    with pytest.raises(AssertionError, match="no parameter '/speaker/ent' within 0.1 s; did you"):
        launch.param("/speaker/ent", timeout_s=0.1)
    with pytest.raises(AssertionError, match="no node '/speker' within 0.1 s; did you mean '/sp"):
        launch.wait_for_node("speker", timeout_s=0.1)
    with pytest.raises(AssertionError, match="time of 1 s within 0.1 s; nobody publishes /clock"):
        launch.wait_until(1.0, timeout_s=0.1)
    with pytest.raises(AssertionError, match=r"has not ended within 0.1 s; .*: /rosout, /speaker"):
        launch.wait(timeout_s=0.1)
    launch._waiting.timeout_s = 0.5
    with pytest.raises(AssertionError, match="'/echo' .*Int32. within 0.5 s; /speaker takes std_m"):
        launch.publish("/echo", "std_msgs/msg/Int32", data=1)
    with pytest.raises(AssertionError, match="no service '/anwser' within 0.5 s; did you mean"):
        launch.call("/anwser", data=True)
    launch.wait_for_line("never written")
"""
    )
    text = ran.stdout
    assert "2 failed" in text, text
    assert "no topic '/wordz' within 0.5 s; did you mean '/words'?" in text, text
    assert "no line matches 'never written' within 0.5 s" in text, text
    assert text.count("-- roslaunch speech speech.launch --") == 2
    assert text.count("the speaker is ready") == 2


def test_a_launch_that_fails_is_not_waited_for(speech_tests: Pytest) -> None:
    ran = speech_tests(
        """
def test_it(gazelle_launch):
    launch = gazelle_launch("speech", "spech.launch")
    with pytest.raises(AssertionError, match="no topic '/words': the launch has ended with exit c"):
        launch.topic("/words")
    assert launch.wait() == 1
    launch.wait_for_line("launch files there: speech.launch")
"""
    )
    assert "1 passed" in ran.stdout, ran.stdout


def test_nothing_is_left_when_pytest_itself_is_killed(speech_tests: Pytest, tmp_path: Path) -> None:
    ran = speech_tests(
        _START
        + """
import os, signal
def test_it(gazelle_launch):
    start(gazelle_launch)
    os.kill(os.getpid(), signal.SIGKILL)
""",
        MY_MARK=str(tmp_path),
    )
    assert ran.returncode == -signal.SIGKILL, ran.stdout
    left = [one for one in psutil.process_iter() if _environment(one).get("MY_MARK")]
    _gone, alive = psutil.wait_procs(
        [one for one in left if _environment(one).get("MY_MARK") == str(tmp_path)],
        timeout=stretched(30),
    )
    assert alive == []


def _environment(process: psutil.Process) -> dict[str, str]:
    try:
        return dict(process.environ())
    except psutil.Error:
        return {}


def test_workers_of_xdist_get_graphs_of_their_own(speech_tests: Pytest) -> None:
    ran = speech_tests(
        """
@pytest.mark.parametrize("number", range(6))
def test_alone(gazelle_graph, number):
    assert gazelle_graph.is_hub
    gazelle_graph.create_node("only_one")
    assert gazelle_graph.node_names() == ("/only_one",)
""",
        "-n",
        "2",
    )
    assert "6 passed" in ran.stdout, ran.stdout


def test_the_marker_sets_seed_and_port_and_refuses_what_it_does_not_know(
    speech_tests: Pytest, free_port: int
) -> None:
    ran = speech_tests(
        f"""
@pytest.mark.gazelle(port={free_port})
def test_port(gazelle_graph):
    assert gazelle_graph.port == {free_port}

@pytest.mark.gazelle(seed=3)
def test_seed(gazelle_launch, gazelle_simulation):
    assert gazelle_simulation().time_s == 0.0
    launch = gazelle_launch("gazebo_ros", "empty_world.launch", args={{"gui": False}})
    launch.wait_until(0.01)
    assert launch.title == "roslaunch --seed 3 gazebo_ros empty_world.launch gui:=false"

@pytest.mark.gazelle(sead=3)
def test_unknown(gazelle_graph):
    pass
""",
        "--strict-markers",
    )
    assert "2 passed, 1 error" in ran.stdout, ran.stdout
    assert "@pytest.mark.gazelle has no option sead; it takes seed=…, port=…" in ran.stdout


@pytest.mark.tutorial
def test_the_scouts_own_tests_pass() -> None:
    ran = run_pytest(ROOT / "examples" / "scout_ws")
    assert "3 passed" in ran.stdout, ran.stdout
