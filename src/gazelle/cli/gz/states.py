"""States of a world in a bag, as ``<state>`` elements of SDF.

Source of the elements: http://sdformat.org/spec?elem=state.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from fnmatch import fnmatchcase
from typing import Any, NamedTuple
from xml.sax.saxutils import quoteattr

from gazelle.bag import BagError, Encoding, bag_types, open_bag, ros1_name_of
from gazelle.bag.opening import tell_of_unindexed
from gazelle.cli.gz.options import GzError
from gazelle.cli.gz.world_link import pose_line
from gazelle.graph.gazebo_names import world_names
from gazelle.interfaces import from_cdr, from_ros1
from gazelle.interfaces.poses import pose_of

__all__ = ["LINK_STATES", "MODEL_STATES", "STATE_TOPICS", "Filter", "state_texts"]

MODEL_STATES = "/gazebo/model_states"
LINK_STATES = "/gazebo/link_states"
STATE_TOPICS = (MODEL_STATES, LINK_STATES)
_NS = 1_000_000_000


class Filter(NamedTuple):
    """Which models and links are shown, by names with ``*``."""

    model: str = "*"
    link: str = "*"

    @classmethod
    def read(cls, text: str) -> Filter:
        """Read ``MODEL`` or ``MODEL/LINK``; nothing is everything.

        Raises:
            GzError: there is more behind it.
        """
        model, _, link = text.partition("/")
        if "/" in link:
            raise GzError(f"--filter is MODEL or MODEL/LINK, not '{text}'")
        return cls(model or "*", link or "*")


class _Body(NamedTuple):
    pose: str
    velocity: str


def state_texts(file: str, wanted: Filter, rate_hz: float = 0.0) -> Iterator[str]:
    """Give the states of a bag one after the other, lazily.

    Args:
        file: the bag.
        wanted: which models and links are shown.
        rate_hz: at most so many a second, all of them for 0.

    Raises:
        GzError: it is no bag, or has no states.
    """
    try:
        bag = open_bag(file)
    except BagError as error:
        raise GzError(str(error)) from None
    tell_of_unindexed(bag)
    types = bag_types(bag.connections).store
    topics = {one.topic for one in bag.connections}
    if topics.isdisjoint(world_names(MODEL_STATES)):
        raise GzError(f"there is no {MODEL_STATES} in '{file}'; gz log -d 1 records such bags")
    links: dict[str, _Body] = {}
    next_ns = 0
    wanted_topics = {name for topic in STATE_TOPICS for name in world_names(topic)}
    for one, stamp_ns, data in bag.messages(lambda item: item.topic in wanted_topics):
        read = from_ros1 if one.encoding is Encoding.ROS1 else from_cdr
        bodies = _bodies(read(types.ros1_message_type(ros1_name_of(one)), data))
        if one.topic in world_names(LINK_STATES):
            links = bodies
        elif stamp_ns >= next_ns:
            next_ns = stamp_ns + int(_NS / rate_hz) if rate_hz > 0 else 0
            yield _state(stamp_ns, bodies, links, wanted)
    bag.close()


def _bodies(message: Any) -> dict[str, _Body]:
    rows = zip(message.name, message.pose, message.twist, strict=True)
    return {name: _Body(_pose(pose), _velocity(twist)) for name, pose, twist in rows}


def _state(
    stamp_ns: int, models: Mapping[str, _Body], links: Mapping[str, _Body], wanted: Filter
) -> str:
    seconds, rest_ns = divmod(stamp_ns, _NS)
    lines = ['<state world_name="default">', f"  <sim_time>{seconds} {rest_ns}</sim_time>"]
    for name, body in models.items():
        if fnmatchcase(name, wanted.model):
            lines += [f"  <model name={quoteattr(name)}>", f"    <pose>{body.pose}</pose>"]
            lines += _links(name, links, wanted)
            lines += ["  </model>"]
    return "\n".join([*lines, "</state>"])


def _links(model: str, links: Mapping[str, _Body], wanted: Filter) -> Iterable[str]:
    for scoped, body in links.items():
        owner, _, name = scoped.rpartition("::")
        if owner == model and fnmatchcase(name, wanted.link):
            yield f"    <link name={quoteattr(name)}>"
            yield f"      <pose>{body.pose}</pose>"
            yield f"      <velocity>{body.velocity}</velocity>"
            yield "    </link>"


def _pose(message: Any) -> str:
    pose = pose_of(message)
    return pose_line((*pose.position_m, *pose.rpy_rad))


def _velocity(twist: Any) -> str:
    parts = (twist.linear, twist.angular)
    return pose_line(tuple(float(getattr(part, axis)) for part in parts for axis in "xyz"))
