"""rospy, on Gazelle's graph."""

import sys as _sys

from std_msgs.msg import Header

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
    core,
    exceptions,
    log,
    names,
    rostime,
    timer,
)
from gazelle.compat.rospy.client import *  # noqa: F403
from gazelle.compat.rospy.core import parse_rosrpc_uri
from gazelle.compat.rospy.exceptions import *  # noqa: F403
from gazelle.compat.rospy.log import *  # noqa: F403
from gazelle.compat.rospy.rostime import *  # noqa: F403
from gazelle.compat.rospy.services import *  # noqa: F403
from gazelle.compat.rospy.timer import *  # noqa: F403
from gazelle.compat.rospy.topics import *  # noqa: F403

# Programs also reach for rospy's inner modules by name.
for _name, _module in {
    "client": client,
    "core": core,
    "exceptions": exceptions,
    "names": names,
    "rostime": rostime,
    "timer": timer,
}.items():
    _sys.modules[f"{__name__}.{_name}"] = _module

from rospy import msg, msproxy, service, topics  # noqa: E402 - they need the ones above
