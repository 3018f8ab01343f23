from __future__ import annotations

import numpy as np
import pytest

POPULATION = (
    "<population name='p'><model name='can'><link name='l'/></model><pose>1 2 3 0 0 0</pose>"
    "{}</population>"
)
BOX = (
    "<box><size>4 6 2</size></box><model_count>{}</model_count>"
    "<distribution><type>{}</type></distribution>"
)


def _places(world, body):
    return np.array(
        [item.T_world_model.position_m for item in world(POPULATION.format(body)).models]
    )


def test_copies_are_named_as_in_gazebo(world):
    found = world(POPULATION.format(BOX.format(3, "random"))).models
    assert [item.name for item in found] == ["can_clone_0", "can_clone_1", "can_clone_2"]


def test_grid_is_centred_on_its_pose(world):
    places = _places(
        world,
        "<distribution><type>grid</type><rows>2</rows><cols>3</cols><step>0.5 1 0</step>"
        "</distribution>",
    )
    assert places.shape == (6, 3)
    assert places.mean(axis=0) == pytest.approx((1, 2, 3))
    assert places[0] == pytest.approx((0.5, 1.5, 3))
    assert places[-1] == pytest.approx((1.5, 2.5, 3))


@pytest.mark.parametrize(("word", "axis"), [("linear-x", 0), ("linear-y", 1), ("linear-z", 2)])
def test_rows_start_at_the_boxs_low_side(world, word, axis):
    places = _places(world, BOX.format(4, word))
    size, middle = (4, 6, 2)[axis], (1, 2, 3)[axis]
    assert places[:, axis] == pytest.approx(middle - size / 2 + np.arange(4) * size / 4)


@pytest.mark.parametrize("word", ["random", "uniform"])
def test_copies_stay_inside_their_box(world, word):
    places = _places(world, BOX.format(50, word))
    assert (np.abs(places - (1, 2, 3)) <= (2, 3, 1)).all()
    assert len(np.unique(places.round(6), axis=0)) == 50


@pytest.mark.parametrize("word", ["random", "uniform"])
def test_copies_stay_inside_their_cylinder(world, word):
    body = (
        "<cylinder><radius>2</radius><length>1</length></cylinder><model_count>40</model_count>"
        f"<distribution><type>{word}</type></distribution>"
    )
    places = _places(world, body) - (1, 2, 3)
    assert (np.hypot(places[:, 0], places[:, 1]) <= 2).all()
    assert (np.abs(places[:, 2]) <= 0.5).all()


def test_random_places_are_the_same_in_every_run(world):
    body = BOX.format(5, "random")
    assert (_places(world, body) == _places(world, body)).all()


def test_impossible_population_is_reported(world, diagnostics):
    assert len(world(POPULATION.format(BOX.format(2, "spiral"))).models) == 0
    assert "distribution 'spiral'" in diagnostics.by_code("sdf.bad-value")[0].message
    assert len(world(POPULATION.format(BOX.format(0, "random"))).models) == 0
    assert "model_count 0" in diagnostics.by_code("sdf.bad-value")[1].message


def test_population_without_model_is_reported(world, diagnostics):
    world("<population name='p'><model_count>2</model_count></population>")
    assert "<population> has no <model>" in diagnostics.by_code("xml.missing-tag")[0].message
