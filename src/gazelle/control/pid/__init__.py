"""``control_toolbox::Pid``: gains, the law, arrays of them, reading them, changing them live."""

from __future__ import annotations

from gazelle.control.pid.gains import AntiWindup, PidGains, read_gains
from gazelle.control.pid.pid import Pid
from gazelle.control.pid.pid_array import PidArray
from gazelle.control.pid.pid_ros import PidStatePort, offer_live_gains

__all__ = [
    "AntiWindup",
    "Pid",
    "PidArray",
    "PidGains",
    "PidStatePort",
    "offer_live_gains",
    "read_gains",
]
