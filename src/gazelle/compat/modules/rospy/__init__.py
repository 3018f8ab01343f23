"""rospy, on Gazelle's graph."""

import sys as _sys

from gazelle.compat.rospy import *  # noqa: F403
from gazelle.compat.rospy import (
    DEBUG,
    ERROR,
    FATAL,
    INFO,
    WARN,
    AnyMsg,
    Message,
    client,
    errors,
    log,
    rostime,
    services,
    topics,
)
from gazelle.compat.rospy.client import *  # noqa: F403
from gazelle.compat.rospy.errors import *  # noqa: F403
from gazelle.compat.rospy.log import *  # noqa: F403
from gazelle.compat.rospy.rostime import *  # noqa: F403
from gazelle.compat.rospy.services import *  # noqa: F403
from gazelle.compat.rospy.topics import *  # noqa: F403

# Programs also reach for rospy's inner modules by name.
exceptions, core, names, msg, timer = errors, client, client, topics, rostime
for _name, _module in {
    "client": client,
    "core": client,
    "exceptions": errors,
    "msg": topics,
    "names": client,
    "rostime": rostime,
    "service": services,
    "timer": rostime,
    "topics": topics,
}.items():
    _sys.modules[f"{__name__}.{_name}"] = _module
topics.AnyMsg = AnyMsg
