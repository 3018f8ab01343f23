"""Tables of options: every row says what it does, and every option is read somewhere."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from gazelle.navigation.controllers import CONTROLLERS
from gazelle.navigation.costmap import LAYER_TYPES, CostmapOptions, SourceOptions
from gazelle.navigation.localization import AmclOptions
from gazelle.navigation.planners import PLANNERS
from gazelle.parameters.dataclass_tables import idle_of, rows_of

_SOURCE = Path(__file__).parents[2] / "src" / "gazelle"
_CLASSES = sorted(
    {
        AmclOptions,
        CostmapOptions,
        SourceOptions,
        *LAYER_TYPES.values(),
        *(kind.options for kind in PLANNERS.values()),
        *(kind.options for kind in CONTROLLERS.values()),
    },
    key=lambda kind: kind.__name__,
)


def _readers() -> str:
    folders = [_SOURCE / "navigation", _SOURCE / "nodes"]
    files = [path for folder in folders for path in folder.rglob("*.py")]
    return "\n".join(
        path.read_text(encoding="utf-8") for path in files if "options" not in path.name
    )


@pytest.mark.parametrize("kind", _CLASSES, ids=lambda kind: kind.__name__)
def test_every_option_says_what_it_does_and_is_read(kind: type) -> None:
    text = _readers()
    for row in rows_of(kind):
        assert row.meaning, row.key
        assert re.search(rf"\.{row.key}\b|\"{row.key}\"", text), f"nothing reads {row.key}"


@pytest.mark.parametrize("kind", _CLASSES, ids=lambda kind: kind.__name__)
def test_what_has_no_effect_is_no_option(kind: type) -> None:
    keys = {row.key for row in rows_of(kind)}
    for key, why in idle_of(kind).items():
        assert key not in keys
        assert len(why) > 10, key


@pytest.mark.parametrize("kind", _CLASSES, ids=lambda kind: kind.__name__)
def test_defaults_lie_within_their_limits(kind: type) -> None:
    own = getattr(kind, "NAV2_DEFAULTS", {})
    rows = {row.key: row for row in rows_of(kind)}
    assert set(own) <= set(rows)
    for key, row in rows.items():
        for value in (row.default, own.get(key, row.default)):
            if isinstance(value, int | float) and not isinstance(value, bool):
                assert row.low is None or value >= row.low, key
                assert row.high is None or value <= row.high, key
