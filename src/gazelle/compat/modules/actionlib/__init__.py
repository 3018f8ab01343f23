"""actionlib, on Gazelle's graph."""

import sys as _sys

from gazelle.compat.actionlib import *  # noqa: F403
from gazelle.compat.actionlib import client as _client
from gazelle.compat.actionlib import goals as _goals
from gazelle.compat.actionlib import server as _server
from gazelle.compat.actionlib import simple_client as _simple_client
from gazelle.compat.actionlib import simple_server as _simple_server

# Programs also import from actionlib's inner modules.
for _name, _module in {
    "action_client": _client,
    "action_server": _server,
    "exceptions": _goals,
    "goal_id_generator": _goals,
    "server_goal_handle": _server,
    "simple_action_client": _simple_client,
    "simple_action_server": _simple_server,
}.items():
    _sys.modules[f"{__name__}.{_name}"] = globals()[_name] = _module
