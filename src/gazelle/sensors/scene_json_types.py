"""What a scene value is: the form of a world and of a robot for viewers elsewhere.

Metres, rad; poses are ``[x, y, z, qx, qy, qz, qw]``. Shapes are of one kind of geometry where
they are made, with files, and of another one on the page, with what it can load.
"""

from __future__ import annotations

from typing import Annotated, Any, Generic, Literal, NotRequired, TypedDict, TypeVar

__all__ = [
    "BodyValue",
    "BoxGeometry",
    "EllipsoidGeometry",
    "Floats2",
    "Floats3",
    "Floats7",
    "GeometryT",
    "HeightmapFile",
    "InertialValue",
    "JointValue",
    "LightValue",
    "MaterialValue",
    "MeshFile",
    "MimicValue",
    "ModelValue",
    "PlainGeometry",
    "PlaneGeometry",
    "PolylineOutlines",
    "RoundGeometry",
    "SceneValue",
    "SensorValue",
    "ShapeValue",
    "SphereGeometry",
    "TrianglesGeometry",
    "WorldGeometry",
]

Floats2 = Annotated[list[float], 2]
Floats3 = Annotated[list[float], 3]
Floats7 = Annotated[list[float], 7]
"""The number is how many there are."""


class MaterialValue(TypedDict):
    """How a surface looks; colours are r, g, b, a from 0 to 1.

    Attributes:
        texture: a file where it is made, a key on the page.
        texture_scale: how often the texture repeats.
    """

    name: NotRequired[str]
    diffuse: list[float]
    ambient: list[float]
    specular: list[float]
    emissive: list[float]
    shininess: float
    texture: str | None
    texture_scale: NotRequired[Floats2]


class BoxGeometry(TypedDict):
    """A box."""

    type: Literal["box"]
    size: Floats3


class SphereGeometry(TypedDict):
    """A ball."""

    type: Literal["sphere"]
    radius: float


class RoundGeometry(TypedDict):
    """What is round about z."""

    type: Literal["cylinder", "capsule", "cone"]
    radius: float
    length: float


class EllipsoidGeometry(TypedDict):
    """An ellipsoid."""

    type: Literal["ellipsoid"]
    radii: Floats3


class PlaneGeometry(TypedDict):
    """A plane, drawn so large."""

    type: Literal["plane"]
    normal: Floats3
    size: Floats2


class MeshFile(TypedDict):
    """A mesh as a file.

    Attributes:
        path: empty where it was not found.
    """

    type: Literal["mesh"]
    uri: str
    path: str
    scale: list[float]
    submesh: str
    center_submesh: bool


class HeightmapFile(TypedDict):
    """Terrain as a picture."""

    type: Literal["heightmap"]
    uri: str
    path: str
    size: Floats3
    position: Floats3


class PolylineOutlines(TypedDict):
    """Outlines that are drawn up to a height."""

    type: Literal["polyline"]
    outlines: list[list[list[float]]]
    height: float


class TrianglesGeometry(TypedDict):
    """The surface of a solid that has no word of its own here.

    Attributes:
        vertices: x, y, z in metres.
        faces: three places of vertices.
        normals: of the vertices.
    """

    type: Literal["triangles"]
    vertices: list[list[float]]
    faces: list[list[int]]
    normals: list[list[float]]


PlainGeometry = BoxGeometry | SphereGeometry | RoundGeometry | EllipsoidGeometry | PlaneGeometry
WorldGeometry = PlainGeometry | MeshFile | HeightmapFile | PolylineOutlines | TrianglesGeometry
"""Geometries as they are made."""

GeometryT = TypeVar("GeometryT")


class ShapeValue(TypedDict, Generic[GeometryT]):
    """A visual or a collision, at a pose in its body.

    Attributes:
        transparency: 0 to 1.
    """

    name: str
    pose: Floats7
    geometry: GeometryT
    material: MaterialValue | None
    cast_shadows: bool
    transparency: float


class InertialValue(TypedDict):
    """Mass and inertia.

    Attributes:
        pose: of the centre of mass.
        diagonal: ixx, iyy, izz.
        box: size of the box of equal mass and inertia; zeros where no box has them.
        box_pose: where that box is.
        estimated: of a link whose file gives none.
    """

    mass_kg: float
    pose: Floats7
    diagonal: Floats3
    box: Floats3
    box_pose: Floats7
    estimated: bool


class SensorValue(TypedDict):
    """A sensor, at a pose in its body.

    Attributes:
        fov_rad: of a camera: its full horizontal angle of view.
        lens: of a camera: where it is in the sensor's frame.
    """

    name: str
    type: str
    pose: Floats7
    rate_hz: float
    fov_rad: NotRequired[float]
    lens: NotRequired[Floats7]


class LightValue(TypedDict):
    """A light."""

    name: str
    type: str
    pose: Floats7
    direction: Floats3
    diffuse: list[float]
    specular: list[float]
    intensity: float
    range_m: float
    cast_shadows: bool
    spot_outer_angle_rad: float


class BodyValue(TypedDict, Generic[GeometryT]):
    """A link.

    Attributes:
        name: `model::link` in a world.
        model: its place among the models.
        pose: in the world; of a robot in its root link.
        frame: of a robot: the link's frame.
    """

    name: str
    model: int
    link: str
    pose: Floats7
    inertial: InertialValue | None
    visuals: list[ShapeValue[GeometryT]]
    collisions: list[ShapeValue[GeometryT]]
    sensors: list[SensorValue]
    lights: list[LightValue]
    frame: NotRequired[str]


class MimicValue(TypedDict):
    """A joint that follows another one."""

    joint: str
    multiplier: float
    offset: float


class JointValue(TypedDict):
    """A joint.

    Attributes:
        parent: place of the body; -1 for the world.
        child: place of the body.
        pose: in the child.
        lower: null where there is no limit.
    """

    name: str
    type: str
    parent: int
    child: int
    pose: Floats7
    axis: Floats3
    lower: float | None
    upper: float | None
    effort: float | None
    velocity: float | None
    mimic: MimicValue | None


class ModelValue(TypedDict):
    """A model.

    Attributes:
        bodies: their places.
        joints: their places.
    """

    name: str
    static: bool
    bodies: list[int]
    joints: list[int]
    pose: Floats7


class SceneValue(TypedDict, Generic[GeometryT]):
    """A world or a robot.

    Attributes:
        version: counts changes.
        view: where the world file has the window's camera: it looks along +x, z up.
        gravity: of a world, m/s².
        moving: of a running world: the joints that the stream `world.joints` tells of.
        findings: about a robot's text: `level`, `code` and `text` of each.
    """

    name: str
    version: int
    kind: Literal["world", "robot"]
    models: list[ModelValue]
    bodies: list[BodyValue[GeometryT]]
    joints: list[JointValue]
    lights: list[LightValue]
    sky: bool
    ambient: list[float]
    background: list[float]
    shadows: bool
    grid: bool
    view: Floats7 | None
    gravity: NotRequired[list[float]]
    moving: NotRequired[list[str]]
    findings: NotRequired[list[dict[str, Any]]]
