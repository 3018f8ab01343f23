"""Speed of arm planning among furniture: two arms of our own, or MotionBenchMaker's files.

    python benchmarks/bench_arms.py [FOLDER ...] [--count N]

Without a folder the problems are those of ``arm_families.py``. A folder has one robot's ``.urdf``
and ``.srdf`` and ``problems/FAMILY/sceneNNNN.yaml`` with ``requestNNNN.yaml``: MoveIt's planning
scenes and motion plan requests as MotionBenchMaker (Chamzas et al., 2022) writes them.
``resources/panda`` and ``resources/ur5`` of VAMP's repository are such folders, once
``problems.tar.bz2`` in them is unpacked.

Prints, for each family: problems solved of those whose start and goal are free; paths that hold
every 0.002 rad in a check that knows nothing of bounds (wanted: all); median, 95th percentile and
largest of the CPU milliseconds that planning takes with its last check (wanted: 10 and 60 at most
over all families of a robot); median and largest of building the scene (wanted: 10 at most).
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import yaml

from arm_families import ARMS, FAMILIES, arm_named, problem_of
from gazelle.description.loader import load_models
from gazelle.description.model import Box, Cylinder, Sphere
from gazelle.description.srdf import load_srdf
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.model import RobotModel
from gazelle.motion.planning import PlanningError, Search, plan
from gazelle.motion.scene import AllowedCollisions, PlacedShape, PlanningScene, WorldObject

Problem = tuple[PlanningScene, str, FloatArray, FloatArray]
"""Scene, group, start and goal."""

_FINE_STEP = 0.002
_LIMIT_S = 60.0


class _Result(NamedTuple):
    """One problem: CPU milliseconds of the scene and of the path, and whether the path holds."""

    scene_ms: float
    plan_ms: float
    solved: bool
    holds: bool


def main() -> None:
    """Print a table of each folder's robot."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="*", type=Path, metavar="FOLDER")
    parser.add_argument("--count", type=int, default=100, help="problems of each family")
    options = parser.parse_args()
    for folder in options.folders:
        robot = robot_in(folder)
        _table(robot.name, _of_folder(robot, folder, options.count))
    if not options.folders:
        for name in ARMS:
            _table(name, _own(name, options.count))


def _table(name: str, families: Iterable[tuple[str, Iterable[Problem]]]) -> None:
    print(f"{name:26}  solved   holds  median     p95    most ms   scene    most ms")
    everything: list[_Result] = []
    for family, problems in families:
        results = [found for problem in problems if (found := _result(*problem))]
        _print(family, results)
        everything += results
    _print("all", everything)


def _own(name: str, count: int) -> Iterator[tuple[str, Iterable[Problem]]]:
    robot = arm_named(name)
    for family in FAMILIES:
        yield family, (problem_of(robot, family, number) for number in range(count))


def _of_folder(
    robot: RobotModel, folder: Path, count: int
) -> Iterator[tuple[str, Iterable[Problem]]]:
    for family in sorted((folder / "problems").iterdir()):
        numbers = [file.stem[5:] for file in sorted(family.glob("scene*.yaml"))][:count]
        yield family.name, (problem_in(robot, family, number) for number in numbers)


def robot_in(folder: Path) -> RobotModel:
    """Return the robot of a folder of problems."""
    told = Diagnostics()
    files = [file for file in sorted(folder.glob("*.urdf")) if "spherized" not in file.name]
    text = files[0].read_text(encoding="utf-8")
    text = text.replace("package://meshes", f"{folder.resolve().as_uri()}/meshes")
    (model,) = load_models(text, workspace=None, diagnostics=told)
    srdf = load_srdf(
        files[0].with_suffix(".srdf"), robot=model, workspace=None, diagnostics=told
    )  # fmt: skip
    return RobotModel.build(model, srdf, diagnostics=told)


def problem_in(robot: RobotModel, family: Path, number: str) -> Problem:
    """Return scene, group, start and goal of one problem."""
    scene = _scene(robot, _read(family / f"scene{number}.yaml"))
    request = _read(family / f"request{number}.yaml")
    group = robot.group(request["group_name"])
    state = request["start_state"]["joint_state"]
    starts = dict(zip(state["name"], state["position"], strict=True))
    goals = {
        item["joint_name"]: item["position"]
        for item in request["goal_constraints"][0]["joint_constraints"]
    }
    scene = scene.with_positions({k: v for k, v in starts.items() if k in robot.variables})
    space = group.space
    return scene, group.name, space.array(starts), space.array(goals)


def _read(file: Path) -> Any:
    return yaml.load(file.read_text(encoding="utf-8"), Loader=yaml.CSafeLoader)


def _scene(robot: RobotModel, message: Mapping[str, Any]) -> PlanningScene:
    scene = PlanningScene.of(robot)
    matrix = message["allowed_collision_matrix"]
    names, rows = matrix["entry_names"], matrix["entry_values"]
    pairs = {
        frozenset((first, second)): bool(value)
        for first, row in zip(names, rows, strict=True)
        for second, value in zip(names, row, strict=True)
        if first != second
    }
    scene = scene.with_allowed(AllowedCollisions(pairs))
    for item in message["world"]["collision_objects"]:
        placed = tuple(
            PlacedShape(_shape(shape), _pose(pose))
            for shape, pose in zip(item["primitives"], item["primitive_poses"], strict=True)
        )
        pose = _pose(item["pose"]) if "pose" in item else Pose()
        scene = scene.with_object(WorldObject(item["id"], placed, pose))
    return scene


def _shape(shape: Mapping[str, Any]) -> Box | Cylinder | Sphere:
    sizes = shape["dimensions"]
    if shape["type"] == "box":
        return Box(tuple(sizes))
    if shape["type"] == "cylinder":
        return Cylinder(sizes[1], sizes[0])
    return Sphere(sizes[0])


def _pose(pose: Mapping[str, Any]) -> Pose:
    return Pose(tuple(pose["position"]), tuple(pose["orientation"]))


def _result(
    scene: PlanningScene, group: str, start: FloatArray, goal: FloatArray
) -> _Result | None:
    begin = time.process_time()
    checker = CollisionChecker(scene, group)
    built = time.process_time()
    if not (checker.is_valid(start) and checker.is_valid(goal)):
        return None
    space = scene.robot.group(group).space
    mark = time.process_time()
    try:
        path = plan(space, checker, start, [goal], search=Search(time_limit_s=_LIMIT_S))
    except PlanningError:
        return _Result(1e3 * (built - begin), 1e3 * (time.process_time() - mark), False, True)
    planned = time.process_time()
    states = path.densified(_FINE_STEP)
    holds = all(checker.is_valid(q) for q in states)
    return _Result(1e3 * (built - begin), 1e3 * (planned - mark), True, holds)


def _print(name: str, results: list[_Result]) -> None:
    if not results:
        print(f"{name:26}  none whose start and goal are free")
        return
    scenes = [item.scene_ms for item in results]
    plans = [item.plan_ms for item in results]
    solved, holds = (sum(getattr(item, key) for item in results) for key in ("solved", "holds"))
    print(
        f"{name:26}{solved:4}/{len(results):<4}{holds:6}{statistics.median(plans):9.2f}"
        f"{np.percentile(plans, 95):8.1f}{max(plans):8.1f}{statistics.median(scenes):11.2f}"
        f"{max(scenes):8.1f}",
        flush=True,
    )


if __name__ == "__main__":
    main()
