"""The documents' robots and turtles, started as a person does, and the pages they open."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.browser.tutorial.launching import launch, window
from tests.browser.tutorial.terminal import Session

__all__ = ["launch", "session", "window"]


@pytest.fixture
def session(gazelle: Any, tmp_path: Path) -> Callable[..., Session]:
    """Types a first command, and others beside it; ``session("roscore")``."""
    own = {"GAZELLE_STUDIO": "1", "XDG_CONFIG_HOME": str(tmp_path / "config")}

    def begin(line: str, **options: Any) -> Session:
        return Session(gazelle, line, **own, **options)

    return begin
