"""Overlaps at the spawn pose."""

from __future__ import annotations

from tests.doctor.probes.worlds import block, ground, probed, robot

from gazelle.doctor.probes import stood_on_ground


def test_block_in_the_ground_is_told_how_high_to_spawn_it() -> None:
    sections, found = probed(ground(), block(0.0))
    (item,) = found
    assert item.code == "probe.spawn-overlap"
    assert "robot 'cube' is spawned 100 mm inside something" in item.message
    assert "'block::c' and 'ground::link::collision'" in item.message
    assert item.fix == "spawn it 0.101 m higher (spawn_model … -z), or somewhere free"
    assert sections["probe_spawn"].rows[0][1] == "100 mm"


def test_overlap_of_own_links_is_told() -> None:
    _, found = probed(ground(), robot("pain_15_contact/broken/self_overlap.urdf", 0.001))
    (item,) = found.by_code("probe.spawn-overlap")
    assert "'base_link::base_link_collision' and 'box::box_collision'" in item.message
    assert "start 20 mm inside each other" in item.message
    assert "self_collide" in item.fix
    assert item.span is not None
    assert item.span.line > 1


def test_robot_that_is_fast_at_once_is_told() -> None:
    # A gravity to the side stands in for whatever kicks it: 20 m/s² for 0.2 s.
    sections, found = probed(block(0.5), gravity_m_s2=(20.0, 0.0, 0.0))
    (item,) = found.by_code("probe.thrown")
    assert item.message == (
        "robot 'cube' reaches 4.02 m/s upwards or sideways within 0.2 s after it is spawned"
    )
    assert "joints within their limits" in item.fix
    assert sections["probe_spawn"].rows == (("cube", "0 mm", "", "4 m/s", "thrown"),)


def test_model_that_nobody_placed_is_put_on_the_ground() -> None:
    lifted = stood_on_ground(block(0.0))
    assert lifted.T_world_model.position_m[2] == 0.101
    high = block(0.4)
    assert stood_on_ground(high) is high
