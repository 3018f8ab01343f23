"""SDF ``<physics>`` and gravity."""

from __future__ import annotations

from gazelle.description.model import Physics
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import child_float, child_int, vector3_from
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean

__all__ = ["read_gravity", "read_physics"]

Vector3 = tuple[float, float, float]
_ENGINES = ("ode", "bullet", "simbody", "dart", "tpe", "ignored")
_TRUE = ("1", "true")
_DEFAULTS = Physics()
_GRAVITY: Vector3 = (0.0, 0.0, -9.8)


def chosen_physics(world: Tag) -> Tag | None:
    """Return the ``<physics>`` with ``default="true"``, the first one when none says so."""
    profiles = world.find_all("physics")
    marked = (tag for tag in profiles if tag.attributes.get("default", "").lower() in _TRUE)
    return next(marked, profiles[0] if profiles else None)


def read_gravity(world: Tag, context: ReadContext) -> Vector3:
    """Return gravity: a child of ``<world>`` since SDF 1.6, of ``<physics>`` before."""
    physics = chosen_physics(world)
    inner = physics.find("gravity") if physics is not None else None
    return vector3_from(world.find("gravity") or inner, _GRAVITY, context)


def read_physics(world: Tag, context: ReadContext) -> Physics:
    """Return a world's physics profile; the engine's name is kept as a word."""
    tag = chosen_physics(world)
    if tag is None:
        return _DEFAULTS
    engine = _engine(tag, context)
    settings = tag.find(engine) or tag
    solver, constraints = settings.find("solver") or tag, settings.find("constraints") or tag
    return Physics(
        name=tag.attributes.get("name", _DEFAULTS.name),
        engine=engine,
        max_step_size_s=_step_size(tag, context),
        real_time_factor=child_float(tag, "real_time_factor", 1.0, context),
        real_time_update_rate_hz=child_float(tag, "real_time_update_rate", 1000.0, context),
        max_contacts=child_int(tag, "max_contacts", _DEFAULTS.max_contacts, context),
        solver_type=solver.text_of("type", default=_DEFAULTS.solver_type),
        solver_iters=child_int(solver, "iters", _DEFAULTS.solver_iters, context),
        solver_precon_iters=child_int(solver, "precon_iters", 0, context),
        solver_sor=child_float(solver, "sor", _DEFAULTS.solver_sor, context),
        cfm=child_float(constraints, "cfm", _DEFAULTS.cfm, context),
        erp=child_float(constraints, "erp", _DEFAULTS.erp, context),
        contact_max_correcting_vel_m_s=child_float(
            constraints, "contact_max_correcting_vel", 100.0, context
        ),
        contact_surface_layer_m=child_float(constraints, "contact_surface_layer", 0.001, context),
        span=tag.span,
    )


def _engine(tag: Tag, context: ReadContext) -> str:
    word = tag.attributes.get("type", _DEFAULTS.engine).strip().lower()
    if word in _ENGINES:
        return word
    message = f"physics type '{word}' is not known; 'ode' is used"
    fix = did_you_mean(word, _ENGINES) or "write one of: " + ", ".join(_ENGINES)
    context.diagnostics.report("sdf.bad-value", message, tag.span, fix=fix)
    return _DEFAULTS.engine


def _step_size(tag: Tag, context: ReadContext) -> float:
    value = child_float(tag, "max_step_size", _DEFAULTS.max_step_size_s, context)
    if value > 0.0:
        return value
    place = tag.find("max_step_size") or tag
    message = f"<max_step_size> is {value:g} s; it must be positive, 0.001 is used"
    context.diagnostics.report("sdf.bad-value", message, place.span)
    return _DEFAULTS.max_step_size_s
