from __future__ import annotations

from pathlib import Path

RED = '<color rgba="1 0 0 1"/>'
GREEN = '<color rgba="0 1 0 1"/>'


def _visual(material: str) -> str:
    return f"<visual><geometry><sphere radius='1'/></geometry>{material}</visual>"


def _named(name: str, inside: str = "") -> str:
    return f'<material name="{name}">{inside}</material>'


def _colours(found) -> list:
    materials = [visual.material for visual in found.robot.link("a").visuals]
    return [None if item is None else item.diffuse[:3] for item in materials]


def test_named_for_the_robot_named_inside_and_without_a_name(read_link) -> None:
    found = read_link(
        _visual(_named("red")) + _visual(_named("", GREEN)) + _visual(_named("own", GREEN)),
        after=_named("red", RED),
    )
    assert _colours(found) == [(1, 0, 0), (0, 1, 0), (0, 1, 0)]
    assert not found.codes


def test_a_known_name_wins_over_colours_beside_it(read_link) -> None:
    found = read_link(_visual(_named("red", GREEN)), after=_named("red", RED))
    assert _colours(found) == [(1, 0, 0)]


def test_a_material_named_in_one_visual_is_known_to_the_next(read_link) -> None:
    found = read_link(_visual(_named("own", GREEN)) + _visual(_named("own")))
    assert _colours(found) == [(0, 1, 0), (0, 1, 0)]


def test_undefined_material_leaves_the_shape_as_it_is(read_link) -> None:
    found = read_link(_visual(_named("rad")), after=_named("red", RED))
    message = found.message("urdf.material-undefined")
    assert "link 'a' material 'rad' undefined" in message
    assert "did you mean 'red'" in message
    assert _colours(found) == [None]


def test_texture_is_looked_up(read_link, tmp_path: Path) -> None:
    (tmp_path / "wood.png").write_bytes(b"")
    texture = _visual(_named("wood", '<texture filename="wood.png"/>'))
    missing = _visual(_named("gone", '<texture filename="gone.png"/>'))
    found = read_link(texture + missing, base_dir=tmp_path)
    wood, gone = (visual.material for visual in found.robot.link("a").visuals)
    assert (wood.texture, wood.diffuse) == (tmp_path / "wood.png", (1.0, 1.0, 1.0, 1.0))
    assert gone.texture is None
    assert "shows its plain colour: texture 'gone.png' not found" in found.message(
        "urdf.texture-missing"
    )


def test_mistakes_in_colours_and_names(read_link) -> None:
    found = read_link(
        after=_named("a", '<color rgba="1 2"/>')
        + _named("b", '<color rgba="255 0 0 1"/>')
        + _named("c")
        + _named("", RED)
        + _named("d", RED)
        + _named("d", GREEN)
    )
    assert found.codes == [
        "urdf.bad-rgba",
        "urdf.rgba-range",
        "urdf.material-empty",
        "urdf.material-no-name",
        "urdf.duplicate-material",
    ]
    assert "has malformed color rgba values" in found.message("urdf.bad-rgba")
    assert "leaves 0…1 and is clipped" in found.message("urdf.rgba-range")


def test_color_without_rgba(read_link) -> None:
    assert "has no rgba" in read_link(after=_named("a", "<color/>")).message("urdf.bad-rgba")
