"""The gz-sim system ``ApplyLinkWrench``: wrenches on any link of a world from topics."""

from __future__ import annotations

from typing import Any

from gazelle.description.xml import Tag
from gazelle.description.xml.numbers import floats_from
from gazelle.diagnostics import nearest_names
from gazelle.engine.link_handles import TimedWrench
from gazelle.geometry import Vector3
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.plugin_parameters import PluginTable

__all__ = ["TABLE", "load"]


_ZERO = (0.0, 0.0, 0.0)
# Of gz.msgs.Entity, and ros_gz_interfaces/Entity with it.
_MODEL = 2

TABLE = PluginTable(
    ParameterTable(
        "gz-sim apply link wrench",
        "Applies wrenches to links, for one step or until they are cleared.",
        (
            "gz-sim-apply-link-wrench-system",
            "ignition-gazebo-apply-link-wrench-system",
            "gz::sim::systems::ApplyLinkWrench",
            "ignition::gazebo::systems::ApplyLinkWrench",
        ),
        (
            Parameter("topic", "text", "/world/{world}/wrench", "wrenches for one step"),
            Parameter("topic_persistent", "text", "/world/{world}/wrench/persistent", "for ever"),
            Parameter("topic_clear", "text", "/world/{world}/wrench/clear", "ends those"),
            Parameter(
                "persistent", "group", "", "a wrench from the start: entity_name, entity_type…"
            ),
            Parameter("verbose", "refused", "", "Gazebo's logging"),
        ),
    ),
    topics=(
        Topic("{topic}", "ros_gz_interfaces/msg/EntityWrench", kind="listens"),
        Topic("{topic_persistent}", "ros_gz_interfaces/msg/EntityWrench", kind="listens"),
        Topic("{topic_clear}", "ros_gz_interfaces/msg/Entity", kind="listens"),
    ),
    behaviour=(
        "Wrenches are in the world's frame and act at the centre of mass of the link, or of a"
        " model's canonical link.",
        "Topics keep their gz names and carry the ROS types that `ros_gz_bridge` maps them to.",
    ),
)


def load(context: PluginContext) -> None:
    """Start listening, and apply the wrenches the file names."""
    parameters = context.reader(TABLE)
    system = _Wrenches(context)
    world = context.host.engine.world.name
    for key, kind, take in (
        ("topic", "EntityWrench", system.push),
        ("topic_persistent", "EntityWrench", system.hold),
        ("topic_clear", "Entity", system.clear),
    ):
        topic = join_names("/", parameters.text(key).replace("{world}", world))
        context.resources.subscription(topic, f"ros_gz_interfaces/{kind}", take)
    parameters.texts("persistent")
    system.hold_all(context.plugin.parameters.children)
    context.resources.on_reset(lambda: system.restart(context.plugin.parameters.children))
    parameters.report_unread()


class _Wrenches:
    """The wrenches one system applies."""

    def __init__(self, context: PluginContext) -> None:
        self._context = context
        self._engine = context.host.engine
        self._held: list[tuple[str, TimedWrench]] = []

    def push(self, message: Any) -> None:
        """Apply a wrench for one step."""
        link = self._link(message.entity)
        if link:
            force, torque = _wrench(message.wrench)
            self._engine.link(link).apply_wrench(force, torque, duration_ns=1)

    def hold(self, message: Any) -> None:
        """Apply a wrench until it is cleared."""
        self._hold(self._link(message.entity), *_wrench(message.wrench))

    def clear(self, message: Any) -> None:
        """End all held wrenches on an entity."""
        link = self._link(message)
        for name, acting in self._held:
            if name == link:
                self._engine.end_wrench(acting)
        self._held = [item for item in self._held if item[0] != link]

    def hold_all(self, tags: tuple[Tag, ...]) -> None:
        """Apply the ``<persistent>`` wrenches of the file."""
        for tag in tags:
            if tag.name == "persistent":
                is_model = tag.text_of("entity_type") == "model"
                name = self._named(tag.text_of("entity_name"), is_model=is_model)
                self._hold(name, self._vector(tag, "force"), self._vector(tag, "torque"))

    def restart(self, tags: tuple[Tag, ...]) -> None:
        """Begin anew after a reset, which has ended all wrenches."""
        self._held.clear()
        self.hold_all(tags)

    def _hold(self, link: str, force: Vector3, torque: Vector3) -> None:
        if link:
            self._held.append((link, self._engine.link(link).apply_wrench(force, torque)))

    def _link(self, entity: Any) -> str:
        return self._named(str(entity.name), is_model=int(entity.type) == _MODEL)

    def _named(self, name: str, *, is_model: bool) -> str:
        """Return ``model::link`` of a name; reports one that is not there and returns nothing."""
        world = self._engine.world
        if is_model:
            model = world.model(name)
            if model is not None and model.links:
                return f"{name}::{model.canonical_link or model.links[0].name}"
            known = [item.name for item in world.models]
        else:
            known = list(self._engine.link_names)
            if name in known:
                return name
        near = ", ".join(nearest_names(name, known))
        what = "model" if is_model else "link"
        self._context.report(
            "plugin.missing-link",
            f"plug-in '{self._context.plugin.name}': there is no {what} '{name}'; no wrench acts",
            fix=f"did you mean {near}?" if near else "",
        )
        return ""

    def _vector(self, tag: Tag, name: str) -> Vector3:
        child = tag.find(name)
        if child is None:
            return _ZERO
        x, y, z = floats_from(
            child.text,
            3,
            _ZERO,
            what=f"<{name}>",
            span=child.span,
            diagnostics=self._context.host.diagnostics,
        )
        return (x, y, z)


def _wrench(message: Any) -> tuple[Vector3, Vector3]:
    force, torque = message.force, message.torque
    return (
        (float(force.x), float(force.y), float(force.z)),
        (float(torque.x), float(torque.y), float(torque.z)),
    )
