"""Contact sensors: ``libgazebo_ros_bumper`` of ROS 1 and ROS 2, and Gazebo's own contact topics."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.description.model import ContactSpec
from gazelle.graph.gazebo_names import hidden_transport_name
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import vector_message
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, SensorPlace
from gazelle.simulator.plugins.plugin_parameters import PluginTable
from gazelle.simulator.plugins.sensor_publisher import (
    prefixed_frame,
    publish_at,
    sensor_period,
    sensor_place,
)
from gazelle.simulator.scheduler import ORDER_SENSOR

if TYPE_CHECKING:
    from gazelle.engine import Contact, Engine
    from gazelle.simulator.plugins.context import Resources
    from gazelle.simulator.world_server import WorldServer

__all__ = ["TABLE", "gz_contacts_message", "load", "offer_world_contacts", "publish_contact_sensor"]

# On the first and on the second body, a pair for each point.
Wrenches = list[tuple[Any, Any]]
_TRANSPORT_TYPE = "ros_gz_interfaces/Contacts"
_EVERY_STEP = Fraction(1)

TABLE = PluginTable(
    ParameterTable(
        "bumper",
        "Publishes what touches the collisions that the contact sensor around it watches.",
        ("gazebo_ros_bumper",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic", ros_versions=(1,)),
            Parameter(
                "bumperTopicName", "text", "bumper_states", "topic (ROS 1)", ros_versions=(1,)
            ),
            Parameter(
                "frameName",
                "text",
                "world",
                "`header.frame_id` and nothing else",
                "",
                aliases=("frame_name",),
            ),
            Parameter("alwaysOn", "refused", "", "contacts are read while somebody subscribes"),
            Parameter("updateRate", "refused", "", "the sensor's rate governs"),
        ),
    ),
    topics=(
        Topic(
            "{bumperTopicName}",
            "gazebo_msgs/msg/ContactsState",
            rate="sensor's `update_rate`",
            frame="`frameName`",
            ros2="bumper_states",
        ),
    ),
    behaviour=(
        "Every reading is published, with no states when nothing touches. There is one state per"
        " pair of collisions, the watched one first.",
        "As in Gazebo, positions and normals are in the world frame whatever `frameName` says; the"
        " wrenches act on the watched link, in its own axes and about its centre of mass.",
    ),
    in_both_ros=True,
)


def load(context: PluginContext) -> None:
    """Start publishing the contacts of the sensor the plug-in stands in."""
    parameters = context.reader(TABLE)
    place = sensor_place(context, ContactSpec, "a contact sensor")
    if place is not None:
        ros2 = parameters.is_ros2()
        name = "bumper_states" if ros2 else parameters.text("bumperTopicName")
        frame = parameters.text("frameName")
        frame = frame if ros2 else prefixed_frame(context, parameters, "frameName")
        publish_at(
            context,
            context.topic(parameters, name),
            "gazebo_msgs/ContactsState",
            sensor_period(context, place),
            lambda time_ns: _message(context, place, frame, time_ns),
        )
    parameters.report_unread()


def offer_world_contacts(server: WorldServer, resources: Resources) -> None:
    """Publish all contacts of each step on ``~/physics/contacts``, while somebody listens."""
    engine = server.engine
    topic = hidden_transport_name("~/physics/contacts", engine.world.name)
    contacts = resources.publisher(topic, _TRANSPORT_TYPE)

    def publish() -> None:
        found = _transport_contacts_message(engine, engine.contacts(), engine.time_ns, "world")
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
        return _transport_contacts_message(host.engine, found, time_ns, place.name)

    for name, period in (
        (place.sensor.topic or own, sensor_period(context, place)),
        (f"{own}/contacts", _EVERY_STEP),
    ):
        publish_at(context, hidden_transport_name(name, world), _TRANSPORT_TYPE, period, build)


def _message(context: PluginContext, place: SensorPlace, frame: str, time_ns: int) -> Any:
    contacts = context.host.sensors.measurements.contacts(place).contacts
    return message_type("gazebo_msgs/ContactsState")(
        header=header(time_ns, frame),
        states=[
            _state(context, contact, f"{number}/{len(contacts)}", time_ns)
            for number, contact in enumerate(contacts)
        ],
    )


def _state(context: PluginContext, contact: Contact, count: str, time_ns: int) -> Any:
    from gazelle.sensors import link_wrenches

    link = context.host.engine.link(contact.collision1.rsplit("::", 1)[0])
    forces, torques = link_wrenches(contact, link.T_world_link(), link.com_world())
    seconds, rest = divmod(time_ns, 1_000_000_000)
    info = f"Debug:  i:({count})     my geom:{contact.collision1}   other geom:"
    info += f"{contact.collision2}         time:{seconds}.{rest:09d}\n"
    return message_type("gazebo_msgs/ContactState")(
        info=info,
        collision1_name=contact.collision1,
        collision2_name=contact.collision2,
        wrenches=[_wrench(f, t) for f, t in zip(forces, torques, strict=True)],
        total_wrench=_wrench(forces.sum(axis=0), torques.sum(axis=0)),
        contact_positions=[vector_message(point) for point in contact.points_m],
        contact_normals=[vector_message(normal) for normal in contact.normals],
        depths=contact.depths_m,
    )


def gz_contacts_message(context: PluginContext, place: SensorPlace, time_ns: int) -> Any:
    """Return ``ros_gz_interfaces/Contacts`` of a gz contact sensor; None when nothing touches.

    Forces are in the world frame there.
    """
    contacts = context.host.sensors.measurements.contacts(place).contacts
    if not contacts:
        return None
    zero = np.zeros(3)

    def wrenches(contact: Contact) -> Wrenches:
        return [(_wrench(force, zero), _wrench(-force, zero)) for force in contact.forces_n]

    frame = place.sensor.frame_id or place.name.replace("::", "/")
    return _contacts(contacts, time_ns, frame, wrenches)


def _transport_contacts_message(
    engine: Engine, contacts: Iterable[Contact], time_ns: int, frame: str
) -> Any:
    """Return contacts as Gazebo Classic tells them on its own topics.

    Each wrench acts on its link, in the link's own axes and about its centre of mass.
    """

    def side(contact: Contact, name: str) -> list[Any]:
        from gazelle.sensors import link_wrenches

        link = engine.link(name.rsplit("::", 1)[0])
        forces, torques = link_wrenches(contact, link.T_world_link(), link.com_world())
        return [_wrench(force, torque) for force, torque in zip(forces, torques, strict=True)]

    def wrenches(contact: Contact) -> Wrenches:
        back = replace(contact, forces_n=-contact.forces_n, torques_nm=-contact.torques_nm)
        first, second = side(contact, contact.collision1), side(back, contact.collision2)
        return list(zip(first, second, strict=True))

    return _contacts(contacts, time_ns, frame, wrenches)


def _contacts(
    contacts: Iterable[Contact],
    time_ns: int,
    frame: str,
    wrenches: Callable[[Contact], Wrenches],
) -> Any:
    return message_type("ros_gz_interfaces/Contacts")(
        header=header(time_ns, frame),
        contacts=[_contact(contact, time_ns, wrenches(contact)) for contact in contacts],
    )


def _contact(contact: Contact, time_ns: int, wrenches: Wrenches) -> Any:
    entity: Any = message_type("ros_gz_interfaces/Entity")
    joint_wrench = message_type("ros_gz_interfaces/JointWrench")
    text, collision = message_type("std_msgs/String"), entity.COLLISION
    bodies = [name.rsplit("::", 1)[0] for name in (contact.collision1, contact.collision2)]
    return message_type("ros_gz_interfaces/Contact")(
        collision1=entity(name=contact.collision1, type=collision),
        collision2=entity(name=contact.collision2, type=collision),
        positions=[vector_message(point) for point in contact.points_m],
        normals=[vector_message(normal) for normal in contact.normals],
        depths=contact.depths_m,
        wrenches=[
            joint_wrench(
                header=header(time_ns, ""),
                body_1_name=text(data=bodies[0]),
                body_2_name=text(data=bodies[1]),
                body_1_wrench=first,
                body_2_wrench=second,
            )
            for first, second in wrenches
        ],
    )


def _wrench(force: Any, torque: Any) -> Any:
    return message_type("geometry_msgs/Wrench")(
        force=vector_message(force), torque=vector_message(torque)
    )
