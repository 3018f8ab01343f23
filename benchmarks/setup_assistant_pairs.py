"""What the Setup Assistant finds beside what config packages have: pairs of links, groups.

Run ``python benchmarks/setup_assistant_pairs.py PACKAGE_FOLDER …`` from the repository; the
packages' robots have to be found from where the folders are.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from pathlib import Path

from gazelle.description.moveit import read_moveit_config
from gazelle.diagnostics import Diagnostics
from gazelle.motion.model import RobotModel
from gazelle.motion.setup_assistant import self_collision_matrix
from gazelle.motion.setup_assistant.kinematic_tree import KinematicTree

_SHOWN = 6


def main() -> None:
    """Print a paragraph for each package."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--trials", type=int, default=10_000)
    options = parser.parse_args()
    for folder in options.folders:
        _compare(folder, options.trials)


def _compare(folder: Path, trials: int) -> None:
    config = read_moveit_config(folder, diagnostics=Diagnostics())
    if config is None:
        print(f"{folder.name}: its robot cannot be read")
        return
    robot = RobotModel.build(config.robot, diagnostics=Diagnostics())
    begin = time.perf_counter()
    matrix = self_collision_matrix(robot, trials=trials)
    took_s = time.perf_counter() - begin
    solid = set(matrix.links)
    theirs = {
        (min(one.link1, one.link2), max(one.link1, one.link2)): one.reason
        for one in config.srdf.disabled_pairs
        if {one.link1, one.link2} <= solid
    }
    ours = {(one.link1, one.link2): one.reason for one in matrix.disabled()}
    same = sum(ours.get(pair) == reason for pair, reason in theirs.items())
    print(f"{folder.name}: {len(matrix.pairs)} pairs in {took_s:.1f} s; ", end="")
    print(f"theirs {len(theirs)}, ours {len(ours)}, same {same}")
    _list(
        "another reason",
        {p: f"{r}, ours {ours[p]}" for p, r in theirs.items() if ours.get(p, r) != r},
    )
    _list("only theirs", {pair: reason for pair, reason in theirs.items() if pair not in ours})
    _list("only ours", {pair: reason for pair, reason in ours.items() if pair not in theirs})
    groups, _ = KinematicTree(robot).groups()
    print(f"    groups of theirs: {_groups(config.srdf.groups)}")
    print(f"    groups of ours:   {_groups(groups)}")


def _list(title: str, rows: dict[tuple[str, str], str]) -> None:
    if rows:
        counts = ", ".join(f"{count} {reason}" for reason, count in Counter(rows.values()).items())
        shown = "; ".join(f"{a} and {b}" for a, b in list(rows)[:_SHOWN])
        print(f"    {title}: {counts} ({shown}{' …' if len(rows) > _SHOWN else ''})")


def _groups(groups: object) -> str:
    rows = []
    for group in groups:  # type: ignore[attr-defined]
        chains = [f"{one.base_link} to {one.tip_link}" for one in group.chains]
        rows.append(f"{group.name} ({', '.join([*chains, *group.links, *group.joints])})")
    return "; ".join(rows)


if __name__ == "__main__":
    main()
