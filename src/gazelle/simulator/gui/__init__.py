"""What viewers are told of a running world, and what they may do to it.

Gazebo has a transport of its own beside ROS for this; here it is hidden topics and one service
below ``/_gazelle``, whose form is in ``docs/studio_protocol.md``.
"""

from gazelle.simulator.gui.scene_broadcaster import offer_views

__all__ = ["offer_views"]
