"""Every body by its name against the closed form and against a fine mesh of it."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad

from gazelle.cli.inertia import main
from gazelle.cli.inertia.bodies import BODIES, BodyError, body_named
from gazelle.geometry import MassError, Pose, convex_hull, cylinder_mesh

M, R, L = 3.0, 0.4, 1.5
PI = math.pi
XYZ, RPY = (0.3, -0.2, 0.7), (0.4, -0.9, 1.3)
T_link_body = Pose.from_xyz_rpy(XYZ, RPY)
_STEPS = 112

ROUND = ["--radius", str(R), "--length", str(L)]
BALL = ["--radius", str(R)]
TENSOR = ("ixx", "iyy", "izz")


def run(capsys: pytest.CaptureFixture[str], *words: str) -> dict:
    assert main([*words, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def side(radial: float) -> float:
    """Moment across the axis: m (radial r² + l²/12)."""
    return M * (radial * R**2 + L**2 / 12)


# Closed forms of Meriam and Kraige's table: centre, and moments about the body's own axes
# through the origin, from which the parallel axis theorem leads to the centre.
CLOSED = {
    "box": (["--size", "1", "2", "3"], (0, 0, 0), (M * 13 / 12, M * 10 / 12, M * 5 / 12)),
    "cylinder": (ROUND, (0, 0, 0), (side(1 / 4), side(1 / 4), M * R**2 / 2)),
    "semicylinder": (ROUND, (4 * R / 3 / PI, 0, 0), (side(1 / 4), side(1 / 4), M * R**2 / 2)),
    "circular cylindrical shell": (ROUND, (0, 0, 0), (side(1 / 2), side(1 / 2), M * R**2)),
    "half cylindrical shell": (ROUND, (2 * R / PI, 0, 0), (side(1 / 2), side(1 / 2), M * R**2)),
    "sphere": (BALL, (0, 0, 0), (0.4 * M * R**2,) * 3),
    "spherical shell": (BALL, (0, 0, 0), (2 / 3 * M * R**2,) * 3),
    "hemisphere": (BALL, (0, 0, 3 / 8 * R), (0.4 * M * R**2,) * 3),
    "hemispherical shell": (BALL, (0, 0, R / 2), (2 / 3 * M * R**2,) * 3),
    "uniform slender rod": (["--length", str(L)], (0, 0, 0), (M * L**2 / 12, M * L**2 / 12, 0)),
    "cone": (
        ROUND,
        (0, 0, -L / 4),
        # About the base, 3/20 m r² + 1/10 m l², moved to the middle of the height.
        (*(M * (3 / 20 * R**2 + L**2 / 10 + L**2 / 4 - 2 * L / 2 * L / 4),) * 2, 0.3 * M * R**2),
    ),
    "ellipsoid": (["--radii", "1", "2", "3"], (0, 0, 0), (M * 13 / 5, M * 10 / 5, M * 5 / 5)),
}
MIRA_TABLE = list(CLOSED)[1:10]


@pytest.mark.parametrize("name", CLOSED)
def test_closed_form(capsys, name: str) -> None:
    options, center, about_origin = CLOSED[name]
    found = run(capsys, *name.split(), *options, "--mass", str(M))
    x, y, z = center
    shift = (y * y + z * z, x * x + z * z, x * x + y * y)
    moments = [total - M * step for total, step in zip(about_origin, shift, strict=True)]
    assert found["mass_kg"] == M
    assert found["center_m"] == pytest.approx(center)
    assert [found["inertia_kg_m2"][word] for word in TENSOR] == pytest.approx(moments)
    assert [found["inertia_kg_m2"][word] for word in ("ixy", "ixz", "iyz")] == [0, 0, 0]


def test_capsule_is_the_integral_of_its_slices(capsys) -> None:
    def ring(z: float) -> float:
        return math.sqrt(max(R**2 - max(abs(z) - L / 2, 0.0) ** 2, 0.0))

    ends = {"a": -L / 2 - R, "b": L / 2 + R, "points": [-L / 2, L / 2]}
    volume = quad(lambda z: PI * ring(z) ** 2, **ends)[0]
    axis = quad(lambda z: PI * ring(z) ** 4 / 2, **ends)[0]
    across = quad(lambda z: PI * ring(z) ** 2 * (ring(z) ** 2 / 4 + z * z), **ends)[0]
    found = run(capsys, "capsule", *ROUND, "--mass", str(M))["inertia_kg_m2"]
    assert found["izz"] == pytest.approx(M * axis / volume, rel=1e-9)
    assert found["ixx"] == pytest.approx(M * across / volume, rel=1e-9)


@pytest.mark.tutorial
def test_bodies_of_the_table_in_document_mira_are_known_by_name() -> None:
    """M1: the nine rows and the box."""
    rows = ["Circular Cylinder", "Semicylinder", "Circular Cylindrical Shell"]
    rows += ["Half Cylindrical Shell", "Sphere", "Spherical Shell", "Hemisphere"]
    rows += ["Hemispherical Shell", "Uniform Slender Rod", "Box"]
    assert len({body_named(row)[0] for row in rows}) == 10
    assert {body_named(name)[0] for name in (*MIRA_TABLE, "box")} == {
        body_named(row)[0] for row in rows
    }


def surface(
    at: Callable, u: tuple[float, float], v: tuple[float, float], rows: int = _STEPS
) -> np.ndarray:
    """Triangles (n, 3, 3) of a surface over two parameters, in so many rows along the second."""
    grid = np.meshgrid(np.linspace(*u, _STEPS + 1), np.linspace(*v, rows + 1), indexing="ij")
    points = np.stack(at(*grid), axis=-1)
    a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
    both = [np.stack([a, b, c], axis=-2), np.stack([a, c, d], axis=-2)]
    return np.concatenate([part.reshape(-1, 3, 3) for part in both])


def tube(angle, z):
    return R * np.cos(angle), R * np.sin(angle), z


def ball(angle, height):
    ring = R * np.cos(height)
    return ring * np.cos(angle), ring * np.sin(angle), R * np.sin(height)


def hull(*clouds: np.ndarray) -> np.ndarray:
    part = convex_hull(np.concatenate([cloud.reshape(-1, 3) for cloud in clouds]))
    return part.vertices_m[part.faces]


def thin_rod() -> np.ndarray:
    part = cylinder_mesh(1e-4, L)
    return part.vertices_m[part.faces]


HALF = (-PI / 2, PI / 2)
FULL = (0, 2 * PI)
ENDS = (-L / 2, L / 2)
BOTH = np.array([(0, 0, -L / 2), (0, 0, L / 2)])
CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / 2


def caps() -> np.ndarray:
    high = surface(ball, FULL, (0, PI / 2)) + np.array([0, 0, L / 2])
    return hull(high[::7], -high[::7])


FINE: dict[str, tuple[list[str], Callable[[], np.ndarray]]] = {
    "box": (["--size", "1", "2", "3"], lambda: hull(CUBE * (1, 2, 3))),
    "cylinder": (ROUND, lambda: hull(surface(tube, FULL, ENDS, 1))),
    "semicylinder": (ROUND, lambda: hull(surface(tube, HALF, ENDS, 1))),
    "cylindrical shell": (ROUND, lambda: surface(tube, FULL, ENDS, 1)),
    "half cylindrical shell": (ROUND, lambda: surface(tube, HALF, ENDS, 1)),
    "sphere": (BALL, lambda: hull(surface(ball, FULL, HALF)[::3])),
    "spherical shell": (BALL, lambda: surface(ball, FULL, HALF)),
    "hemisphere": (BALL, lambda: hull(surface(ball, FULL, (0, PI / 2))[::3])),
    "hemispherical shell": (BALL, lambda: surface(ball, FULL, (0, PI / 2))),
    "slender rod": (["--length", str(L)], thin_rod),
    "cone": (ROUND, lambda: hull(surface(tube, FULL, (-L / 2, -L / 2), 1), BOTH[1:])),
    "capsule": (ROUND, caps),
    "ellipsoid": (
        ["--radii", "1", "2", "3"],
        lambda: hull(surface(ball, FULL, HALF)[::3] / R * (1, 2, 3)),
    ),
}


@cache
def fine(name: str) -> np.ndarray:
    """The triangles of a body, which several tests write."""
    return FINE[name][1]()


def write_stl(file: Path, triangles: np.ndarray) -> None:
    rows = np.zeros(len(triangles), [("n", "<f4", 3), ("v", "<f4", (3, 3)), ("x", "<u2")])
    rows["v"] = triangles
    file.write_bytes(bytes(80) + np.uint32(len(triangles)).tobytes() + rows.tobytes())


@pytest.mark.parametrize("name", FINE)
def test_fine_mesh_translated_and_rotated(capsys, tmp_path: Path, name: str) -> None:
    options, _ = FINE[name]
    triangles = T_link_body.transform(fine(name).reshape(-1, 3)).reshape(-1, 3, 3)
    file = tmp_path / "body.stl"
    write_stl(file, triangles)
    pose = ["--xyz", *map(str, XYZ), "--rpy", *map(str, RPY)]
    body = run(capsys, *name.split(), *options, "--mass", str(M), *pose)
    shell = ["--shell"] if "shell" in name else []
    mesh = run(capsys, "mesh", str(file), "--mass", str(M), *shell)
    size = max(abs(value) for value in body["inertia_kg_m2"].values())
    assert mesh["center_m"] == pytest.approx(body["center_m"], abs=1e-3 * R)
    for word, value in body["inertia_kg_m2"].items():
        assert mesh["inertia_kg_m2"][word] == pytest.approx(value, rel=1e-3, abs=1e-3 * size), word


@pytest.mark.parametrize("name", [name for name in FINE if name != "slender rod"])
def test_density_times_volume_or_area(capsys, tmp_path: Path, name: str) -> None:
    options, _ = FINE[name]
    file = tmp_path / "body.stl"
    write_stl(file, fine(name))
    shell = ["--shell"] if "shell" in name else []
    body = run(capsys, *name.split(), *options, "--density", "500")
    mesh = run(capsys, str(file), "--density", "500", *shell)
    assert mesh["mass_kg"] == pytest.approx(body["mass_kg"], rel=1e-3)


def test_density_of_a_rod_is_per_metre(capsys) -> None:
    assert run(capsys, "rod", "--length", "2", "--density", "0.5")["mass_kg"] == 1.0


def test_every_body_is_tested() -> None:
    assert {body_named(name)[0] for name in FINE} == set(BODIES)


@pytest.mark.parametrize("words", ["half cylinder", "Half_Cylinder", "semi-cylinder"])
def test_words_people_use(words: str) -> None:
    assert body_named(words)[0] == "semicylinder"


def test_text_shows_everything_and_both_blocks(capsys) -> None:
    assert main(["cylinder", *ROUND, "--mass", "3"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("cylinder\n  mass       3 kg\n  centre     0 0 0 m\n")
    assert '<inertia ixx="0.6825" ixy="0" ixz="0" iyy="0.6825" iyz="0" izz="0.24"/>' in out
    assert "<izz>0.24</izz>" in out


def test_one_block_alone(capsys) -> None:
    main(["sphere", "--diameter", "1", "--mass", "2", "--urdf"])
    urdf = capsys.readouterr().out
    assert urdf.startswith("<inertial>\n  <origin")
    assert urdf.endswith("</inertial>\n")
    main(["sphere", "--radius", "0.5", "--mass", "2", "--sdf"])
    sdf = capsys.readouterr().out
    assert sdf.startswith("<inertial>\n  <pose>0 0 0 0 0 0</pose>\n  <mass>2</mass>")
    assert 'izz="0.2"' in urdf


def test_block_of_a_rod_is_one_that_engines_take(capsys) -> None:
    main(["rod", "--length", "1", "--mass", "12", "--urdf"])
    captured = capsys.readouterr()
    assert 'izz="0.001"' in captured.out
    assert "no engine takes this tensor: it is not positive definite" in captured.err


def test_scaled_mesh_and_hint_about_millimetres(capsys, tmp_path: Path) -> None:
    file = tmp_path / "box.stl"
    write_stl(file, hull(CUBE * (100, 200, 300)))
    small = run(capsys, str(file), "--scale", "0.001", "--mass", "12")
    assert [small["inertia_kg_m2"][word] for word in TENSOR] == pytest.approx((0.13, 0.1, 0.05))
    run_and_error = main([str(file), "--mass", "12", "--urdf"])
    assert run_and_error == 0
    assert "the mesh is 300 m long; if it is in millimetres, give --scale 0.001" in (
        capsys.readouterr().err
    )


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("spher --radius 1", "no body is called 'spher'; did you mean 'sphere'"),
        ("pyramid --radius 1", "known are box, cylinder, semicylinder"),
        ("box --radius 1", "a box needs --size and has no --radius: box --size X Y Z"),
        ("sphere --radius 1 --diameter 2", "give --radius or --diameter, not both"),
        ("sphere --radius 1 --shell", "--scale and --shell belong to meshes"),
        ("mesh a.stl --radius 1", "a mesh has its size from its file"),
        ("mesh nowhere.stl", "'nowhere.stl' not found"),
    ],
)
def test_mistakes_are_named(words: str, message: str) -> None:
    with pytest.raises(BodyError, match=re.escape(message)):
        main([*words.split(), "--mass", "1"])


def test_open_mesh_asks_for_shell(tmp_path: Path) -> None:
    file = tmp_path / "open.stl"
    write_stl(file, hull(CUBE)[:-1])
    with pytest.raises(MassError, match=r"not closed.*Give --shell for a thin wall"):
        main([str(file), "--mass", "1"])


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("sphere --radius 1", "give either --mass or --density"),
        ("sphere --radius 1 --mass 1 --density 1", "give either --mass or --density"),
        ("--mass 1", "name a body, a mesh file, or --check FILE"),
        ("sphere --radius -1 --mass 1", "'-1' is not greater than 0"),
        ("sphere --radius 1 --mass 1 --fix", "--fix and --output belong to --check FILE"),
        ("sphere --check a.urdf", "--check FILE does not go with sphere"),
        ("--check a.urdf --mass 1 --sdf", "--check FILE does not go with --mass --sdf"),
        ("--check a.urdf --xyz 0 0 1", "--check FILE does not go with --xyz or --rpy"),
        ("sphere --radius 1 --mass 1 a:=1", "'a:=1' belongs to --check FILE"),
    ],
)
def test_wrong_usage_is_explained(capsys, words: str, message: str) -> None:
    with pytest.raises(SystemExit) as stop:
        main(words.split())
    assert stop.value.code == 2
    assert message in capsys.readouterr().err
