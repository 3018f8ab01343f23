"""Every family of plug-ins: a law, kept by every name and in every spelling of its keys."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from tests.simulator.plugins import family_drives, family_sensors, family_worlds
from tests.simulator.plugins.family_trial import FamilyRow

from gazelle.simulator import Simulation
from gazelle.simulator.plugins.registry import all_tables

ROWS = (*family_drives.ROWS, *family_sensors.ROWS, *family_worlds.ROWS)
NAMES = {table.parameters.family: table.parameters.types for table in all_tables()}


def cases() -> list[object]:
    return [
        pytest.param(row, name, keys, id=f"{row.family}-{name}-{place}".replace(" ", "_"))
        for row in ROWS
        for name in NAMES[row.family]
        for place, keys in enumerate(row.spellings)
    ]


@pytest.mark.parametrize(("row", "name", "keys"), cases())
def test_every_name_of_every_family_keeps_the_familys_law(
    load: Callable[..., Simulation], row: FamilyRow, name: str, keys: str
) -> None:
    row.check(load, name, keys)


def test_no_family_is_without_a_law() -> None:
    assert {row.family for row in ROWS} == set(NAMES)
