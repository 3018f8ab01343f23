"""Codes of the checks of mass and inertia."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "inertia.box",
        "warning",
        "A link's inertia does not fit the size of its shapes",
        "The box of even density with the same mass and tensor shows how large a body would have "
        "to be. No body inside the shapes can have an edge of it more than √3 times theirs; a "
        "box of less than a fifth of them is a placeholder or a wrong unit.",
        "paste the block shown",
        "robot shakes, wobbles or tips over for no reason",
    ),
    Entry(
        "inertia.center",
        "warning",
        "A link's centre of mass lies outside its shapes",
        "A body's centre of mass is inside its bounding box. CAD programs give it in the "
        "assembly's frame, or in millimetres; URDF and SDF want the link's frame and metres.",
        "paste the block shown",
        "robot tips over as soon as it is spawned",
    ),
    Entry(
        "inertia.density",
        "warning",
        "A link's mass does not fit the volume of its shapes",
        "Materials have between 20 kg/m³ (foam) and 20,000 kg/m³ (tungsten, gold).",
        "correct the mass, or the size of the shapes",
        "robot flies away, or nothing can lift it",
    ),
    Entry(
        "inertia.mass",
        "error",
        "A link's mass is not positive",
        "No physics engine can move such a body; Gazebo drops the link or refuses the model.",
        "write the mass in kilograms, greater than 0",
        "urdf2sdf: link has a non-positive mass; A link named ... has invalid inertia.",
    ),
    Entry(
        "inertia.mass-ratio",
        "warning",
        "A joint ties a heavy body to a very light one",
        "Solvers of contacts and joints converge badly when masses differ by more than 1000; the "
        "light body shakes or the joint comes apart.",
        "give the light body more mass, or fix it to its neighbour",
        "ODE Message 3: LCP internal error, s <= 0",
    ),
    Entry(
        "inertia.missing",
        "warning",
        "A moving link has no inertia",
        "Gazebo drops such a link of a URDF with all that hangs on it, and gives one of an SDF "
        "1 kg and moments of 1 kg·m².",
        "paste the block shown and correct the mass",
        "urdf2sdf: link has no <inertial> block defined, not modeled in sdf",
    ),
    Entry(
        "inertia.not-positive",
        "error",
        "A link's inertia tensor is not positive definite",
        "It takes work to turn a body about any axis, so all principal moments are greater than "
        "0. Gazebo refuses such a tensor or the simulation diverges.",
        "paste the block shown",
        "A link named ... has invalid inertia.",
    ),
    Entry(
        "inertia.triangle",
        "error",
        "A link's inertia tensor breaks the triangle inequality",
        "Each principal moment is an integral of two squared distances, so none is larger than "
        "the sum of the other two. Such a tensor often is one about the joint, not about the "
        "centre of mass, or has its axes mixed up.",
        "paste the block shown",
        "A link named ... has invalid inertia.",
    ),
    Entry(
        "inertia.units",
        "warning",
        "A link's mass, inertia or mesh is in the wrong unit",
        "URDF and SDF are in metres, kilograms and kg·m². CAD programs export millimetres, grams "
        "and g·mm²; the message names the factor that makes everything fit.",
        "multiply with the factor shown",
        "robot is gigantic, invisible, or explodes when it is spawned",
    ),
)
