"""Gazebo's named materials (``Gazebo/Red`` …): colours as its ``gazebo.material`` defines them."""

from __future__ import annotations

from typing import NamedTuple

from gazelle.description.model import Material, Rgba

__all__ = ["GAZEBO_MATERIAL_NAMES", "gazebo_material", "picture_colour"]

Rgb = tuple[float, float, float]
_BLACK: Rgb = (0.0, 0.0, 0.0)
_DIM: Rgb = (0.1, 0.1, 0.1)
_FAINT: Rgb = (0.01, 0.01, 0.01)
_WHITE: Rgb = (1.0, 1.0, 1.0)
_PREFIX = "Gazebo/"
_ORANGE: Rgb = (1.0, 0.5088, 0.0468)
_ZINC: Rgb = (0.9725, 0.9529, 0.2078)
_RED_BRIGHT: Rgb = (0.87, 0.26, 0.07)
_DARK_GREY: Rgb = (0.175, 0.175, 0.175)
_ASPHALT: Rgb = (0.33, 0.33, 0.34)
_PAVEMENT: Rgb = (0.62, 0.60, 0.57)


def gazebo_material(name: str) -> Material | None:
    """Return one of Gazebo's own materials, None when it has no such name.

    Ambient, diffuse and specular colours are those of Gazebo's ``gazebo.material``. Materials
    with a picture have the picture's mean colour instead (`picture_colour`), chosen by eye.

    Args:
        name: such as ``Gazebo/Red``; the case counts, as in Gazebo.
    """
    appearance = _APPEARANCES.get(name.removeprefix(_PREFIX)) if name.startswith(_PREFIX) else None
    if appearance is None:
        return None
    mean = appearance.mean or _WHITE
    return Material(
        name=name,
        ambient=_tinted(appearance.ambient, mean, appearance.alpha),
        diffuse=_tinted(appearance.diffuse, mean, appearance.alpha),
        specular=(*appearance.specular, 1.0),
        emissive=(*appearance.emissive, 1.0),
        shininess=appearance.shininess,
        lighting=appearance.lighting,
    )


def picture_colour(name: str) -> Rgb | None:
    """Return the mean colour of this material's picture in Gazebo, None when it has none.

    It stands for the picture: other colours of the surface are multiplied with it.
    """
    appearance = _APPEARANCES.get(name.removeprefix(_PREFIX))
    return appearance.mean if appearance is not None else None


class _Appearance(NamedTuple):
    """Colours of one material; `alpha` of them all, `mean` the look of its picture if any."""

    ambient: Rgb
    diffuse: Rgb
    specular: Rgb = _BLACK
    shininess: float = 0.0
    emissive: Rgb = _BLACK
    alpha: float = 1.0
    lighting: bool = True
    mean: Rgb | None = None


def _plain(colour: Rgb, specular: Rgb = _DIM, shininess: float = 1.0) -> _Appearance:
    return _Appearance(colour, colour, specular, shininess)


def _glow(colour: Rgb, specular: Rgb = _DIM, shininess: float = 1.0) -> _Appearance:
    return _Appearance(colour, colour, specular, shininess, emissive=colour)


def _clear(colour: Rgb, alpha: float = 0.5, *, lighting: bool = True) -> _Appearance:
    return _Appearance(colour, colour, alpha=alpha, lighting=lighting)


def _overlay(colour: Rgb, alpha: float = 0.5) -> _Appearance:
    return _clear(colour, alpha, lighting=False)


def _picture(
    mean: Rgb, ambient: float = 1.0, specular: float = 0.2, exponent: float = 12.5
) -> _Appearance:
    grey, shine = (ambient, ambient, ambient), (specular, specular, specular)
    return _Appearance(grey, _WHITE, shine, exponent, mean=mean)


def _street(mean: Rgb) -> _Appearance:
    """Ambient 0.1, diffuse 0.8, as the twelve kinds of road share."""
    return _Appearance(_DIM, (0.8, 0.8, 0.8), _FAINT, 2.0, mean=mean)


def _tinted(colour: Rgb, mean: Rgb, alpha: float) -> Rgba:
    return (colour[0] * mean[0], colour[1] * mean[1], colour[2] * mean[2], alpha)


_APPEARANCES: dict[str, _Appearance] = {
    "Grey": _Appearance((0.3, 0.3, 0.3), (0.7, 0.7, 0.7), _FAINT, 1.5),
    "Gray": _Appearance((0.3, 0.3, 0.3), (0.7, 0.7, 0.7), _FAINT, 1.5),
    "DarkGrey": _plain(_DARK_GREY, _DARK_GREY, 1.5),
    "DarkGray": _plain(_DARK_GREY, _DARK_GREY, 1.5),
    "White": _plain(_WHITE, _DIM, 128.0),
    "FlatBlack": _plain(_DIM, _FAINT),
    "Black": _plain(_BLACK, _DIM, 5.0),
    "Red": _plain((1.0, 0.0, 0.0)),
    "RedBright": _plain(_RED_BRIGHT, _RED_BRIGHT),
    "Green": _plain((0.0, 1.0, 0.0)),
    "Blue": _plain((0.0, 0.0, 1.0)),
    "SkyBlue": _Appearance((0.13, 0.44, 0.70), (0.0, 0.0, 1.0), _DIM, 1.0),
    "Yellow": _plain((1.0, 1.0, 0.0), _BLACK, 0.0),
    "ZincYellow": _plain(_ZINC, _ZINC),
    "DarkYellow": _plain((0.7, 0.7, 0.0), _BLACK, 0.0),
    "Purple": _plain((1.0, 0.0, 1.0)),
    "Turquoise": _plain((0.0, 1.0, 1.0)),
    "Orange": _plain(_ORANGE, (0.5, 0.5, 0.5), 128.0),
    "Indigo": _plain((0.33, 0.0, 0.5)),
    "Gold": _Appearance((0.4, 0.24869, 0.020759), (0.8, 0.64869, 0.120759), (0.4, 0.4, 0.4), 12.5),
    "Pioneer2Body": _Appearance(
        (0.481193, 0.000123, 0.000123), (0.681193, 0.000923, 0.000923), (0.5, 0.5, 0.5), 12.5
    ),
    "WhiteGlow": _glow(_WHITE, _DIM, 128.0),
    "RedGlow": _glow((1.0, 0.0, 0.0), (1.0, 0.0, 0.0), 128.0),
    "GreenGlow": _glow((0.0, 1.0, 0.0)),
    "BlueGlow": _glow((0.0, 0.0, 1.0)),
    "YellowGlow": _glow((1.0, 1.0, 0.0), _BLACK, 0.0),
    "PurpleGlow": _glow((1.0, 0.0, 1.0)),
    "TurquoiseGlow": _glow((0.0, 1.0, 1.0)),
    "TurquoiseGlowOutline": _glow((0.0, 1.0, 1.0), _DIM, 128.0),
    "LightOn": _glow((0.0, 1.0, 0.0), _BLACK, 0.0),
    "LightOff": _glow((1.0, 0.0, 0.0), _BLACK, 0.0),
    "JointAnchor": _Appearance(_WHITE, _WHITE, _WHITE, 0.0, _WHITE, lighting=False),
    "RedTransparentOverlay": _overlay((1.0, 0.0, 0.0)),
    "GreenTransparentOverlay": _overlay((0.0, 1.0, 0.0)),
    "BlueTransparentOverlay": _overlay((0.0, 0.0, 1.0)),
    "OrangeTransparentOverlay": _overlay(_ORANGE, 0.8),
    "DarkOrangeTransparentOverlay": _overlay((0.6, 0.305, 0.028), 0.8),
    "RedTransparent": _overlay((1.0, 0.0, 0.0)),
    "GreenTransparent": _clear((0.0, 1.0, 0.0)),
    "BlueTransparent": _clear((0.0, 0.0, 1.0)),
    "DarkMagentaTransparent": _clear((0.6, 0.0, 0.6)),
    "GreyTransparent": _clear((0.5, 0.5, 0.5)),
    "BlackTransparent": _clear(_BLACK),
    "YellowTransparent": _clear((1.0, 1.0, 0.0)),
    "OrangeTransparent": _clear((1.0, 0.44, 0.0), 0.4),
    "LightBlueLaser": _clear((0.5, 0.5, 1.0), 0.4),
    "BlueLaser": _clear((0.0, 0.0, 1.0), 0.4),
    "WoodFloor": _picture((0.55, 0.38, 0.22), 0.5, 0.0, 0.0),
    "CeilingTiled": _picture((0.80, 0.80, 0.78), 0.5, 0.0, 0.0),
    "PaintedWall": _picture((0.83, 0.80, 0.74), 1.0, 0.0, 0.0),
    "PioneerBody": _Appearance(
        (0.5, 0.0, 0.0), _WHITE, (0.5, 0.0, 0.0), 10.0, mean=(0.7, 0.05, 0.05)
    ),
    "WoodPallet": _picture((0.66, 0.53, 0.36), 0.5, 0.0, 0.5),
    "Wood": _picture((0.60, 0.42, 0.26)),
    "Bricks": _picture((0.58, 0.32, 0.25)),
    "WindowFrame": _picture((0.75, 0.75, 0.75)),
    "BuildingFrame": _picture((0.72, 0.70, 0.66)),
    "Grass": _picture((0.27, 0.42, 0.17), 0.5, 0.0, 0.0),
    "CoM": _picture((0.5, 0.5, 0.5), 0.5, 0.0, 0.0),
    "GreyGradientSky": _Appearance(_WHITE, _WHITE, lighting=False, mean=(0.7, 0.7, 0.7)),
    "CloudySky": _Appearance(_WHITE, _WHITE, lighting=False, mean=(0.62, 0.73, 0.86)),
    "Road": _street(_ASPHALT),
    "Runway": _street(_ASPHALT),
    "Residential": _street(_ASPHALT),
    "Tertiary": _street(_ASPHALT),
    "Motorway": _street(_ASPHALT),
    "Lanes_6": _street(_ASPHALT),
    "Trunk": _street(_ASPHALT),
    "Lanes_4": _street(_ASPHALT),
    "Primary": _street(_ASPHALT),
    "Lanes_2": _street(_ASPHALT),
    "Secondary": _street(_ASPHALT),
    "Lane_1": _street(_ASPHALT),
    "Pedestrian": _street(_PAVEMENT),
    "Footway": _street(_PAVEMENT),
    "Steps": _street(_PAVEMENT),
}
GAZEBO_MATERIAL_NAMES = tuple(sorted(_PREFIX + name for name in _APPEARANCES))
