"""``gazelle inertia BODY …``: one body's mass properties."""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import replace
from pathlib import Path

from gazelle.cli.inertia.bodies import BodyError, Dimensions, body_named, solid_of
from gazelle.description.checks.inertia import sdf_block, urdf_block
from gazelle.geometry import (
    MESH_SUFFIXES,
    MassError,
    MassProperties,
    Mesh,
    Pose,
    inertia_problems,
    legalised_inertia,
)
from gazelle.workspace import Workspace

__all__ = ["compute"]

_WORDS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def compute(tokens: list[str], options: argparse.Namespace) -> int:
    """Print mass, centre, tensor and the blocks of a body.

    Args:
        tokens: the body's name, or ``mesh`` and a file, or a file alone.
        options: as parsed.

    Returns:
        0.

    Raises:
        BodyError: the words or dimensions make no body.
        MassError: the mesh has no volume or area.
        MeshError: the mesh file cannot be read.
    """
    uri = _mesh_uri(tokens)
    if uri:
        name, own = f"mesh {uri}", _mesh_properties(uri, options)
    else:
        name, _ = body_named(" ".join(tokens))
        own = _solid_properties(name, options)
    body = own.transformed(Pose.from_xyz_rpy(tuple(options.xyz), tuple(options.rpy)))
    writable = body
    problems = inertia_problems(body.inertia_kg_m2)
    if problems:
        writable = replace(body, inertia_kg_m2=legalised_inertia(body.inertia_kg_m2))
        print(
            f"gazelle inertia: no engine takes this tensor: {'; '.join(problems)}. In the blocks "
            "the smallest moment is a thousandth of the largest; a thin cylinder has a true one",
            file=sys.stderr,
        )
    print(_report(name, body, writable, options))
    return 0


def _mesh_uri(tokens: list[str]) -> str:
    last = tokens[-1]
    is_file = "://" in last or last.lower().endswith(MESH_SUFFIXES) or Path(last).is_file()
    if tokens[0].lower() == "mesh" and len(tokens) == 2:
        return last
    return last if len(tokens) == 1 and is_file else ""


def _mesh_properties(uri: str, options: argparse.Namespace) -> MassProperties:
    from gazelle.geometry import load_mesh, mesh_mass_properties

    sizes = (options.radius, options.diameter, options.length, options.size, options.radii)
    if any(value is not None for value in sizes):
        raise BodyError("a mesh has its size from its file; only --scale changes it")
    mesh = load_mesh(_located(uri)).scaled(_scale(options.scale))
    for note in mesh.notes:
        print(f"gazelle inertia: {uri}: {note.message}", file=sys.stderr)
    _warn_of_millimetres(mesh)
    try:
        return mesh_mass_properties(
            mesh, mass_kg=options.mass, density_kg_m3=options.density, shell=options.shell
        )
    except MassError as error:
        hint = "" if options.shell else ". Give --shell for a thin wall"
        raise MassError(f"{uri}: {error}{hint}") from None


def _located(uri: str) -> Path:
    path = Path(uri)
    if path.is_file():
        return path
    found = Workspace.discover().resolve(uri, base_dir=Path.cwd())
    if found.path is None:
        raise BodyError(f"mesh {found.explain(uri)}")
    return found.path


def _warn_of_millimetres(mesh: Mesh) -> None:
    low, high = mesh.bounds_m
    longest = max(b - a for a, b in zip(low, high, strict=True))
    if longest > 10.0:
        print(
            f"gazelle inertia: the mesh is {longest:.4g} m long; if it is in millimetres, give "
            "--scale 0.001",
            file=sys.stderr,
        )


def _scale(given: list[float] | None) -> tuple[float, float, float]:
    if given is None:
        return (1.0, 1.0, 1.0)
    if len(given) not in (1, 3) or 0.0 in given:
        raise BodyError("--scale takes one factor or three, none of them 0")
    x, y, z = given * 3 if len(given) == 1 else given
    return (x, y, z)


def _solid_properties(name: str, options: argparse.Namespace) -> MassProperties:
    if options.scale is not None or options.shell:
        raise BodyError("--scale and --shell belong to meshes")
    if options.radius is not None and options.diameter is not None:
        raise BodyError("give --radius or --diameter, not both")
    radius = options.radius if options.diameter is None else options.diameter / 2
    given = Dimensions(
        radius,
        options.length,
        None if options.size is None else tuple(options.size),
        None if options.radii is None else tuple(options.radii),
    )
    return solid_of(name, given, mass_kg=options.mass, density=options.density)


def _report(
    name: str, body: MassProperties, writable: MassProperties, options: argparse.Namespace
) -> str:
    urdf, sdf = urdf_block(writable), sdf_block(writable)
    if options.json:
        return json.dumps(
            {
                "body": name,
                "mass_kg": body.mass_kg,
                "center_m": body.center_m,
                "inertia_kg_m2": dict(zip(_WORDS, body.inertia_kg_m2, strict=True)),
                "principal_moments_kg_m2": body.principal_moments_kg_m2,
                "urdf": urdf,
                "sdf": sdf,
            },
            indent=2,
        )
    if options.urdf or options.sdf:
        return "\n".join([urdf] * options.urdf + [sdf] * options.sdf)
    xx, xy, xz, yy, yz, zz = (f"{value:.6g}" for value in body.inertia_kg_m2)
    center = " ".join(f"{value:.6g}" for value in body.center_m)
    rows = [(xx, xy, xz), (xy, yy, yz), (xz, yz, zz)]
    lines = [
        name.replace("-", " ") if not name.startswith("mesh ") else name,
        f"  mass       {body.mass_kg:.6g} kg",
        f"  centre     {center} m",
        "  inertia    about the centre of mass, kg·m²",
        *("    " + "".join(f"{value:>14}" for value in row) for row in rows),
    ]
    return "\n".join([*lines, "", "URDF", urdf, "", "SDF", sdf])
