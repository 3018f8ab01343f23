from __future__ import annotations

import pytest

from gazelle.cli.launch_journals import journal_of, launches
from gazelle.cli.main import main
from gazelle.diagnostics.launch_journal import VARIABLE, journals, read


@pytest.fixture(autouse=True)
def own_state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.delenv(VARIABLE, raising=False)


@pytest.mark.parametrize(
    ("line", "launching"),
    [
        ("roslaunch bot bot.launch", True),
        ("roslaunch -p 7500 bot bot.launch", True),
        ("roslaunch --nodes bot bot.launch", False),
        ("roslaunch", False),
        ("ros2 launch bot bot.launch.py", True),
        ("ros2 launch bot bot.launch.py --show-args", False),
        ("ros2 topic list", False),
        ("gz sim -s -r shapes.sdf", True),
        ("gazebo --help", False),
        ("demo scout --no-browser", True),
        ("demo scout --copy my_scout", False),
        ("demo", False),
        ("gzserver empty.world", True),
        ("rostopic list", False),
    ],
)
def test_only_what_starts_something_has_a_journal(line, launching):
    assert launches(line.split()) is launching


def test_a_launch_that_failed_before_the_world_came_up_is_kept(tmp_path, capfd):
    launch = tmp_path / "bot.launch"
    launch.write_text("<launch>\n  <nod pkg='a' type='b' name='c'/>\n</launch\n")
    assert main(["roslaunch", "-p", "7555", str(launch)]) == 1
    (path,) = journals()
    kept = read(path)
    assert kept is not None
    assert (kept.port, kept.is_running, kept.code) == (7555, False, 1)
    assert kept.told[0].item.code == "xml.malformed"
    assert kept.told[0].item.span is not None
    assert kept.told[0].item.span.file == str(launch)
    assert "xml.malformed" in capfd.readouterr().err


def test_an_error_that_is_no_finding_is_kept(capfd):
    assert main(["roslaunch", "no_such_package", "a.launch"]) == 1
    kept = read(journals()[0])
    assert kept is not None
    assert "no_such_package" in kept.told[0].item.message
    assert "no_such_package" in capfd.readouterr().err


def test_wrong_usage_ends_the_journal_with_its_code():
    with pytest.raises(SystemExit), journal_of(["roslaunch", "x"]):
        raise SystemExit(2)
    kept = read(journals()[0])
    assert kept is not None
    assert kept.code == 2
