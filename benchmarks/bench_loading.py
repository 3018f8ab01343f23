"""How long a world of many meshes takes to load, at first and with what was kept of it.

    python benchmarks/bench_loading.py [WORLD]

WORLD is a file as `gazebo` takes it; without one a hall is made: 300 models of 60 meshes, half of
them closed and hollow, half of them open sheets. Each load is a process of its own; all begin with
an empty cache. Prints one JSON object a load: seconds by the clock, computing seconds of the
process and of its workers, its memory, and how many solids collide.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

_LOAD = """
import json, os, resource, sys, time
from gazelle.simulator import Simulation
begin_s = time.perf_counter()
simulation = Simulation.load(world=sys.argv[1])
wall_s = time.perf_counter() - begin_s
spent, memory = os.times(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
print(json.dumps({
    "wall_s": round(wall_s, 1), "cpu_s": round(spent.user + spent.system, 1),
    "workers_cpu_s": round(spent.children_user + spent.children_system, 1),
    "memory_mb": round(memory), "solids": simulation.server.engine.model.ngeom,
    "hash": simulation.state_hash()[:12],
}))
"""
_MESHES, _MODELS = 60, 300


def main() -> None:
    """Load a world three times."""
    with tempfile.TemporaryDirectory() as folder:
        world = Path(sys.argv[1]) if len(sys.argv) > 1 else _hall(Path(folder))
        environ = {**os.environ, "XDG_CACHE_HOME": str(Path(folder) / "cache")}
        for what in ("first", "again", "once more"):
            words = [sys.executable, "-c", _LOAD, str(world)]
            done = subprocess.run(words, env=environ, check=True, capture_output=True, text=True)
            print(json.dumps({"what": what, **json.loads(done.stdout.splitlines()[-1])}))


def _hall(folder: Path) -> Path:
    """Write meshes and a world of them; return the world's file."""
    rng = np.random.default_rng(1)
    for number in range(_MESHES):
        make = _sheet if number % 2 else _channel
        (folder / f"{number}.obj").write_text(make(rng), encoding="utf-8")
    models = []
    for number in range(_MODELS):
        x, y = 4 * (number % 20), 4 * (number // 20)
        uri = f"<mesh><uri>file://{folder}/{number % _MESHES}.obj</uri></mesh>"
        models.append(
            f'<model name="m{number}"><static>true</static><pose>{x} {y} 0 0 0 0</pose>'
            f'<link name="l"><collision name="c"><geometry>{uri}</geometry></collision>'
            f'<visual name="v"><geometry>{uri}</geometry></visual></link></model>'
        )
    path = folder / "hall.world"
    text = f'<sdf version="1.6"><world name="hall">{"".join(models)}</world></sdf>'
    path.write_text(text, encoding="utf-8")
    return path


def _channel(rng: np.random.Generator) -> str:
    """A closed channel with a U as its section, bent along its way."""
    width, height, wall = rng.uniform(0.5, 1.5), rng.uniform(0.4, 1.0), rng.uniform(0.05, 0.15)
    section = [
        (0, 0), (width, 0), (width, height), (width - wall, height), (width - wall, wall),
        (wall, wall), (wall, height), (0, height),
    ]  # fmt: skip
    rings, corners = 24, len(section)
    bend = rng.uniform(0.2, 0.8)
    points = [
        (2.0 * k / rings, y + bend * np.sin(3.0 * k / rings), z)
        for k in range(rings + 1)
        for y, z in section
    ]
    faces = []
    for k in range(rings):
        for i in range(corners):
            a, b = k * corners + i, k * corners + (i + 1) % corners
            faces += [(a, b, b + corners), (a, b + corners, a + corners)]
    caps = [(0, 1, 4), (1, 2, 3), (1, 3, 4), (0, 4, 5), (0, 5, 7), (5, 6, 7)]
    last = rings * corners
    faces += [(c, b, a) for a, b, c in caps]
    faces += [(last + a, last + b, last + c) for a, b, c in caps]
    return _obj(np.array(points), np.array(faces))


def _sheet(rng: np.random.Generator) -> str:
    """An uneven open sheet."""
    side = 13
    grid = np.stack(np.meshgrid(*[np.linspace(0, 2, side)] * 2), axis=-1).reshape(-1, 2)
    points = np.column_stack([grid, rng.uniform(0, 0.15, len(grid))])
    first = np.array([r * side + c for r in range(side - 1) for c in range(side - 1)])
    faces = np.concatenate(
        [
            np.column_stack([first, first + 1, first + side + 1]),
            np.column_stack([first, first + side + 1, first + side]),
        ]
    )
    return _obj(points, faces)


def _obj(points: np.ndarray, faces: np.ndarray) -> str:
    lines = ["v {:.6f} {:.6f} {:.6f}".format(*row) for row in points]
    lines += ["f {} {} {}".format(*row) for row in faces + 1]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
