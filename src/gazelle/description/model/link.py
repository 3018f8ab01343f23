"""Links: mass, collisions, visuals, lights and what they carry."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from gazelle.description.model.sensor import Sensor
from gazelle.description.model.shape import Material, Rgba, Shape
from gazelle.description.xml import Tag
from gazelle.diagnostics import SourceSpan
from gazelle.geometry import IDENTITY_POSE, Pose, Vector3

__all__ = ["Collision", "Inertial", "Light", "LightType", "Link", "Surface", "Visual"]


@dataclass(frozen=True, slots=True)
class Inertial:
    """Mass properties of a link.

    Attributes:
        mass_kg: mass.
        T_link_com: frame of the centre of mass and of the tensor.
        inertia_kg_m2: ixx, ixy, ixz, iyy, iyz, izz about the centre of mass.
        estimated: True when the file gave none and it was derived from the shapes.
        span: place in the source.
    """

    mass_kg: float
    T_link_com: Pose = IDENTITY_POSE
    inertia_kg_m2: tuple[float, float, float, float, float, float] = (1, 0, 0, 1, 0, 1)
    estimated: bool = False
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class Surface:
    """Contact behaviour of a collision; None means the format's default.

    Attributes:
        mu1, mu2: Coulomb friction along the first and second direction.
        fdir1: first friction direction in the collision's frame, None for automatic.
        slip1, slip2: force-dependent slip, m/s per N.
        torsional_mu: coefficient of torsional friction, None when off.
        torsional_patch_radius_m: radius of the contact patch.
        rolling_mu: coefficient of rolling friction (Bullet's), None when absent.
        kp: contact stiffness N/m.
        kd: contact damping N·s/m.
        min_depth_m: penetration below which no correction acts.
        max_vel_m_s: highest correction velocity.
        restitution: bounce coefficient 0…1.
        bounce_threshold_m_s: lowest speed that bounces.
        max_contacts: most contact points kept.
        collide_bitmask: pairs collide when the and of their masks is not 0.
        collide_without_contact: contacts are reported but exert no force.
        soft_cfm, soft_erp: ODE's own words, used when kp and kd are absent.
    """

    mu1: float | None = None
    mu2: float | None = None
    fdir1: Vector3 | None = None
    slip1: float | None = None
    slip2: float | None = None
    torsional_mu: float | None = None
    torsional_patch_radius_m: float | None = None
    rolling_mu: float | None = None
    kp: float | None = None
    kd: float | None = None
    min_depth_m: float | None = None
    max_vel_m_s: float | None = None
    restitution: float | None = None
    bounce_threshold_m_s: float | None = None
    max_contacts: int | None = None
    collide_bitmask: int | None = None
    collide_without_contact: bool = False
    soft_cfm: float | None = None
    soft_erp: float | None = None
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class Collision:
    """A shape that touches.

    Attributes:
        shape_span: where the shape's own element stands, where that is known.
    """

    name: str
    shape: Shape
    T_link_collision: Pose = IDENTITY_POSE
    surface: Surface = field(default_factory=Surface)
    laser_retro: float = 0.0
    span: SourceSpan | None = None
    shape_span: SourceSpan | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class Visual:
    """A shape that is seen; `material` None means the mesh's own.

    Attributes:
        shape_span: where the shape's own element stands, where that is known.
    """

    name: str
    shape: Shape
    T_link_visual: Pose = IDENTITY_POSE
    material: Material | None = None
    transparency: float = 0.0
    cast_shadows: bool = True
    laser_retro: float = 0.0
    visibility_flags: int = 0xFFFFFFFF
    span: SourceSpan | None = None
    shape_span: SourceSpan | None = field(default=None, compare=False)


class LightType(Enum):
    """SDF's kinds of light."""

    POINT = "point"
    DIRECTIONAL = "directional"
    SPOT = "spot"


@dataclass(frozen=True, slots=True)
class Light:
    """A light; `direction` in the light's frame, angles in radians, ranges in metres."""

    name: str
    type: LightType
    T_parent_light: Pose = IDENTITY_POSE
    diffuse: Rgba = (1.0, 1.0, 1.0, 1.0)
    specular: Rgba = (0.1, 0.1, 0.1, 1.0)
    direction: Vector3 = (0.0, 0.0, -1.0)
    intensity: float = 1.0
    cast_shadows: bool = False
    range_m: float = 10.0
    attenuation_constant: float = 1.0
    attenuation_linear: float = 0.0
    attenuation_quadratic: float = 0.0
    spot_inner_angle_rad: float = 0.0
    spot_outer_angle_rad: float = 0.0
    spot_falloff: float = 0.0
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid body.

    Attributes:
        name: name within the model; nested models' links are ``nested::link``.
        T_model_link: pose in the model's frame with all joints at zero.
        inertial: mass properties, None for a link that has none (URDF frames).
        inertial_tag: what they were read from, after xacro; None where the file has nothing.
    """

    name: str
    T_model_link: Pose = IDENTITY_POSE
    inertial: Inertial | None = None
    collisions: tuple[Collision, ...] = ()
    visuals: tuple[Visual, ...] = ()
    sensors: tuple[Sensor, ...] = ()
    lights: tuple[Light, ...] = ()
    gravity: bool = True
    self_collide: bool | None = None
    kinematic: bool = False
    linear_damping: float = 0.0
    angular_damping: float = 0.0
    span: SourceSpan | None = None
    inertial_tag: Tag | None = field(default=None, compare=False, repr=False)
