"""Codes of the doctor's probes: short runs of physics."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "probe.controller-sags",
        "warning",
        "A joint gives way under its controller",
        "The controller is to hold the joint and cannot: gains or effort limit are too small for "
        "the weight on it.",
        "raise the gains or the effort limit",
        "arm collapses when the simulation starts",
    ),
    Entry(
        "probe.controller-shakes",
        "warning",
        "A joint shakes under its controller",
        "Gains too large for the joint's inertia and the period of control make it oscillate.",
        "lower p or raise d",
        "robot shakes when the controller starts",
    ),
    Entry(
        "probe.controller-start",
        "error",
        "A configured controller cannot be started",
        "It was loaded and started as a spawner does it.",
        "correct the controller's parameters: its type, its joints and what the message names",
        "Failed to load controller; Could not start controller",
    ),
    Entry(
        "probe.diverged",
        "error",
        "The simulation diverges within seconds",
        "A position or speed became no finite number. Gazebo shows such a robot nowhere, or "
        "stops; the message names link and line.",
        "check mass, inertia, gains and overlapping collisions of the link named",
        'ODE INTERNAL ERROR 1: assertion "bNormalizationResult" failed',
    ),
    Entry(
        "probe.does-not-drive",
        "warning",
        "A robot does not move when it is told to",
        "Its wheels turn in the air, slip, have too little torque, or something holds them.",
        "look at the wheels' collisions, friction and torque",
        "wheels spin but robot does not move",
    ),
    Entry(
        "probe.drives-wrong",
        "warning",
        "A robot does not drive straight ahead when it is told to",
        "Positive speed about the wheels' axes drives it along -x, or turns it on the spot.",
        "turn the axes of the wheel joints around",
    ),
    Entry(
        "probe.falls",
        "error",
        "A robot falls without end",
        "Nothing holds it: the world has no ground, or the robot's collisions are missing.",
        "add a ground plane or collisions",
        "robot falls through the ground plane",
    ),
    Entry(
        "probe.idle-drift",
        "warning",
        "A robot that nobody commands moves",
        "An idle robot stays within 1 mm and 0.1° in 10 s. One that does not stands on a slope, "
        "is driven by something, is not at rest yet, or has wheels or contacts that creep.",
        "look at the contacts named: round wheels, friction mu1 and mu2 of 1, no overlaps; give "
        "free joints a damping",
        "robot slides, sinks, jitters or drifts slowly",
    ),
    Entry(
        "probe.not-built",
        "error",
        "The world cannot be built",
        "Physics needs bodies with mass and shapes of finite size, and one name for one model.",
        "correct the link or model that the message names",
    ),
    Entry(
        "probe.spawn-overlap",
        "warning",
        "A robot is spawned inside something",
        "Gazebo parts what overlaps with force: the robot jumps. Gazelle parts it slowly.",
        "spawn it higher or somewhere free",
        "robot jumps or flies away when it is spawned",
    ),
    Entry(
        "probe.speed-differs",
        "warning",
        "A robot drives at another speed than commanded",
        "The drive's wheel diameter is not that of the wheels, they slip, or it cannot reach the "
        "speed.",
        "set wheel diameter (radius) and separation to the geometry's values",
        "odometry does not match the real position",
    ),
    Entry(
        "probe.thrown",
        "warning",
        "A robot is thrown when it is spawned",
        "Overlaps, joints outside their limits or impossible inertias give it a kick.",
        "spawn it free of everything, with its joints within their limits",
        "robot flies away when it is spawned",
    ),
    Entry(
        "probe.turns-wrong",
        "warning",
        "A robot turns right when it is told to turn left",
        "Positive angular.z turns left (REP 103). Left and right wheel joints are exchanged.",
        "exchange the left and right joints of the drive, or change <legacyMode>",
        "robot turns in the wrong direction",
    ),
)
