"""Real ROS 1 on its own wire: XMLRPC and TCPROS, with a master where none runs."""

from __future__ import annotations

from gazelle.bridge.ros1.addresses import Address, MasterAddress, master_address, own_address
from gazelle.bridge.ros1.bridge import Bridge

__all__ = ["Address", "Bridge", "MasterAddress", "master_address", "own_address"]
