"""Topics of Gazebo Classic's own transport, which only ``gz topic`` shows: contacts."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from gazelle.description.model import ContactSpec
from gazelle.graph.gazebo_names import hidden_transport_name
from gazelle.simulator.plugins.bumper import transport_contacts_message
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.stream import publish_at, sensor_period
from gazelle.simulator.scheduler import ORDER_SENSOR

if TYPE_CHECKING:
    from gazelle.simulator.plugins.context import Resources
    from gazelle.simulator.world_server import WorldServer

__all__ = ["offer_world_contacts", "publish_contact_sensor"]

_TYPE = "ros_gz_interfaces/Contacts"
_EVERY_STEP = Fraction(1)


def offer_world_contacts(server: WorldServer, resources: Resources) -> None:
    """Publish all contacts of each step on ``~/physics/contacts``, while somebody listens."""
    engine = server.engine
    topic = hidden_transport_name("~/physics/contacts", engine.world.name)
    contacts = resources.publisher(topic, _TYPE)

    def publish() -> None:
        found = transport_contacts_message(engine, engine.contacts(), engine.time_ns, "world")
        contacts.publish(found)

    resources.task(topic, _EVERY_STEP, publish, order=ORDER_SENSOR, wanted=lambda: contacts.matched)


def publish_contact_sensor(context: PluginContext) -> None:
    """Publish a contact sensor's readings at its rate, and those of its filter in each step.

    The sensor has ``~/MODEL/LINK/SENSOR`` or its ``<topic>``, the filter ``…/contacts``.
    """
    place, host = context.place, context.host
    assert place is not None and isinstance(place.sensor.spec, ContactSpec)
    own = "~/" + place.name.replace("::", "/")
    world = host.engine.world.name

    def build(time_ns: int) -> Any:
        found = host.sensors.measurements.contacts(place).contacts
        return transport_contacts_message(host.engine, found, time_ns, place.name)

    for name, period in (
        (place.sensor.topic or own, sensor_period(context, place)),
        (f"{own}/contacts", _EVERY_STEP),
    ):
        publish_at(context, hidden_transport_name(name, world), _TYPE, period, build)
