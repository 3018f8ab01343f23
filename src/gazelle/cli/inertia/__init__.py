"""``gazelle inertia``: mass properties of bodies, and checks of those in robot files."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from gazelle.cli.inertia.bodies import BODIES
from gazelle.geometry import MESH_SUFFIXES

__all__ = ["main"]

_EPILOG = """bodies and their dimensions (the axis is z, the origin the middle of the height):
{bodies}
  mesh FILE                     [--scale S | --scale X Y Z] [--shell]

A density is in kg/m³, that of a thin shell in kg/m², that of a rod in kg/m.

examples:
  gazelle inertia cylinder --radius 0.06 --length 0.09 --mass 0.18
  gazelle inertia half cylindrical shell --radius 0.1 --length 0.2 --mass 1 --rpy 0 1.5708 0
  gazelle inertia package://my_robot/meshes/base.stl --scale 0.001 --density 1200 --urdf
  gazelle inertia --check robot.urdf.xacro wheels:=4
  gazelle inertia --check robot.urdf --fix > fix.patch && patch -p0 < fix.patch

--check exits with 0 when nothing is wrong, 1 after warnings, 2 after errors.
"""

_OF_BODIES = (
    "mass",
    "radius",
    "diameter",
    "length",
    "size",
    "radii",
    "scale",
    "shell",
    "urdf",
    "sdf",
)


def main(argv: list[str]) -> int:
    """Print a body's mass properties, or check a robot's."""
    parser = _parser()
    options = parser.parse_intermixed_args(argv)
    mappings = [word for word in options.body if ":=" in word]
    tokens = [word for word in options.body if ":=" not in word]
    if options.check:
        foreign = [*tokens, *(f"--{name}" for name in _OF_BODIES if getattr(options, name))]
        if foreign or any((*options.xyz, *options.rpy)):
            parser.error(f"--check FILE does not go with {' '.join(foreign) or '--xyz or --rpy'}")
        from gazelle.cli.inertia.check import check

        return check(options, dict(word.split(":=", 1) for word in mappings))
    problem = _problem(options, tokens)
    if mappings:
        problem = f"'{mappings[0]}' belongs to --check FILE"
    if problem:
        parser.error(problem)
    from gazelle.cli.inertia.compute import compute

    return compute(tokens, options)


def _problem(options: argparse.Namespace, tokens: Sequence[str]) -> str:
    if not tokens:
        return "name a body, a mesh file, or --check FILE"
    if options.fix or options.output:
        return "--fix and --output belong to --check FILE"
    if (options.mass is None) == (options.density is None):
        return "give either --mass or --density"
    return ""


def _parser() -> argparse.ArgumentParser:
    shown = "\n".join(f"  {name:<29} {body.usage}" for name, body in BODIES.items())
    parser = argparse.ArgumentParser(
        prog="gazelle inertia",
        description="mass centre and inertia tensor of a body or mesh, and checks of robot files",
        epilog=_EPILOG.format(bodies=shown),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    meshes = ", ".join(suffix.removeprefix(".") for suffix in MESH_SUFFIXES)
    add = parser.add_argument
    add("body", nargs="*", help=f"a body of the list below, or a mesh file ({meshes})")
    add("--mass", type=_positive, metavar="KG", help="mass")
    add("--density", type=_positive, metavar="KG/M3", help="density, instead of a mass")
    for name, help_ in (("--radius", "radius"), ("--diameter", "twice the radius")):
        add(name, type=_positive, metavar="M", help=help_)
    add("--length", "--height", type=_positive, metavar="M", help="length along z")
    add("--size", type=_positive, nargs=3, metavar=("X", "Y", "Z"), help="edges of a box")
    add("--radii", type=_positive, nargs=3, metavar=("X", "Y", "Z"), help="of an ellipsoid")
    add("--scale", type=float, nargs="+", metavar="S", help="one factor for a mesh, or three")
    add("--shell", action="store_true", help="the mesh is a thin wall, not solid")
    add("--xyz", type=float, nargs=3, default=(0, 0, 0), metavar=("X", "Y", "Z"), help="place")
    add("--rpy", type=float, nargs=3, default=(0, 0, 0), metavar=("R", "P", "Y"), help="turn")
    add("--urdf", action="store_true", help="print the URDF block only")
    add("--sdf", action="store_true", help="print the SDF block only")
    add("--json", action="store_true", help="print JSON")
    add("--check", metavar="FILE", help="judge every link of a URDF, xacro or SDF file")
    add("--fix", action="store_true", help="print a patch for the links found wrong")
    add("--output", "-o", metavar="FILE", help="write the patch to a file")
    return parser


def _positive(text: str) -> float:
    value = float(text)
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"'{text}' is not greater than 0")
    return value
