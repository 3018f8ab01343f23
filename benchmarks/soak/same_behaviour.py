"""Did a change of the code change what robots do? States and messages, to the last bit.

    python benchmarks/soak/same_behaviour.py [--folder DIR ...] [--seconds S] [--out FILE]
    python benchmarks/soak/same_behaviour.py --compare BEFORE AFTER

Loads every robot, model and world of the examples (and of further folders), drives each for a
while and writes, as JSON, the state's hash and a digest of all messages by topic, or why it does
not load. Run it with the code before (`PYTHONPATH=…/src`) and the code after, then compare: exit
code 1 when anything differs.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import json
import os
import sys
from collections import defaultdict
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
KINDS = ("*.urdf", "*.xacro", "*.sdf", "*.world")


def main() -> int:
    """Write what robots do, or compare two such files."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=Path, action="append", default=[ROOT / "examples"])
    parser.add_argument("--seconds", type=float, default=0.4)
    parser.add_argument("--out", type=Path, default=Path("behaviour.json"))
    parser.add_argument("--compare", type=Path, nargs=2, metavar=("BEFORE", "AFTER"))
    options = parser.parse_args()
    if options.compare:
        return _compare(*(json.loads(path.read_text()) for path in options.compare))
    folders = [folder.resolve() for folder in options.folder]
    os.environ["ROS_PACKAGE_PATH"] = os.pathsep.join(map(str, folders))
    os.environ["GAZEBO_MODEL_PATH"] = os.pathsep.join(map(str, folders))
    found = {}
    for folder in folders:
        for path in sorted({path for kind in KINDS for path in folder.rglob(kind)}):
            name = str(Path(folder.name) / path.relative_to(folder))
            found[name] = _behaviour(path, options.seconds)
            print(name, found[name].get("state") or found[name]["error"], flush=True)
    options.out.write_text(json.dumps(found, indent=1))
    return 0


def _behaviour(path: Path, seconds: float) -> dict[str, Any]:
    from gazelle.errors import GazelleError
    from gazelle.simulator import Simulation

    try:
        with Simulation.load(path) as simulation:
            return _driven(simulation, seconds)
    except GazelleError as error:
        return {"error": str(error).splitlines()[0].replace(str(path), path.name)}


def _driven(simulation: Any, seconds: float) -> dict[str, Any]:
    from gazelle.errors import EngineError
    from gazelle.interfaces import message_type, to_cdr

    digests: dict[str, Any] = defaultdict(hashlib.sha256)
    counts: dict[str, int] = defaultdict(int)

    def note(topic: str, message: Any) -> None:
        digests[topic].update(bytes(to_cdr(message)))
        counts[topic] += 1

    topics = simulation.server.node.topics
    for topic in topics:
        simulation.subscribe(topic, lambda message, topic=topic: note(topic, message))
    for name in simulation.server.engine.joint_names:
        # Fixed joints and those of several axes have no effort of their own.
        with contextlib.suppress(EngineError):
            simulation.joint(name).command_effort(0.05)
    velocity = message_type("geometry_msgs/msg/Twist")()
    velocity.linear.x, velocity.angular.z = 0.2, 0.3
    for topic in ("/cmd_vel", "/robot/cmd_vel"):
        simulation.publish(topic, velocity)
    simulation.run(seconds=seconds)
    return {
        "state": simulation.state_hash(),
        "messages": {topic: [counts[topic], one.hexdigest()] for topic, one in digests.items()},
    }


def _compare(before: dict[str, Any], after: dict[str, Any]) -> int:
    differ = sorted(name for name in before | after if before.get(name) != after.get(name))
    for name in differ:
        old, new = before.get(name, {}), after.get(name, {})
        texts = [str(one.get("state") or one.get("error")) for one in (old, new)]
        messages = [one.get("messages", {}) for one in (old, new)]
        topics = [t for t in messages[0] | messages[1] if messages[0].get(t) != messages[1].get(t)]
        print(f"{name}: {texts[0]} -> {texts[1]}; topics that differ: {sorted(topics)}")
    ran = sum("state" in one for one in after.values())
    print(f"{len(before | after)} files, {ran} run, {len(differ)} differ")
    return bool(differ)


if __name__ == "__main__":
    sys.exit(main())
