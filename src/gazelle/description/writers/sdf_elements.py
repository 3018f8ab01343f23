"""Surfaces, looks and lights in SDF's words; URDF's ``<gazebo>`` blocks use them too."""

from __future__ import annotations

from gazelle.description.materials import gazebo_material
from gazelle.description.model import Light, LightType, Material, Surface
from gazelle.description.writers.output_files import Beside
from gazelle.description.writers.sensor_text import add_pose
from gazelle.description.writers.xml_markup import Markup, number, numbers
from gazelle.geometry import Pose

__all__ = ["add_light", "add_material", "add_surface", "is_script"]

_GAZEBO_SCRIPTS = "file://media/materials/scripts/gazebo.material"


def add_surface(owner: Markup, surface: Surface) -> None:
    """Append a ``<surface>`` with the words that are given; nothing when none is."""
    item = Markup("surface")
    _add_values(item, "bounce", _bounce(surface))
    friction = Markup("friction")
    _add_values(friction, "ode", _friction(surface))
    if surface.rolling_mu is not None:
        friction.add("bullet").add("rolling_friction", number(surface.rolling_mu))
    if surface.torsional_mu is not None:
        torsional = friction.add("torsional")
        torsional.add("coefficient", number(surface.torsional_mu))
        if surface.torsional_patch_radius_m is not None:
            torsional.add("use_patch_radius", "true")
            torsional.add("patch_radius", number(surface.torsional_patch_radius_m))
    item.children += [friction] if friction.children else []
    contact = Markup("contact")
    if surface.collide_without_contact:
        contact.add("collide_without_contact", "true")
    if surface.collide_bitmask is not None:
        contact.add("collide_bitmask", number(surface.collide_bitmask))
    _add_values(contact, "ode", _contact(surface))
    item.children += [contact] if contact.children else []
    owner.children += [item] if item.children else []


def _bounce(surface: Surface) -> dict[str, str]:
    return _given(
        restitution_coefficient=surface.restitution, threshold=surface.bounce_threshold_m_s
    )


def _friction(surface: Surface) -> dict[str, str]:
    found = _given(mu=surface.mu1, mu2=surface.mu2)
    if surface.fdir1 is not None:
        found["fdir1"] = numbers(surface.fdir1)
    return {**found, **_given(slip1=surface.slip1, slip2=surface.slip2)}


def _contact(surface: Surface) -> dict[str, str]:
    return _given(
        soft_cfm=surface.soft_cfm,
        soft_erp=surface.soft_erp,
        kp=surface.kp,
        kd=surface.kd,
        max_vel=surface.max_vel_m_s,
        min_depth=surface.min_depth_m,
    )


def _given(**values: float | None) -> dict[str, str]:
    return {name: number(value) for name, value in values.items() if value is not None}


def _add_values(owner: Markup, name: str, values: dict[str, str]) -> None:
    if values:
        item = owner.add(name)
        for word, text in values.items():
            item.add(word, text)


def is_script(material: Material) -> bool:
    """Tell whether a look is one of Gazebo's named ones, unchanged."""
    return bool(material.name) and gazebo_material(material.name) == material


def add_material(owner: Markup, material: Material, beside: Beside) -> None:
    """Append a ``<material>``: one of Gazebo's scripts by name, else its colours."""
    item = owner.add("material")
    if is_script(material):
        script = item.add("script")
        script.add("uri", _GAZEBO_SCRIPTS)
        script.add("name", material.name)
        return
    for word in ("ambient", "diffuse", "specular", "emissive"):
        item.add(word, numbers(getattr(material, word)))
    if material.shininess:
        item.add("shininess", number(material.shininess))
    if not material.lighting:
        item.add("lighting", "false")
    if material.texture is not None:
        metal = item.add("pbr").add("metal")
        metal.add("albedo_map", beside.address(material.texture))


def add_light(owner: Markup, light: Light, T_parent_light: Pose) -> None:
    """Append a ``<light>``."""
    item = owner.add("light", name=light.name, type=light.type.value)
    add_pose(item, T_parent_light)
    item.add("cast_shadows", str(light.cast_shadows).lower())
    item.add("intensity", number(light.intensity))
    item.add("diffuse", numbers(light.diffuse))
    item.add("specular", numbers(light.specular))
    item.add("direction", numbers(light.direction))
    attenuation = item.add("attenuation")
    attenuation.add("range", number(light.range_m))
    attenuation.add("constant", number(light.attenuation_constant))
    attenuation.add("linear", number(light.attenuation_linear))
    attenuation.add("quadratic", number(light.attenuation_quadratic))
    if light.type is LightType.SPOT:
        spot = item.add("spot")
        spot.add("inner_angle", number(light.spot_inner_angle_rad))
        spot.add("outer_angle", number(light.spot_outer_angle_rad))
        spot.add("falloff", number(light.spot_falloff))
