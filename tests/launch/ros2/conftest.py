"""Runs launch descriptions in the test's own process."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from gazelle.diagnostics import Diagnostic
from gazelle.launch import watchdog
from gazelle.launch.ros2 import (
    LaunchContext,
    LaunchDescription,
    LaunchService,
    deprecation,
    logging,
)
from gazelle.launch.ros2.actions import IncludeLaunchDescription

Run = Callable[..., "Ran"]
Include = Callable[..., tuple[int, list[Diagnostic], str]]


@dataclass(frozen=True)
class Ran:
    """A launch that is over.

    Attributes:
        code: what `LaunchService.run` returned.
        text: what the terminal showed, standard error apart.
        context: of the launch.
    """

    code: int
    text: str
    context: LaunchContext

    @property
    def lines(self) -> list[str]:
        """What the terminal showed, line by line."""
        return self.text.splitlines()


@pytest.fixture(autouse=True)
def _own_logs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    monkeypatch.setattr(watchdog, "_PATIENCE_S", 0.2)
    deprecation.WARNED.clear()
    for name in list(os.environ):
        if name.startswith("OVERRIDE_LAUNCH"):
            monkeypatch.delenv(name)
    before = dict(os.environ)
    monkeypatch.setattr(sys, "path", list(sys.path))
    logging.reset()
    yield
    logging.reset()
    os.environ.clear()
    os.environ.update(before)


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs entities to their end; ``during`` is called with the service before."""

    def run_entities(*entities: Any, during: Callable[..., Any] | None = None, **given: str) -> Ran:
        service = LaunchService()
        service.context.launch_configurations.update(given)
        service.include_launch_description(LaunchDescription(list(entities)))
        if during is not None:
            during(service)
        code = service.run()
        return Ran(code, capsys.readouterr().out, service.context)

    return run_entities


@pytest.fixture
def include(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Include:
    """Includes a file in a launch: exit code, findings and all text on the terminal."""

    def run(name: str, text: str, **given: str) -> tuple[int, list[Diagnostic], str]:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        service = LaunchService()
        action = IncludeLaunchDescription(str(path), launch_arguments=given.items())
        service.include_launch_description(LaunchDescription([action]))
        code = service.run()
        shown = capsys.readouterr()
        return code, list(service.context.diagnostics), shown.out + shown.err

    return run


@pytest.fixture
def context() -> LaunchContext:
    """A context without a running launch."""
    return LaunchContext()
