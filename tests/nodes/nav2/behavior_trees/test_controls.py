"""Control nodes: which children are ticked, and what that comes to.

The expectations are the originals' documented behaviour (behaviortree.dev and docs.nav2.org).
"""

from __future__ import annotations

import pytest

from gazelle.nodes.nav2.behavior_trees.tree_node import Status

RUNNING, SUCCESS, FAILURE = Status.RUNNING, Status.SUCCESS, Status.FAILURE


def _wait(name: str) -> str:
    return f'<Wait name="{name}" wait_duration="1"/>'


def _names(world) -> list[str]:
    return [call.name for call in world.calls]


def test_sequence_goes_on_with_the_child_that_ran(plant, world) -> None:
    tree = plant(f"<Sequence><AlwaysSuccess/>{_wait('a')}<Spin/></Sequence>")
    assert tree.execute() is RUNNING
    assert tree.execute() is RUNNING
    assert _names(world) == ["wait"]
    world.calls[0].end(succeeded=True)
    assert tree.execute() is RUNNING
    assert _names(world) == ["wait", "spin"]
    world.calls[1].end(succeeded=False)
    assert tree.execute() is FAILURE
    assert tree.execute() is RUNNING
    assert _names(world) == ["wait", "spin", "wait"]


def test_sequence_with_memory_tries_only_the_child_that_failed_again(plant, world) -> None:
    tree = plant(f"<SequenceWithMemory>{_wait('a')}<Spin/></SequenceWithMemory>")
    tree.execute()
    world.calls[0].end(succeeded=True)
    tree.execute()
    world.calls[1].end(succeeded=False)
    assert tree.execute() is FAILURE
    assert tree.execute() is RUNNING
    assert _names(world) == ["wait", "spin", "spin"]


def test_reactive_sequence_asks_conditions_at_each_tick_and_halts_what_runs(plant, world) -> None:
    tree = plant(
        f'<ReactiveSequence><ScriptCondition code="ok == 1"/>{_wait("a")}</ReactiveSequence>', ok=1
    )
    assert tree.execute() is RUNNING
    tree.ports.blackboard.set("ok", 0)
    assert tree.execute() is FAILURE
    assert world.calls[0].cancelled


def test_fallback_takes_the_first_that_succeeds(plant, world) -> None:
    tree = plant(f"<Fallback><AlwaysFailure/>{_wait('a')}<AlwaysFailure/></Fallback>")
    assert tree.execute() is RUNNING
    world.calls[0].end(succeeded=True)
    assert tree.execute() is SUCCESS
    assert plant("<Fallback><AlwaysFailure/><AlwaysFailure/></Fallback>").execute() is FAILURE


def test_reactive_fallback_stops_the_rest_when_an_earlier_child_succeeds(plant, world) -> None:
    tree = plant(
        f'<ReactiveFallback><ScriptCondition code="ok == 1"/>{_wait("a")}</ReactiveFallback>', ok=0
    )
    assert tree.execute() is RUNNING
    tree.ports.blackboard.set("ok", 1)
    assert tree.execute() is SUCCESS
    assert world.calls[0].cancelled


@pytest.mark.parametrize(
    ("ports", "ends", "status"),
    [
        ('success_count="1"', [True, None], SUCCESS),
        ('success_count="2"', [True, None], RUNNING),
        ("", [True, True], SUCCESS),
        ("", [False, None], FAILURE),
        ('failure_count="2" success_count="1"', [False, None], RUNNING),
        ('success_threshold="1"', [True, None], SUCCESS),
    ],
)
def test_parallel_counts(plant, world, ports, ends, status) -> None:
    tree = plant(f"<Parallel {ports}>{_wait('a')}<Spin/></Parallel>")
    assert tree.execute() is RUNNING
    for call, end in zip(list(world.calls), ends, strict=True):
        if end is not None:
            call.end(succeeded=end)
    assert tree.execute() is status


def test_parallel_all_waits_for_everybody(plant, world) -> None:
    tree = plant(f'<ParallelAll max_failures="2">{_wait("a")}<Spin/></ParallelAll>')
    tree.execute()
    world.calls[0].end(succeeded=False)
    assert tree.execute() is RUNNING
    world.calls[1].end(succeeded=True)
    assert tree.execute() is SUCCESS


@pytest.mark.parametrize(("value", "status"), [(1, SUCCESS), (0, FAILURE)])
def test_if_then_else_chooses(plant, value, status) -> None:
    children = '<ScriptCondition code="x"/><AlwaysSuccess/><AlwaysFailure/>'
    assert plant(f"<IfThenElse>{children}</IfThenElse>", x=value).execute() is status
    assert plant(f"<WhileDoElse>{children}</WhileDoElse>", x=value).execute() is status


def test_while_do_else_changes_its_mind(plant, world) -> None:
    nodes = f'<ScriptCondition code="x"/>{_wait("a")}<Spin/>'
    tree = plant(f"<WhileDoElse>{nodes}</WhileDoElse>", x=1)
    tree.execute()
    tree.ports.blackboard.set("x", 0)
    assert tree.execute() is RUNNING
    assert world.calls[0].cancelled
    assert _names(world) == ["wait", "spin"]


@pytest.mark.parametrize(("value", "status"), [("a", SUCCESS), ("b", FAILURE), ("z", SUCCESS)])
def test_switch_takes_the_case_or_the_last_child(plant, value, status) -> None:
    nodes = "<AlwaysSuccess/><AlwaysFailure/><AlwaysSuccess/>"
    xml = f'<Switch2 variable="{{v}}" case_1="a" case_2="b">{nodes}</Switch2>'
    assert plant(xml, v=value).execute() is status


def test_pipeline_sequence_ticks_earlier_children_again(plant, world) -> None:
    tree = plant(f"<PipelineSequence>{_wait('plan')}<Spin/></PipelineSequence>")
    tree.execute()
    world.calls[0].end(succeeded=True)
    assert tree.execute() is RUNNING
    assert _names(world) == ["wait", "spin"]
    # The first one starts again, and while it runs the second one goes on.
    assert tree.execute() is RUNNING
    assert _names(world) == ["wait", "spin", "wait"]
    world.calls[1].end(succeeded=True)
    assert tree.execute() is SUCCESS


def test_recovery_node_recovers_so_many_times(plant, world) -> None:
    tree = plant(f'<RecoveryNode number_of_retries="2"><Spin/>{_wait("a")}</RecoveryNode>')
    for count in range(2):
        assert tree.execute() is RUNNING
        world.calls[-1].end(succeeded=False)
        assert tree.execute() is RUNNING
        assert _names(world).count("wait") == count + 1
        world.calls[-1].end(succeeded=True)
    assert tree.execute() is RUNNING
    world.calls[-1].end(succeeded=False)
    assert tree.execute() is FAILURE
    assert _names(world) == ["spin", "wait", "spin", "wait", "spin"]


def test_recovery_node_fails_with_its_recovery(plant) -> None:
    xml = '<RecoveryNode number_of_retries="6"><AlwaysFailure/><AlwaysFailure/></RecoveryNode>'
    assert plant(xml).execute() is FAILURE


def test_round_robin_remembers_whose_turn_it_is_until_a_halt(plant, world) -> None:
    tree = plant(f"<RoundRobin>{_wait('a')}<Spin/></RoundRobin>")
    for name in ("wait", "spin", "wait"):
        assert tree.execute() is RUNNING
        assert world.calls[-1].name == name
        world.calls[-1].end(succeeded=True)
        assert tree.execute() is SUCCESS
    tree.halt()
    tree.execute()
    assert world.calls[-1].name == "wait"
    both = plant("<RoundRobin><AlwaysFailure/><AlwaysFailure/></RoundRobin>")
    assert both.execute() is FAILURE


def test_nonblocking_sequence_ticks_what_comes_after_a_running_child(plant, world) -> None:
    tree = plant(f"<NonblockingSequence>{_wait('a')}<Spin/></NonblockingSequence>")
    assert tree.execute() is RUNNING
    assert _names(world) == ["wait", "spin"]
    for call in world.calls:
        call.end(succeeded=True)
    assert tree.execute() is SUCCESS


def test_skipped_children_do_not_count(plant) -> None:
    tree = plant('<Sequence><AlwaysFailure _skipIf="x"/><AlwaysSuccess/></Sequence>', x=1)
    assert tree.execute() is SUCCESS
    tree = plant('<Fallback><AlwaysSuccess _skipIf="x"/><AlwaysFailure/></Fallback>', x=1)
    assert tree.execute() is FAILURE
    assert plant('<Sequence><AlwaysFailure _skipIf="x"/></Sequence>', x=1).execute() is (
        Status.SKIPPED
    )
