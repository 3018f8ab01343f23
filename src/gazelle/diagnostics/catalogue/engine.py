"""Codes of the physics engine: what it maps, clips or ignores."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "engine.illegal-inertia",
        "warning",
        "A link has an inertia that no body can have",
        "Principal moments must be positive and none larger than the sum of the other two; such"
        " a tensor makes a simulation explode. It is replaced by a sphere's with the same trace.",
        "compute the inertia from the link's shape and mass",
        "The inertia of link is not physically valid",
    ),
    Entry(
        "engine.massless-link",
        "warning",
        "A link moves and has no mass",
        "Nothing without mass can be accelerated. It gets a gram, so that it stays in the model.",
        "add an <inertial> block, or make its joint fixed",
        "link has no inertia; will not be simulated",
    ),
    Entry(
        "engine.moving-plane",
        "warning",
        "A plane collision is on a link that moves",
        "Only resting planes can be infinite; the engine uses a thin box of the plane's size.",
        "use a box, or make the model static",
    ),
    Entry(
        "engine.moving-terrain",
        "warning",
        "A heightmap collision is on a link that moves",
        "Height fields must rest; this one does not collide.",
        "make the model static",
    ),
    Entry(
        "engine.unreadable-terrain",
        "error",
        "The image of a heightmap cannot be read",
        "Without heights there is no terrain; it does not collide.",
        "use a greyscale PNG",
        "Unable to load heightmap",
    ),
    Entry(
        "engine.flat-shape",
        "warning",
        "A collision shape has a size of zero or less",
        "It encloses nothing and does not collide.",
        "give it a positive size",
    ),
    Entry(
        "engine.hollow-mesh",
        "info",
        "A collision mesh is not convex",
        "The engine collides convex solids. A hollow mesh is split into some; where that is not"
        " possible a moving one becomes its hull and a resting one a shell of thin pieces.",
        "use boxes and cylinders, or a simpler mesh, for collisions",
    ),
    Entry(
        "engine.bad-mesh",
        "error",
        "A collision mesh cannot be used",
        "The file cannot be read or encloses nothing; the collision is left out.",
        "check the file, or use a box, cylinder or sphere",
        "Unable to load mesh",
    ),
    Entry(
        "engine.friction-direction",
        "info",
        "A friction direction (fdir1) cannot follow the body",
        "The engine's friction directions belong to the contact, not to the body: mu and mu2 act"
        " along the contact's own tangents.",
        "use equal mu and mu2 where the direction does not matter",
    ),
    Entry(
        "engine.slip",
        "info",
        "Force-dependent slip has no effect",
        "slip1 and slip2 of ODE act on wheels only: cylinders and spheres on a joint that turns,"
        " with fdir1 along its axis or both slips equal.",
        "give the wheel such a shape and fdir1, or lower mu to make the surface slippery",
        idle=True,
    ),
    Entry(
        "engine.max-contacts",
        "info",
        "A limit on contact points has no effect",
        "The engine finds few contact points per pair and keeps them all.",
        "nothing needs to be done",
        idle=True,
    ),
    Entry(
        "engine.idle-contact-word",
        "info",
        "A parameter of ODE's contact solver has no effect",
        "minDepth is the overlap that ODE leaves alone, soft_cfm and soft_erp are its words for a"
        " spring; this engine's contact needs none of them (docs/contact.md).",
        "use kp and kd for a soft contact; else nothing needs to be done",
        idle=True,
    ),
    Entry(
        "engine.idle-joint-word",
        "info",
        "A parameter of ODE's joint solver has no effect",
        "cfm and erp soften ODE's joints, which otherwise shake; this engine's joints are exact.",
        "use spring_stiffness and damping for a soft joint; else nothing needs to be done",
        idle=True,
    ),
    Entry(
        "engine.velocity-decay",
        "info",
        "A velocity decay has no effect on a jointed link",
        "It slows links that move freely; a link on a joint is slowed by the joint's damping.",
        "set <damping> on the joint",
        idle=True,
    ),
    Entry(
        "engine.mujoco-warning",
        "warning",
        "The physics library warns",
        "Something is beyond what MuJoCo computes well, such as too many contacts.",
        "read its words; simplify the collisions where contacts are too many",
    ),
    Entry(
        "engine.quarter-turn",
        "warning",
        "A joint turns by more than a quarter turn in a step",
        "Efforts end at a joint's velocity limit, and here at the latest: steps do not resolve how"
        " faster turning acts on the other links. Mostly the part that turns has an inertia far too"
        " small for the effort on it.",
        "give the joint <limit velocity=…>, less effort or damping, or its child more inertia",
    ),
    Entry(
        "engine.parallel-axes",
        "warning",
        "Both axes of a joint have the same direction",
        "A universal or revolute2 joint turns about two axes; about one direction it can turn only"
        " once, and ODE's solver finds no second way to move.",
        "give <axis> and <axis2> different directions, or make the joint revolute",
    ),
    Entry(
        "engine.gearbox",
        "warning",
        "A gearbox has no effect",
        "It couples two revolute joints between its reference body and its two links; one of them"
        " does not exist.",
        "name the body both links turn on in <gearbox_reference_body>",
    ),
)
