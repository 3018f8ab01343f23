"""What sdformat finds wrong with visuals, collisions, sensors, lights, joints' axes and physics."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf_command.console import Code, SdfError
from gazelle.description.sdformat_emulation.gz_sdf_command.values import number_of

__all__ = [
    "check_atmosphere",
    "check_axis",
    "check_inertial",
    "check_light",
    "check_link_parts",
    "check_name",
    "check_sensors",
    "check_spherical_coordinates",
    "check_unique",
    "is_reserved",
]

Check = Callable[[SdfElement, list[SdfError]], None]

_SENSORS = frozenset(
    {
        "air_pressure",
        "altimeter",
        "boundingbox",
        "boundingbox_camera",
        "camera",
        "contact",
        "custom",
        "depth",
        "depth_camera",
        "force_torque",
        "gps",
        "gpu_lidar",
        "gpu_ray",
        "imu",
        "lidar",
        "logical_camera",
        "magnetometer",
        "multicamera",
        "navsat",
        "ray",
        "rfid",
        "rfidtag",
        "rgbd",
        "rgbd_camera",
        "segmentation",
        "segmentation_camera",
        "sonar",
        "thermal",
        "thermal_camera",
        "wide_angle_camera",
        "wideanglecamera",
        "wireless_receiver",
        "wireless_transmitter",
    }
)
_LIGHTS = ("point", "spot", "directional")
_EMITTERS = ("point", "box", "cylinder", "ellipsoid")
_NORMAL_MAPS = (
    "normal_map_objectspace",
    "normal_map_object_space",
    "normal_map_tangentspace",
    "normal_map_tangent_space",
)
_SHADERS = ("pixel", "vertex", *_NORMAL_MAPS)
_UNSET = ("", "__default__")
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_NO_PRODUCT = 1e-6
_MOMENT_TOLERANCE = 10 * float(np.finfo(float).eps)


def is_reserved(name: str) -> bool:
    """Tell whether a name is sdformat's own: ``world`` and ``__anything__``."""
    return name == "world" or (len(name) >= 4 and name[:2] == "__" and name[-2:] == "__")


def check_name(element: SdfElement, kind: str, errors: list[SdfError]) -> None:
    """Report a reserved name."""
    name = element.attributes.get("name", "")
    if is_reserved(name):
        message = f"The supplied {kind} name [{name}] is reserved."
        errors.append(SdfError(Code.RESERVED_NAME, message))


def check_unique(
    parent: SdfElement, name: str, check: Check, errors: list[SdfError]
) -> list[SdfElement]:
    """Check all children of a name and return them, of equal names the first."""
    kept: dict[str, SdfElement] = {}
    for child in parent.find_all(name):
        label = child.attributes.get("name", "__default__")
        if label in kept:
            message = f"{name} with name[{label}] already exists."
            errors.append(SdfError(Code.DUPLICATE_NAME, message))
        else:
            kept[label] = child
        check(child, errors)
    return list(kept.values())


def check_link_parts(link: SdfElement, errors: list[SdfError]) -> None:
    """Report what is wrong with what a link carries, in sdformat's order."""
    check_unique(link, "visual", _check_visual, errors)
    check_unique(link, "collision", _check_collision, errors)
    check_unique(link, "light", check_light, errors)
    check_sensors(link, errors)
    check_unique(link, "particle_emitter", _check_emitter, errors)


def check_sensors(parent: SdfElement, errors: list[SdfError]) -> None:
    """Report what is wrong with the sensors of a link or joint."""
    check_unique(parent, "sensor", _check_sensor, errors)


def check_light(light: SdfElement, errors: list[SdfError]) -> None:
    """Report an unknown type and a reserved name."""
    kind = light.attributes.get("type", "point")
    if kind not in _LIGHTS:
        message = f"Invalid light type with a value of [{kind}]."
        errors.append(SdfError(Code.ATTRIBUTE_INVALID, message))
    check_name(light, "light", errors)


def check_axis(axis: SdfElement, errors: list[SdfError]) -> None:
    """Report an axis without direction."""
    xyz = axis.find("xyz")
    if xyz is not None and not any(map(number_of, xyz.text.split()[:3])):
        message = "The norm of the xyz vector cannot be zero"
        errors.append(SdfError(Code.ELEMENT_INVALID, message))


def check_atmosphere(atmosphere: SdfElement, errors: list[SdfError]) -> None:
    """Report an unknown type."""
    kind = atmosphere.attributes.get("type", "adiabatic")
    if kind != "adiabatic":
        message = f"Unknown atmosphere type of {kind}, defaulting to adiabatic"
        errors.append(SdfError(Code.ELEMENT_INVALID, message))


def check_spherical_coordinates(location: SdfElement, errors: list[SdfError]) -> None:
    """Report what a position on Earth lacks, and words that are not known."""
    for name, known in (("surface_model", "EARTH_WGS84"), ("world_frame_orientation", "ENU")):
        found = location.find(name)
        if found is None:
            if name == "surface_model":
                message = f"Missing required element <{name}>"
                errors.append(SdfError(Code.ELEMENT_MISSING, message))
        elif found.text != known and not (name != "surface_model" and found.text in ("NED", "NWU")):
            message = f"The supplied <{name}> [{found.text}] is not supported."
            errors.append(SdfError(Code.ELEMENT_INVALID, message))
    for name in ("latitude_deg", "longitude_deg"):
        if location.find(name) is None:
            message = f"Missing required element <{name}>"
            errors.append(SdfError(Code.ELEMENT_MISSING, message))


def check_inertial(link: SdfElement, errors: list[SdfError]) -> None:
    """Report a mass or moments that no body can have."""
    inertial = link.find("inertial")
    if inertial is None:
        return
    found = inertial.find("mass")
    mass = number_of(found.text) if found is not None else 1.0
    if mass < 0 or not _is_possible(_moments(inertial.find("inertia"))):
        message = f"A link named {link.attributes['name']} has invalid inertia."
        errors.append(SdfError(Code.LINK_INERTIA_INVALID, message))


def _moments(inertia: SdfElement | None) -> dict[str, float]:
    values = {name: float(name[1] == name[2]) for name in _MOMENTS}
    for child in inertia.children if inertia is not None else ():
        if child.name in values:
            values[child.name] = number_of(child.text)
    return values


def _is_possible(moment: dict[str, float]) -> bool:
    """Tell whether moments are those of a body, as Ignition Math does: triangle inequality."""
    xx, xy, xz = moment["ixx"], moment["ixy"], moment["ixz"]
    yy, yz, zz = moment["iyy"], moment["iyz"], moment["izz"]
    matrix = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    slack = _MOMENT_TOLERANCE * abs(xx + yy + zz) / 2
    if xx + slack < 0 or xx * yy - xy**2 + slack < 0 or np.linalg.det(matrix) + slack < 0:
        return False
    # Small products count as none, so that a box's moments stay exact.
    products = max(abs(xy), abs(xz), abs(yz))
    if products <= _NO_PRODUCT * max(xx, yy, zz):
        principal = np.sort([xx, yy, zz])
    else:
        principal = np.linalg.eigvalsh(matrix)
    return bool(principal[0] + slack >= 0 and principal[0] + principal[1] + slack >= principal[2])


def _check_visual(visual: SdfElement, errors: list[SdfError]) -> None:
    check_name(visual, "visual", errors)
    material = visual.find("material")
    if material is not None:
        _check_material(material, errors)
    _check_mesh(visual, errors)


def _check_collision(collision: SdfElement, errors: list[SdfError]) -> None:
    check_name(collision, "collision", errors)
    _check_mesh(collision, errors)


def _check_material(material: SdfElement, errors: list[SdfError]) -> None:
    script = material.find("script")
    if script is not None:
        _check_script(script, errors)
    shader = material.find("shader")
    if shader is not None:
        _check_shader(shader, errors)


def _check_shader(shader: SdfElement, errors: list[SdfError]) -> None:
    kind = shader.attributes.get("type", "pixel")
    if kind not in _SHADERS:
        message = f"The value[{kind}] for a <shader><type> element is not supported"
        errors.append(SdfError(Code.ELEMENT_INVALID, message))
    normal_map = shader.find("normal_map")
    if kind in _NORMAL_MAPS and (normal_map is None or normal_map.text in _UNSET):
        message = "A normal map shader type has been specified, but a normal_map has not."
        errors.append(SdfError(Code.ELEMENT_MISSING, message))


def _check_script(script: SdfElement, errors: list[SdfError]) -> None:
    for name, code in (("uri", Code.ELEMENT_INVALID), ("name", Code.ELEMENT_MISSING)):
        found = script.find(name)
        if found is None or found.text in _UNSET:
            message = (
                f"A <script> element is missing a child <{name}> element, or the <{name}> element "
                "is empty."
            )
            errors.append(SdfError(code, message))


def _check_mesh(part: SdfElement, errors: list[SdfError]) -> None:
    geometry = part.find("geometry")
    mesh = geometry.find("mesh") if geometry is not None else None
    submesh = mesh.find("submesh") if mesh is not None else None
    name = submesh.find("name") if submesh is not None else None
    if submesh is not None and (name is None or name.text in _UNSET):
        message = (
            "A <submesh> element is missing a child <name> element, or the <name> element is empty."
        )
        errors.append(SdfError(Code.ELEMENT_MISSING, message))


def _check_sensor(sensor: SdfElement, errors: list[SdfError]) -> None:
    check_name(sensor, "sensor", errors)
    if sensor.attributes.get("type") not in _SENSORS:
        message = "Attempting to load a Sensor, but the provided sensor type is missing or invalid."
        errors.append(SdfError(Code.ATTRIBUTE_INVALID, message))


def _check_emitter(emitter: SdfElement, errors: list[SdfError]) -> None:
    check_name(emitter, "particle emitter", errors)
    if emitter.attributes.get("type", "point") not in _EMITTERS:
        message = (
            "Attempting to load a particle emitter, but the provided particle emitter type is "
            "missing or invalid."
        )
        errors.append(SdfError(Code.ATTRIBUTE_INVALID, message))
