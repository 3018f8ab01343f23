"""Which elements and attributes SDF 1.4 to 1.12 know, per parent, as data.

Unknown ones in a document are reported, and known ones without effect.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import NamedTuple

from gazelle.description.model import SOLIDS
from gazelle.description.read_context import ReadContext
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean

__all__ = ["ELEMENTS", "SENSOR_ROWS", "WORLD_ROWS", "Element", "check_elements", "report_plugin_of"]

_XYZ = "x=axis_noise y=axis_noise z=axis_noise"
SENSOR_ROWS: dict[str, tuple[str, str]] = {
    "sensor": (
        "name type",
        "pose update_rate always_on visualize topic gz_frame_id ignition_frame_id "
        "enable_metrics! plugin camera ray lidar=ray imu contact=sensor/contact force_torque gps "
        "navsat=gps magnetometer altimeter air_pressure air_speed! sonar logical_camera "
        "rfid! rfidtag! transceiver!",
    ),
    "camera": (
        "name",
        "pose horizontal_fov image=camera/image clip noise distortion lens depth_camera "
        "optical_frame_id camera_info_topic visibility_mask trigger_topic! save! triggered! "
        "segmentation_type! box_type! anti_aliasing!",
    ),
    "camera/image": ("", "width height format anti_aliasing!"),
    "clip": ("", "near far"),
    "depth_camera": ("", "clip output!"),
    "distortion": ("", "k1 k2 k3 p1 p2 center"),
    "lens": (
        "",
        "intrinsics projection! type! scale_to_hfov! custom_function! cutoff_angle! "
        "env_texture_size!",
    ),
    "intrinsics": ("", "fx fy cx cy s"),
    "noise": (
        "type",
        "type mean stddev bias_mean bias_stddev dynamic_bias_stddev dynamic_bias_correlation_time "
        "precision",
    ),
    "axis_noise": ("", "noise"),
    "ray": ("", "scan range noise visibility_mask!"),
    "scan": ("", "horizontal=scan/line vertical=scan/line"),
    "scan/line": ("", "samples resolution min_angle max_angle"),
    "range": ("", "min max resolution"),
    "imu": (
        "",
        "topic angular_velocity linear_acceleration orientation_reference_frame "
        "enable_orientation noise=imu/noise",
    ),
    "imu/noise": ("", "type rate=noise accel=noise"),
    "angular_velocity": ("", _XYZ),
    "linear_acceleration": ("", _XYZ),
    "orientation_reference_frame": ("", "localization custom_rpy grav_dir_x!"),
    "sensor/contact": ("", "collision=value topic"),
    "force_torque": ("", "frame=value measure_direction force torque"),
    "value": ("", ""),
    "force": ("", _XYZ),
    "torque": ("", _XYZ),
    "gps": ("", "position_sensing velocity_sensing topic"),
    "position_sensing": ("", "horizontal=axis_noise vertical=axis_noise"),
    "velocity_sensing": ("", "horizontal=axis_noise vertical=axis_noise"),
    "magnetometer": ("", _XYZ),
    "altimeter": ("", "vertical_position=axis_noise vertical_velocity=axis_noise"),
    "air_pressure": ("", "reference_altitude pressure=axis_noise"),
    "sonar": ("", "geometry=value min max radius"),
    "logical_camera": ("", "near far horizontal_fov aspect_ratio"),
}
WORLD_ROWS: dict[str, tuple[str, str]] = {
    "sdf": ("version", "world model light actor include"),
    "world": (
        "name",
        "physics gravity magnetic_field wind atmosphere! scene light model include actor plugin "
        "population frame joint state gui spherical_coordinates audio! road!",
    ),
    # Actors are reported as a whole where worlds are read.
    "actor": ("*", ""),
    "physics": (
        "name default type",
        "max_step_size real_time_factor real_time_update_rate max_contacts gravity "
        "magnetic_field! ode=physics/ode bullet=physics/ode dart! simbody!",
    ),
    "physics/ode": ("", "solver constraints"),
    "solver": (
        "",
        "type iters precon_iters sor min_step_size! island_threads! thread_position_correction! "
        "use_dynamic_moi_rescaling! friction_model! world_step_solver!",
    ),
    "constraints": (
        "",
        "cfm erp contact_max_correcting_vel contact_surface_layer split_impulse! "
        "split_impulse_penetration_threshold!",
    ),
    "wind": ("", "linear_velocity"),
    "scene": (
        "",
        "ambient background sky shadows grid fog! origin_visual! shadow_caster_material_name!",
    ),
    "sky": (
        "",
        "time! sunrise! sunset! clouds! cubemap_uri! mood!",
    ),
    "spherical_coordinates": (
        "",
        "surface_model world_frame_orientation latitude_deg longitude_deg elevation heading_deg "
        "surface_axis_equatorial! surface_axis_polar!",
    ),
    "population": (
        "name",
        "pose model include model_count distribution box cylinder framework!",
    ),
    "distribution": ("", "type rows cols step"),
    # The window's camera is read, and so is that of a gz window's 3D view.
    "gui": ("fullscreen", "camera=gui/camera plugin!"),
    "gui/camera": ("name", "pose view_controller! projection_type! track_visual! plugin!"),
    # Read for poses; what else a saved state holds is told of where it is applied.
    "state": ("*", ""),
}
_Rows = dict[str, tuple[str, str]]
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
_ANY_ATTRIBUTE_PREFIXES = ("xmlns", "xsi:")
# Where people write plug-ins that are not loaded, why not, and what to do.
# What sdformat writes for a plug-in that has no file; Gazebo passes over it.
_NO_PLUGIN = "__default__"
_PLUGIN_PLACES = {
    "link": (
        "no Gazebo loads plug-ins of links",
        "move the <plugin> into the <model>, or into a <sensor> when it reads one",
    ),
    "visual": ("it would change what Gazebo's window shows", "nothing to do"),
}


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


def check_elements(root: Tag, context: ReadContext) -> None:
    """Report what SDF does not know below `root`, each name and place once.

    Args:
        root: an element that the table knows, such as ``<sdf>``, ``<model>`` or ``<sensor>``.
        context: receives ``xml.unknown-tag``, ``xml.unknown-attribute``, ``sdf.not-simulated``,
            ``sdf.plugin-not-loaded`` and ``sdf.extension``.
    """
    checker = _Checker()
    if root.name in ELEMENTS:
        checker.visit(root, root.name)
    checker.report(context)


def report_plugin_of(plugin: Tag, kind: str, context: ReadContext, again: str = "") -> None:
    """Report a plug-in of a link or visual, which no Gazebo loads or nobody here would see."""
    why, fix = _PLUGIN_PLACES[kind]
    name = plugin.attributes.get("filename", "")
    message = f"plug-in '{name}' in <{kind}> is not loaded: {why}{again}"
    context.diagnostics.report("sdf.plugin-not-loaded", message, plugin.span, fix=fix)


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


class _Key(NamedTuple):
    """What is wrong, with which kind of parent, and the name that is not known."""

    what: str
    kind: str
    parent: str
    name: str


class _Checker:
    """Collects by kind, parent and name, so that a hundred equal mistakes give one message."""

    def __init__(self) -> None:
        self._first: dict[_Key, Tag] = {}
        self._count: Counter[_Key] = Counter()

    def visit(self, tag: Tag, kind: str) -> None:
        """Look at an element of this kind and at everything below it."""
        element = ELEMENTS[kind]
        if element.free:
            return
        for name in tag.attributes:
            if name not in element.attributes and not name.startswith(_ANY_ATTRIBUTE_PREFIXES):
                what = "extension" if ":" in name else "unknown-attribute"
                self._note(_Key(what, kind, tag.name, name), tag)
        for child in tag.children:
            self._child(tag, kind, child)

    def _child(self, tag: Tag, kind: str, child: Tag) -> None:
        element = ELEMENTS[kind]
        if child.name in element.children:
            self.visit(child, element.children[child.name])
        elif child.name == "plugin" and _says_nothing(child, kind):
            return
        elif child.name == "plugin" and kind in _PLUGIN_PLACES:
            self._note(_Key("plugin", kind, tag.name, child.attributes.get("filename", "")), child)
        elif child.name in element.without_effect:
            self._note(_Key("not-simulated", kind, tag.name, child.name), child)
        else:
            what = "extension" if ":" in child.name else "unknown-tag"
            self._note(_Key(what, kind, tag.name, child.name), child)

    def _note(self, key: _Key, faulty_tag: Tag) -> None:
        self._first.setdefault(key, faulty_tag)
        self._count[key] += 1

    def report(self, context: ReadContext) -> None:
        """Report each finding at its first place, with the number of the others."""
        for key, faulty_tag in self._first.items():
            _report(key, self._count[key] - 1, faulty_tag, context)


def _says_nothing(plugin: Tag, kind: str) -> bool:
    """Tell whether a plug-in is not to be loaded, or only has the camera that is read."""
    if plugin.attributes.get("filename") == _NO_PLUGIN:
        return True
    return kind == "gui" and plugin.find("camera_pose") is not None


def _report(key: _Key, more: int, faulty_tag: Tag, context: ReadContext) -> None:
    name, parent, element = key.name, key.parent, ELEMENTS[key.kind]
    again = f" (and {more} more in this file)" if more else ""
    if key.what == "unknown-tag":
        message = f"<{name}> is not known inside <{parent}>; it has no effect{again}"
        fix = did_you_mean(name, element.names)
        context.diagnostics.report("xml.unknown-tag", message, faulty_tag.span, fix=fix)
    elif key.what == "unknown-attribute":
        message = f"attribute '{name}' is not known on <{parent}>; it has no effect{again}"
        fix = did_you_mean(name, element.attributes)
        context.diagnostics.report("xml.unknown-attribute", message, faulty_tag.span, fix=fix)
    elif key.what == "extension":
        message = f"'{name}' in <{parent}> belongs to a private extension; it has no effect{again}"
        context.diagnostics.report("sdf.extension", message, faulty_tag.span)
    elif key.what == "plugin":
        report_plugin_of(faulty_tag, key.kind, context, again)
    else:
        message = f"<{name}> in <{parent}> is legal and not simulated{again}"
        context.diagnostics.report("sdf.not-simulated", message, faulty_tag.span)


ELEMENTS = _elements({**_MODEL_ROWS, **SENSOR_ROWS, **WORLD_ROWS})
