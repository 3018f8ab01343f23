"""Control nodes of BehaviorTree.CPP and Nav2: who is ticked next."""

from __future__ import annotations

from typing import ClassVar

from gazelle.nodes.nav2.behavior_trees.tree_node import Status, TreeNode

__all__ = ["CONTROLS"]

_S = Status


class _Control(TreeNode):
    CHILDREN: ClassVar[tuple[int, int | None]] = (1, None)

    def begin(self) -> None:
        self.index = 0
        self.skipped = 0

    def halted(self) -> None:
        self.begin()

    def finish(self, status: Status) -> Status:
        """End: everything below is idle again."""
        self.halt_children()
        self.begin()
        return status


class _InOrder(_Control):
    """Children one after another until one of them says `STOPS`."""

    STOPS = _S.FAILURE
    KEEPS_INDEX = False

    def tick(self) -> Status:
        while self.index < len(self.children):
            status = self.children[self.index].execute()
            if status is _S.RUNNING:
                return status
            if status is self.STOPS:
                if self.KEEPS_INDEX:
                    self.halt_children(self.index)
                    return status
                return self.finish(status)
            self.skipped += status is _S.SKIPPED
            self.index += 1
        if self.skipped == len(self.children):
            return self.finish(_S.SKIPPED)
        return self.finish(_S.SUCCESS if self.STOPS is _S.FAILURE else _S.FAILURE)


class _Sequence(_InOrder):
    """Until one fails; goes on where it was."""


class _SequenceWithMemory(_InOrder):
    """The same, and a child that failed is tried again without those before it."""

    KEEPS_INDEX = True


class _Fallback(_InOrder):
    """Until one succeeds; goes on where it was."""

    STOPS = _S.SUCCESS


class _Reactive(_Control):
    """All children from the first one at each tick."""

    STOPS = _S.FAILURE

    def tick(self) -> Status:
        skipped = 0
        for place, child in enumerate(self.children):
            status = child.execute()
            if status is _S.RUNNING:
                for other in (*self.children[:place], *self.children[place + 1 :]):
                    self.halt_child(other)
                return status
            if status is self.STOPS:
                return self.finish(status)
            skipped += status is _S.SKIPPED
        if skipped == len(self.children):
            return self.finish(_S.SKIPPED)
        return self.finish(_S.SUCCESS if self.STOPS is _S.FAILURE else _S.FAILURE)


class _ReactiveSequence(_Reactive):
    """Until one fails, from the first one at each tick."""


class _ReactiveFallback(_Reactive):
    """Until one succeeds, from the first one at each tick."""

    STOPS = _S.SUCCESS


class _Parallel(_Control):
    """All at once, until so many have succeeded or failed; −1 means all."""

    INPUTS = (
        "success_threshold", "failure_threshold", "success_count", "failure_count", "max_failures",
    )  # fmt: skip

    def _count(self, names: tuple[str, str], default: int) -> int:
        given = next((name for name in names if self.ports.has(name)), names[0])
        count = int(self.ports.number(given, default))
        return max(0, len(self.children) + count + 1) if count < 0 else count

    def tick(self) -> Status:
        need = self._count(("success_count", "success_threshold"), -1)
        limit = self._count(("failure_count", "failure_threshold"), 1)
        for child in self.children:
            if not child.status.is_done and child.status is not _S.SKIPPED:
                child.execute()
        found = [child.status for child in self.children]
        if all(status is _S.SKIPPED for status in found):
            return self.finish(_S.SKIPPED)
        good, bad = found.count(_S.SUCCESS), found.count(_S.FAILURE)
        skipped = found.count(_S.SKIPPED)
        if good >= need or (need == len(found) and good + skipped >= need):
            return self.finish(_S.SUCCESS)
        if bad >= limit or len(found) - bad < need:
            return self.finish(_S.FAILURE)
        return _S.RUNNING


class _ParallelAll(_Parallel):
    """All at once, to the end of all; fails with more than `max_failures`."""

    def tick(self) -> Status:
        for child in self.children:
            if not child.status.is_done and child.status is not _S.SKIPPED:
                child.execute()
        found = [child.status for child in self.children]
        if _S.RUNNING in found:
            return _S.RUNNING
        limit = self._count(("max_failures", "max_failures"), 1)
        return self.finish(_S.FAILURE if found.count(_S.FAILURE) >= limit else _S.SUCCESS)


class _IfThenElse(_Control):
    """The first child decides, once, which of the others runs."""

    CHILDREN = (2, 3)

    def tick(self) -> Status:
        if self.index == 0:
            status = self.children[0].execute()
            if status in (_S.RUNNING, _S.SKIPPED):
                return status
            if status is _S.FAILURE and len(self.children) == 2:
                return self.finish(status)
            self.index = 1 if status is _S.SUCCESS else 2
        status = self.children[self.index].execute()
        return status if status is _S.RUNNING else self.finish(status)


class _WhileDoElse(_Control):
    """The first child decides, at each tick, which of the others runs."""

    CHILDREN = (2, 3)

    def tick(self) -> Status:
        status = self.children[0].execute()
        if status is _S.RUNNING:
            return status
        if status is _S.FAILURE and len(self.children) == 2:
            return self.finish(status)
        chosen = 1 if status is _S.SUCCESS else 2
        for place in (1, 2):
            if place != chosen and place < len(self.children):
                self.halt_child(self.children[place])
        status = self.children[chosen].execute()
        return status if status is _S.RUNNING else self.finish(status)


class _Switch(_Control):
    """The child whose case is the variable's value, else the last one."""

    INPUTS = ("variable", *(f"case_{number}" for number in range(1, 7)))

    def begin(self) -> None:
        super().begin()
        self.index = -1

    def tick(self) -> Status:
        last = len(self.children) - 1
        value = str(self.ports.get("variable", ""))
        cases = [str(self.ports.get(f"case_{place + 1}", "")) for place in range(last)]
        chosen = cases.index(value) if value in cases else last
        if 0 <= self.index != chosen:
            self.halt_child(self.children[self.index])
        self.index = chosen
        status = self.children[chosen].execute()
        return status if status is _S.RUNNING else self.finish(status)


class _PipelineSequence(_Control):
    """Nav2: all up to the one that was reached last are ticked again, each time."""

    def tick(self) -> Status:
        skipped = 0
        for place, child in enumerate(self.children):
            status = child.execute()
            if status is _S.FAILURE:
                return self.finish(status)
            if status is _S.RUNNING and place >= self.index:
                self.index = place
                return status
            skipped += status is _S.SKIPPED
        return self.finish(_S.SKIPPED if skipped == len(self.children) else _S.SUCCESS)


class _RecoveryNode(_Control):
    """Nav2: the second child after a failure of the first one, so many times."""

    INPUTS = ("number_of_retries",)
    CHILDREN = (2, 2)

    def begin(self) -> None:
        super().begin()
        self.retries = 0

    def tick(self) -> Status:
        most = int(self.ports.number("number_of_retries", 1))
        while True:
            status = self.children[self.index].execute()
            if status is _S.RUNNING:
                return status
            if self.index == 0:
                if status is not _S.FAILURE or self.retries >= most:
                    return self.finish(status)
                self.halt_child(self.children[0])
                self.index = 1
                continue
            if status is _S.FAILURE:
                return self.finish(status)
            self.halt_child(self.children[1])
            self.retries += 1
            self.index = 0


class _RoundRobin(_Control):
    """Nav2: the next child at each time, until one succeeds; it remembers whose turn it is."""

    def tick(self) -> Status:
        failed = skipped = 0
        while failed + skipped < len(self.children):
            status = self.children[self.index].execute()
            if status is _S.RUNNING:
                return status
            self.index = (self.index + 1) % len(self.children)
            if status is _S.SUCCESS:
                self.halt_children()
                return status
            failed += status is _S.FAILURE
            skipped += status is _S.SKIPPED
        return self.finish(_S.SKIPPED if skipped == len(self.children) else _S.FAILURE)


class _NonblockingSequence(_Control):
    """Nav2: every child at each tick, whether those before it run or not."""

    def tick(self) -> Status:
        running = False
        for child in self.children:
            status = child.status
            if status is not _S.SUCCESS:
                status = child.execute()
            if status is _S.FAILURE:
                return self.finish(status)
            running = running or status is _S.RUNNING
        return _S.RUNNING if running else self.finish(_S.SUCCESS)


CONTROLS: dict[str, type[TreeNode]] = {
    "Sequence": _Sequence,
    "SequenceStar": _SequenceWithMemory,
    "SequenceWithMemory": _SequenceWithMemory,
    "AsyncSequence": _Sequence,
    "Fallback": _Fallback,
    "FallbackStar": _Fallback,
    "AsyncFallback": _Fallback,
    "ReactiveSequence": _ReactiveSequence,
    "ReactiveFallback": _ReactiveFallback,
    "Parallel": _Parallel,
    "ParallelAll": _ParallelAll,
    "IfThenElse": _IfThenElse,
    "WhileDoElse": _WhileDoElse,
    **{f"Switch{number}": _Switch for number in range(2, 7)},
    "PipelineSequence": _PipelineSequence,
    "RecoveryNode": _RecoveryNode,
    "RoundRobin": _RoundRobin,
    "NonblockingSequence": _NonblockingSequence,
}
"""Control nodes by their names in XML."""
