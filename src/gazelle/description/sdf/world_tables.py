"""Elements of documents and worlds; the form is described in `gazelle.description.sdf.tables`."""

from __future__ import annotations

__all__ = ["WORLD_ROWS"]

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
