from __future__ import annotations

from gazelle.description.model import Scene


def test_words_of_a_scene(world):
    found = world(
        "<scene><ambient>.1 .2 .3 1</ambient><background>.4 .5 .6 1</background><sky/>"
        "<shadows>0</shadows><grid>false</grid></scene>"
    ).scene
    assert (found.ambient, found.background) == ((0.1, 0.2, 0.3, 1), (0.4, 0.5, 0.6, 1))
    assert (found.sky, found.shadows, found.grid) == (True, False, False)


def test_silence_is_the_default_scene(world):
    assert world("").scene == Scene()


def test_fog_is_told_of(world, diagnostics):
    world("<scene><fog><type>linear</type></fog></scene>")
    assert diagnostics.by_code("sdf.not-simulated")[0].message.startswith("<fog> in <scene>")


def test_place_on_earth(world):
    found = world(
        "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model>"
        "<world_frame_orientation>ENU</world_frame_orientation><latitude_deg>49.9</latitude_deg>"
        "<longitude_deg>8.9</longitude_deg><elevation>120</elevation><heading_deg>10</heading_deg>"
        "</spherical_coordinates>"
    ).spherical_coordinates
    assert (found.latitude_deg, found.longitude_deg) == (49.9, 8.9)
    assert (found.elevation_m, found.heading_deg) == (120, 10)


def test_other_axes_than_east_north_up_are_reported(world, diagnostics):
    world(
        "<spherical_coordinates><world_frame_orientation>NED</world_frame_orientation>"
        "</spherical_coordinates>"
    )
    assert "'NED' is not supported" in diagnostics.by_code("sdf.bad-value")[0].message


def test_no_place_on_earth_is_none(world):
    assert world("").spherical_coordinates is None
