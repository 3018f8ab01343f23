"""The rows of what find_package finds fit the rest."""

from __future__ import annotations

import pytest

from gazelle.cpp.building.settings import CMAKE
from gazelle.cpp.provided_packages import PROVIDED, REFUSED, provided, refusal
from gazelle.cpp.runtime_libraries import LIBRARIES, with_needs


def test_every_library_of_a_row_is_one_of_ours() -> None:
    named = {library for row in PROVIDED for library in row.libraries}
    assert named <= set(LIBRARIES)


def test_every_script_of_a_row_is_there() -> None:
    named = {script for row in PROVIDED for script in row.scripts}
    assert {name for name in named if not (CMAKE / f"{name}.cmake").is_file()} == set()


def test_a_library_has_sources_and_needs_that_are_there() -> None:
    assert {name for name, row in LIBRARIES.items() if not row.sources} == set()
    assert {need for row in LIBRARIES.values() for need in row.needs} <= set(LIBRARIES)


@pytest.mark.parametrize("generation", [1, 2])
def test_libraries_of_a_ros_need_none_of_the_other(generation: int) -> None:
    for row in provided(generation).values():
        needed = with_needs([name for name in row.libraries if name in LIBRARIES])
        assert {library.generation for library in needed} <= {0, generation}, row.name


def test_what_is_refused_is_not_provided() -> None:
    for generation in (1, 2):
        assert set(REFUSED) & set(provided(generation)) == set()
    assert refusal("gz-sim7", 2)
    assert refusal("hardware_interface", 2)
    assert not refusal("hardware_interface", 1)
    assert not refusal("roscpp", 1)
