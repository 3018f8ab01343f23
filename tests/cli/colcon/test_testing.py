"""``colcon test`` and ``colcon test-result``."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cli.colcon import main

Captured = pytest.CaptureFixture[str]
_SETUP = "from setuptools import setup\nsetup(name='{0}', packages=['{0}'])\n"
_TESTS = """import pytest
from bot import double
def test_right():
    assert double(2) == 4
def test_wrong():
    assert double(2) == 5, 'not five'
def test_left_out():
    pytest.skip('no')
"""
_MANIFEST = """<package format="3"><name>{0}</name><version>0.1.0</version>
<description>x</description><maintainer email="a@example.org">a</maintainer><license>MIT</license>
<export><build_type>{1}</build_type></export></package>"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Package ``bot`` of Python with three tests, and ``arm`` with one of each kind."""
    texts = {
        "bot/package.xml": _MANIFEST.format("bot", "ament_python"),
        "bot/setup.py": _SETUP.format("bot"),
        "bot/bot/__init__.py": "def double(x):\n    return 2 * x\n",
        "bot/test/test_bot.py": _TESTS,
        "arm/package.xml": _MANIFEST.format("arm", "ament_cmake"),
        "arm/CMakeLists.txt": "project(arm)\nament_add_pytest_test(one test/test_arm.py)\n"
        "ament_add_gtest(two test/two.cpp)\nament_package()\n",
        "arm/test/test_arm.py": "def test_arm():\n    assert True\n",
    }
    for name, text in texts.items():
        file = tmp_path / "src" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    return tmp_path


def test_tests_run_against_the_installed_package(workspace: Path, capsys: Captured) -> None:
    assert main(["build", "--event-handlers", "console_stderr-"]) == 0
    # What is tested is what was installed.
    (workspace / "src/bot/bot/__init__.py").rename(workspace / "src/bot/bot/away.py")
    (workspace / "src/bot/bot/away.py").unlink()
    (workspace / "src/bot/bot").rmdir()
    capsys.readouterr()
    assert main(["test"]) == 0
    printed = capsys.readouterr()
    assert "  1 package had test failures: bot\n" in printed.out
    assert "not five" in printed.err
    assert "test 'two' of ament_add_gtest() is not run" in printed.err
    assert "[build.test-not-run]" in printed.err
    assert main(["test-result", "--verbose"]) == 1
    told = capsys.readouterr().out.splitlines()
    assert told[0] == "build/bot/pytest.xml: 3 tests, 0 errors, 1 failure, 1 skipped"
    assert told[1].startswith("- test.test_bot test_wrong: AssertionError: not five")
    assert told[-1] == "Summary: 4 tests, 0 errors, 1 failure, 1 skipped"
    assert main(["test", "--packages-select", "bot", "--return-code-on-test-failure"]) == 1


def test_without_results_it_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["test-result"]) == 1
    assert "the test result base 'build' does not exist" in capsys.readouterr().err
    (tmp_path / "build").mkdir()
    assert main(["test-result"]) == 0
    assert capsys.readouterr().out == "Summary: 0 tests, 0 errors, 0 failures, 0 skipped\n"
