"""Models and worlds: what URDF and SDF compile into and the engine builds from."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from gazelle.description.model.joint import Joint
from gazelle.description.model.link import Light, Link
from gazelle.description.model.plugin import PluginTag, Ros2ControlTag, TransmissionTag
from gazelle.description.model.shape import Rgba
from gazelle.diagnostics import SourceSpan
from gazelle.geometry import IDENTITY_POSE, Pose, Vector3
from gazelle.rich_display import shown_by

__all__ = ["Frame", "Model", "Physics", "Scene", "SphericalCoordinates", "World"]


@dataclass(frozen=True, slots=True)
class Frame:
    """A named frame attached to a link (resolved), pose in the model's frame at zero."""

    name: str
    attached_to: str
    T_model_frame: Pose = IDENTITY_POSE


@shown_by("robots:model_bundle")
@dataclass(frozen=True, slots=True)
class Model:
    """A robot or a thing. Nested models are flattened: their names become ``nested::name``.

    Attributes:
        name: name in the world.
        T_world_model: where its frame stands.
        static: never moves.
        canonical_link: the link whose pose is the model's, as Gazebo reports it.
        plugins: model plug-ins (URDF ``<gazebo>`` without sensor, SDF ``<plugin>``).
        source_format: which reader made it; some defaults of the engine depend on it.
        file: where it came from, None for a text.
    """

    name: str
    T_world_model: Pose = IDENTITY_POSE
    static: bool = False
    self_collide: bool = False
    allow_auto_disable: bool = True
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    frames: tuple[Frame, ...] = ()
    canonical_link: str = ""
    plugins: tuple[PluginTag, ...] = ()
    transmissions: tuple[TransmissionTag, ...] = ()
    ros2_controls: tuple[Ros2ControlTag, ...] = ()
    source_format: Literal["urdf", "sdf"] = "sdf"
    file: Path | None = None
    span: SourceSpan | None = None
    _links: dict[str, Link] | None = field(default=None, init=False, repr=False, compare=False)
    _joints: dict[str, Joint] | None = field(default=None, init=False, repr=False, compare=False)

    def link(self, name: str) -> Link | None:
        """Return the link of this name, the first of several, or None."""
        if self._links is None:
            object.__setattr__(self, "_links", {link.name: link for link in self.links[::-1]})
        return None if self._links is None else self._links.get(name)

    def joint(self, name: str) -> Joint | None:
        """Return the joint of this name, the first of several, or None."""
        if self._joints is None:
            found = {joint.name: joint for joint in self.joints[::-1]}
            object.__setattr__(self, "_joints", found)
        return None if self._joints is None else self._joints.get(name)


@dataclass(frozen=True, slots=True)
class Physics:
    """SDF ``<physics>``; the ODE words are kept for ``get_physics_properties``.

    Attributes:
        engine: ``ode``, ``bullet``, ``dart`` or ``simbody``: a word only, MuJoCo does the work.
        max_step_size_s: step of simulated time.
        real_time_factor: wanted ratio of simulated to real time, 0 or less for unlimited.
        real_time_update_rate_hz: steps wanted per real second, 0 for as fast as possible.
    """

    name: str = "default_physics"
    engine: str = "ode"
    max_step_size_s: float = 0.001
    real_time_factor: float = 1.0
    real_time_update_rate_hz: float = 1000.0
    max_contacts: int = 20
    solver_type: str = "quick"
    solver_iters: int = 50
    solver_precon_iters: int = 0
    solver_sor: float = 1.3
    solver_rms_error_tol: float = 0.0
    cfm: float = 0.0
    erp: float = 0.2
    contact_max_correcting_vel_m_s: float = 100.0
    contact_surface_layer_m: float = 0.001
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class Scene:
    """SDF ``<scene>``: `fog` as written is ignored with a notice.

    Attributes:
        T_world_view: where ``<gui>`` has the window's camera, which looks along +x, z up.
    """

    ambient: Rgba = (0.4, 0.4, 0.4, 1.0)
    background: Rgba = (0.7, 0.7, 0.7, 1.0)
    sky: bool = False
    shadows: bool = True
    grid: bool = True
    T_world_view: Pose | None = None
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class SphericalCoordinates:
    """Where the world's origin lies on Earth, degrees and metres."""

    latitude_deg: float = 0.0
    longitude_deg: float = 0.0
    elevation_m: float = 0.0
    heading_deg: float = 0.0


@shown_by("robots:world_bundle")
@dataclass(frozen=True, slots=True)
class World:
    """Everything there is.

    Attributes:
        gravity_m_s2: acceleration of free fall, world frame.
        magnetic_field_t: tesla, world frame.
        wind_m_s: linear velocity of the wind, world frame.
        joints: world-level joints (SDF 1.11) with ``model::link`` names.
        plugins: world plug-ins.
    """

    name: str = "default"
    models: tuple[Model, ...] = ()
    lights: tuple[Light, ...] = ()
    joints: tuple[Joint, ...] = ()
    frames: tuple[Frame, ...] = ()
    plugins: tuple[PluginTag, ...] = ()
    gravity_m_s2: Vector3 = (0.0, 0.0, -9.8)
    magnetic_field_t: Vector3 = (5.5645e-6, 22.8758e-6, -42.3884e-6)
    wind_m_s: Vector3 = (0.0, 0.0, 0.0)
    physics: Physics = field(default_factory=Physics)
    scene: Scene = field(default_factory=Scene)
    spherical_coordinates: SphericalCoordinates | None = None
    file: Path | None = None
    span: SourceSpan | None = None

    def model(self, name: str) -> Model | None:
        """Return the model of this name, or None."""
        return next((model for model in self.models if model.name == name), None)
