"""Which elements and attributes SDF 1.4 to 1.12 know, per parent, as data.

A row is ``kind: (attributes, children)``. A child is a word: ``name`` is of the kind of its own
name if there is such a row, else a plain value; ``name=kind`` is of another kind; ``name!`` is
legal and has no effect in Gazelle. A row of one ``*`` is free: its content is for somebody else.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.model import SOLIDS
from gazelle.description.sdf.sensor_tables import SENSOR_ROWS
from gazelle.description.sdf.world_tables import WORLD_ROWS

__all__ = ["ELEMENTS", "Element"]

_Rows = dict[str, tuple[str, str]]


@dataclass(frozen=True, slots=True)
class Element:
    """What one kind of element may hold.

    Attributes:
        attributes: names of its attributes.
        children: kind of every child by name.
        without_effect: names of children that are legal and do nothing here.
        free: anything may stand in it.
    """

    attributes: frozenset[str] = frozenset()
    children: dict[str, str] = field(default_factory=dict)
    without_effect: frozenset[str] = frozenset()
    free: bool = False

    @property
    def names(self) -> tuple[str, ...]:
        """Every child name that is legal."""
        return (*self.children, *self.without_effect)


_MODEL_ROWS: _Rows = {
    "model": (
        "name canonical_link placement_frame",
        "static self_collide allow_auto_disable enable_wind! pose frame link joint plugin gripper! "
        "include model",
    ),
    "frame": ("name attached_to", "pose"),
    "pose": ("relative_to frame rotation_format degrees", ""),
    "plugin": ("*", ""),
    "include": (
        "merge",
        "uri name pose static placement_frame plugin experimental:params!",
    ),
    "link": (
        "name",
        "pose gravity enable_wind! self_collide kinematic must_be_base_link! velocity_decay "
        "inertial collision visual sensor light projector! audio_sink! audio_source! battery! "
        "particle_emitter! plugin!",
    ),
    "velocity_decay": ("", "linear angular"),
    "inertial": (
        "auto",
        "mass density pose inertia fluid_added_mass! auto_inertia_params!",
    ),
    "inertia": ("", "ixx ixy ixz iyy iyz izz"),
    "collision": (
        "name",
        "pose geometry surface max_contacts laser_retro density auto_inertia_params!",
    ),
    "visual": (
        "name",
        "pose geometry material transparency cast_shadows laser_retro visibility_flags meta! "
        "plugin!",
    ),
    "geometry": (
        "",
        f"{' '.join(one.word for one in SOLIDS)} plane mesh heightmap image polyline empty",
    ),
    **{one.word: ("", " ".join(length.word for length in one.lengths())) for one in SOLIDS},
    "plane": ("", "normal size"),
    "mesh": ("optimization", "uri filename scale submesh convex_decomposition!"),
    "submesh": ("", "name center"),
    "heightmap": ("", "uri size pos texture! blend! use_terrain_paging! sampling!"),
    "image": ("", "uri scale threshold height granularity"),
    "polyline": ("", "point height"),
    "material": (
        "",
        "script shader! lighting ambient diffuse specular emissive shininess pbr render_order! "
        "double_sided!",
    ),
    "script": ("", "uri name"),
    "pbr": ("", "metal=pbr/workflow specular=pbr/workflow"),
    "pbr/workflow": (
        "",
        "albedo_map roughness_map! roughness! metalness_map! metalness! environment_map! "
        "ambient_occlusion_map! normal_map! emissive_map! light_map! specular_map! "
        "glossiness_map! glossiness!",
    ),
    "surface": ("", "bounce friction contact soft_contact!"),
    "bounce": ("", "restitution_coefficient threshold"),
    "friction": ("", "ode=friction/ode bullet=friction/bullet torsional"),
    "friction/ode": ("", "mu mu2 fdir1 slip1 slip2"),
    "friction/bullet": ("", "friction friction2 fdir1 rolling_friction"),
    "torsional": (
        "",
        "coefficient use_patch_radius patch_radius surface_radius ode=torsional/ode",
    ),
    "torsional/ode": ("", "slip!"),
    "contact": (
        "",
        "collide_without_contact collide_without_contact_bitmask! collide_bitmask "
        "category_bitmask! poissons_ratio! elastic_modulus! ode=contact/ode bullet=contact/bullet",
    ),
    "contact/ode": ("", "soft_cfm soft_erp kp kd max_vel min_depth"),
    "contact/bullet": (
        "",
        "soft_cfm soft_erp kp kd split_impulse! split_impulse_penetration_threshold!",
    ),
    "joint": (
        "name type",
        "pose parent child axis axis2=axis physics=joint/physics sensor gearbox_ratio "
        "gearbox_reference_body thread_pitch screw_thread_pitch",
    ),
    "axis": (
        "",
        "xyz use_parent_model_frame initial_position dynamics limit mimic",
    ),
    "xyz": ("expressed_in", ""),
    "mimic": ("joint axis", "multiplier offset reference"),
    "dynamics": ("", "damping friction spring_reference spring_stiffness"),
    "limit": ("", "lower upper effort velocity stiffness! dissipation!"),
    "joint/physics": ("", "provide_feedback ode=joint/ode simbody!"),
    "joint/ode": (
        "",
        "provide_feedback cfm_damping implicit_spring_damper cfm erp limit=joint/softness "
        "fudge_factor! bounce! max_force! velocity! suspension!",
    ),
    "joint/softness": ("", "cfm erp"),
    "light": (
        "name type",
        "pose cast_shadows intensity diffuse specular direction attenuation spot "
        "light_on! visualize! plugin!",
    ),
    "attenuation": ("", "range constant linear quadratic"),
    "spot": ("", "inner_angle outer_angle falloff"),
}


def _element(attributes: str, children: str, rows: _Rows) -> Element:
    if attributes == "*":
        return Element(free=True)
    kinds: dict[str, str] = {}
    without_effect = set()
    for word in children.split():
        name, _, kind = word.partition("=")
        if word.endswith("!"):
            without_effect.add(word[:-1])
        else:
            kinds[name] = kind or (name if name in rows else "")
    return Element(frozenset(attributes.split()), kinds, frozenset(without_effect))


def _elements(rows: _Rows) -> dict[str, Element]:
    found = {kind: _element(*row, rows) for kind, row in rows.items()}
    return {"": Element(), **found}


ELEMENTS = _elements({**_MODEL_ROWS, **SENSOR_ROWS, **WORLD_ROWS})
