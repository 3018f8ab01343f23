from __future__ import annotations

import pytest

from gazelle.errors import NotFoundError
from gazelle.simulator.simulation import full_name

NAMES = ("arm::shoulder", "arm::elbow", "cart::left", "truck::left")


def test_a_short_name_is_enough_while_it_is_unique() -> None:
    assert full_name("joint", "elbow", NAMES) == "arm::elbow"
    assert full_name("joint", "truck::left", NAMES) == "truck::left"


def test_a_name_of_several_models_lists_them() -> None:
    with pytest.raises(NotFoundError, match="several have this name: 'cart::left', 'truck::left'"):
        full_name("joint", "left", NAMES)


def test_a_mistyped_name_gets_the_nearest() -> None:
    with pytest.raises(NotFoundError, match="joint 'elbo' not found; did you mean 'elbow'"):
        full_name("joint", "elbo", NAMES)
