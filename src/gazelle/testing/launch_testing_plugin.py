"""launch_testing's part of pytest: files whose function is marked ``launch_test`` are launched.

A part of `gazelle.testing.plugin`, so it imports nothing but pytest before it finds such a file.
Where ROS's own launch_testing is on the path, it does nothing at all.
"""

from __future__ import annotations

import copy
import importlib.util
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

__all__ = ["LaunchTestFailure", "LaunchTestItem", "LaunchTestModule"]

_FUNCTION = "generate_test_description"
_MARK = "launch_test"


class _Specification:
    """The hook that other plug-ins may implement to bring their own module."""

    @pytest.hookspec(firstresult=True)
    def pytest_launch_collect_makemodule(self, path: Path, parent: Any, entrypoint: Any) -> Any:
        """Return the collector of a launch test's file."""


def pytest_addhooks(pluginmanager: pytest.PytestPluginManager) -> None:
    """Make launch_testing's hook known."""
    if _is_ours():
        pluginmanager.add_hookspecs(_Specification)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Make launch_testing's option known."""
    if _is_ours():
        text = "One or more Launch test arguments"
        parser.addoption("--launch-args", action="append", nargs="*", default=[], help=text)


def pytest_configure(config: pytest.Config) -> None:
    """Make launch_testing's marker known."""
    text = f"mark a {_FUNCTION} function as a launch test entrypoint"
    config.addinivalue_line("markers", f"{_MARK}: {text}")


def pytest_pycollect_makemodule(module_path: Path, parent: Any) -> Any:
    """Return a collector of its own for a launch test's file."""
    if not _is_ours():
        return None
    text = _text(module_path)
    if "launch_pytest" in text:
        _let_launch_be_found()
        _bring_launch_pytest(parent.config)
    if _FUNCTION not in text:
        return None
    _let_launch_be_found()
    module = pytest.Module.from_parent(parent, path=module_path)
    try:
        entrypoint = getattr(module.obj, _FUNCTION, None)
    except module.CollectError:
        # Told when it is collected in the usual way.
        return module
    found = parent.session.gethookproxy(module_path).pytest_launch_collect_makemodule(
        path=module_path, parent=parent, entrypoint=entrypoint
    )
    return found or module


@pytest.hookimpl(trylast=True)
def pytest_launch_collect_makemodule(path: Path, parent: Any, entrypoint: Any) -> Any:
    """Return a collector if the function is marked ``launch_test``."""
    marks = getattr(entrypoint, "pytestmark", [])
    if not any(mark.name == _MARK for mark in marks):
        return None
    found = LaunchTestModule.from_parent(parent, path=path)
    for mark in marks:
        found.add_marker(getattr(pytest.mark, mark.name).with_args(*mark.args, **mark.kwargs))
    return found


class LaunchTestFailure(Exception):  # noqa: N818 - the name in launch_testing
    """Tests of a launch failed.

    Attributes:
        results: of its runs.
    """

    def __init__(self, results: dict[Any, Any]) -> None:
        super().__init__("some test cases have failed")
        self.results = results


class LaunchTestItem(pytest.Item):
    """All launches and tests of a file.

    Attributes:
        test_runs: its launches.
    """

    def __init__(self, *, test_runs: list[Any], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.test_runs = test_runs

    def runtest(self) -> None:
        """Launch and test."""
        from gazelle.launch.ros2.launch_testing.test_runner import LaunchTestRunner

        given = [word for words in self.config.getoption("--launch-args") for word in words]
        is_verbose = self.config.get_verbosity() > 0
        runner = LaunchTestRunner(copy.deepcopy(self.test_runs), given, debug=is_verbose)
        runner.validate()
        results = runner.run()
        if not all(result.wasSuccessful() for result in results.values()):
            raise LaunchTestFailure(results)

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        """Return what each test that failed says."""
        if not isinstance(excinfo.value, LaunchTestFailure):
            return super().repr_failure(excinfo, style)
        failed = [
            f"FAIL: {case.id()}\n{text}"
            for result in excinfo.value.results.values()
            for case, text in [*result.errors, *result.failures]
        ]
        return "\n\n".join(failed)

    def reportinfo(self) -> tuple[Path, int, str]:
        """Return file and name."""
        return self.path, 0, f"launch tests: {self.name}"


class LaunchTestModule(pytest.File):
    """A file with a launch test."""

    def collect(self) -> Iterator[LaunchTestItem]:
        """Yield the one item of the file."""
        from gazelle.launch.ros2.launch_testing.loader import LoadTestsFromPythonModule

        module = pytest.Module.from_parent(self.parent, path=self.path).obj
        name = module.__name__
        runs = LoadTestsFromPythonModule(module, name=name)
        yield LaunchTestItem.from_parent(self, name=name, test_runs=runs)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def _is_ours() -> bool:
    spec = importlib.util.find_spec("launch_testing")
    return spec is None or str(Path(__file__).parents[1]) in str(spec.origin)


def _bring_launch_pytest(config: pytest.Config) -> None:
    from gazelle.testing import launch_pytest_plugin

    if not config.pluginmanager.is_registered(launch_pytest_plugin):
        config.pluginmanager.register(launch_pytest_plugin, "launch_pytest")


def _let_launch_be_found() -> None:
    from gazelle.launch.environment import drop_in_folder

    folder = str(drop_in_folder())
    if folder not in sys.path:
        sys.path.append(folder)
