"""Speed of the engine: our steps against bare MuJoCo on the same model, and against PyBullet.

Prints steps per second (median of several runs on one core) and the ratio to bare MuJoCo. Run it
with ``python benchmarks/bench_engine.py``; PyBullet takes part where it is installed.
"""

from __future__ import annotations

import argparse
import copy
import statistics
import time
from collections.abc import Callable

import mujoco

from gazelle.description.model import (
    Box,
    Collision,
    Cylinder,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    Plane,
    Sphere,
    Surface,
    World,
)
from gazelle.engine import Engine
from gazelle.geometry import Pose

CHUNK = 100
RUNS = 7


def ground() -> Model:
    return Model("ground", static=True, links=(Link("l", collisions=(Collision("c", Plane()),)),))


def solid(mass: float, x: float, y: float, z: float) -> Inertial:
    moments = (y * y + z * z, x * x + z * z, x * x + y * y)
    i = [mass / 12 * value for value in moments]
    return Inertial(mass, inertia_kg_m2=(i[0], 0, 0, i[1], 0, i[2]))


def robot() -> Model:
    """A differential drive with a slippery caster."""
    base = Link(
        "base",
        Pose((0, 0, 0.1)),
        inertial=solid(5.0, 0.4, 0.3, 0.1),
        collisions=(
            Collision("box", Box((0.4, 0.3, 0.1))),
            Collision(
                "caster", Sphere(0.05), Pose((-0.15, 0, -0.05)), surface=Surface(mu1=0, mu2=0)
            ),
        ),
    )
    links, joints = [base], []
    for side, y in (("left", 0.18), ("right", -0.18)):
        pose = Pose.from_xyz_rpy((0.1, y, 0.1), (1.5707963, 0, 0))
        shape = Collision("tyre", Cylinder(0.1, 0.04))
        links.append(Link(side, pose, inertial=solid(0.5, 0.1, 0.1, 0.1), collisions=(shape,)))
        axis = JointAxis((0, 1, 0))
        joints.append(
            Joint(
                f"{side}_joint",
                JointType.CONTINUOUS,
                "base",
                side,
                Pose(pose.position_m),
                axis=axis,
            )
        )
    return Model("robot", links=tuple(links), joints=tuple(joints))


def boxes(count: int, row: float = 1.0) -> list[Model]:
    shape = Collision("c", Box((0.2, 0.2, 0.2)))
    link = Link("l", inertial=solid(1.0, 0.2, 0.2, 0.2), collisions=(shape,))
    return [
        Model(f"box{i}", Pose((1 + 0.5 * (i % 5), row + 0.5 * (i // 5), 0.1)), links=(link,))
        for i in range(count)
    ]


def scene(name: str) -> Engine:
    models = [ground(), robot(), *(boxes(20) if "boxes" in name else [])]
    engine = Engine(World(models=tuple(models)))
    if "driving" in name:
        for side in ("left", "right"):
            engine.joint(f"robot::{side}_joint").set_velocity_target(3.0, 5.0)
    engine.step(1)
    if "awake" in name:
        engine.model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    engine.step(1000)
    return engine


def rate(step: Callable[[int], object], steps: int) -> float:
    start = time.process_time()
    for _ in range(steps // CHUNK):
        step(CHUNK)
    return steps / (time.process_time() - start)


def pybullet_rate(name: str, steps: int) -> float | None:
    try:
        import pybullet as p
    except ImportError:
        return None
    client = p.connect(p.DIRECT)
    p.setGravity(0, 0, -9.8)
    p.setTimeStep(0.001)
    p.createMultiBody(0, p.createCollisionShape(p.GEOM_PLANE))
    cube = p.createCollisionShape(p.GEOM_BOX, halfExtents=[0.1] * 3)
    for i in range(20 if "boxes" in name else 0):
        p.createMultiBody(1.0, cube, basePosition=[1 + 0.5 * (i % 5), 1 + 0.5 * (i // 5), 0.1])
    wheel = p.createCollisionShape(p.GEOM_CYLINDER, radius=0.1, height=0.04)
    turned = p.getQuaternionFromEuler([1.5707963, 0, 0])
    body = p.createMultiBody(
        5.0, p.createCollisionShape(p.GEOM_BOX, halfExtents=[0.2, 0.15, 0.05]),
        basePosition=[0, 0, 0.1], linkMasses=[0.5, 0.5], linkCollisionShapeIndices=[wheel, wheel],
        linkVisualShapeIndices=[-1, -1], linkPositions=[[0.1, 0.18, 0], [0.1, -0.18, 0]],
        linkOrientations=[turned, turned], linkInertialFramePositions=[[0, 0, 0]] * 2,
        linkInertialFrameOrientations=[[0, 0, 0, 1]] * 2, linkParentIndices=[0, 0],
        linkJointTypes=[p.JOINT_REVOLUTE] * 2, linkJointAxis=[[0, 0, 1]] * 2,
    )  # fmt: skip
    for joint in (0, 1):
        speed = -3.0 if "driving" in name else 0.0
        p.setJointMotorControl2(body, joint, p.VELOCITY_CONTROL, targetVelocity=speed, force=5)

    def step(count: int) -> None:
        for _ in range(count):
            p.stepSimulation()

    step(1000)
    result = statistics.median(rate(step, steps // 4) for _ in range(3))
    p.disconnect(client)
    return result


def compare(name: str, steps: int) -> None:
    engine = scene(name)
    model, data = engine.model, copy.copy(engine.data)
    ours, bare = [], []
    for _ in range(RUNS):
        ours.append(rate(engine.step, steps))
        bare.append(rate(lambda count: mujoco.mj_step(model, data, count), steps))
    peer = pybullet_rate(name, steps)
    mine, theirs = statistics.median(ours), statistics.median(bare)
    other = f"{peer:>12,.0f}" if peer else f"{'not here':>12}"
    print(f"{name:<34}{mine:>12,.0f}{theirs:>14,.0f}{theirs / mine:>10.3f}{other}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=20000, help="steps per run")
    steps = parser.parse_args().steps
    print(f"steps per CPU second, {CHUNK} steps a call, median of {RUNS} runs of {steps}\n")
    print(f"{'scene':<34}{'Gazelle':>12}{'bare MuJoCo':>14}{'time':>10}{'PyBullet':>12}")
    for name in (
        "robot at rest, asleep",
        "robot at rest, awake",
        "robot driving, awake",
        "robot driving + 20 boxes, awake",
        "robot driving + 20 boxes, asleep",
        "robot + 20 boxes at rest, asleep",
    ):
        compare(name, steps)


if __name__ == "__main__":
    main()
