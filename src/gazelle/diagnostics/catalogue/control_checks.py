"""Codes of the control layer: what is found before the first step."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "control.names-disagree",
        "warning",
        "Robot, hardware, controllers and MoveIt do not mean the same joints",
        "A joint's name must be the same in the URDF, in its transmission or <ros2_control> block,"
        " in the controllers' parameters and in MoveIt's list. The table shows every name that is"
        " missing somewhere.",
        "use one name everywhere",
        "Could not find resource in hardware_interface, or: Joint not found in controller",
    ),
    Entry(
        "control.unstable-gains",
        "warning",
        "Gains are unstable with the joint's inertia and the period of control",
        "An effort that is computed at intervals overshoots when the gains are large for the"
        " inertia it moves. The check looks at the joint's own inertia in the present pose.",
        "use smaller gains, a shorter step, or a joint damping",
        "robot shakes, jitters or explodes when the controller starts",
    ),
    Entry(
        "control.zero-limit",
        "warning",
        "A joint that is controlled has a limit of 0",
        'Exporters write effort="0" velocity="0". Gazebo takes that at its word: efforts are'
        " cut to 0, and joint limits hold the joint.",
        "write the motor's real limits",
        "effort limit 0, joint does not move",
    ),
)
