from __future__ import annotations

import threading

import pytest
from tests.patience import stretched

from gazelle.errors import GazelleError
from gazelle.graph.subscription import MAX_WAITING, Backlog
from gazelle.simulator.command_queue import CommandQueue


def _never(error: Exception) -> None:
    raise AssertionError("a command failed") from error


def test_commands_act_at_once_while_nobody_runs_the_loop() -> None:
    queue, done = CommandQueue(_never), []
    queue.post(lambda: done.append(1))
    assert queue.call(lambda: 7) == 7
    assert done == [1]


def test_commands_of_other_threads_wait_for_the_loop() -> None:
    queue, done = CommandQueue(_never), []
    queue.own()
    thread = threading.Thread(target=lambda: done.append(queue.call(lambda: "result")))
    thread.start()
    assert queue.wait(stretched(30.0))
    assert done == []
    queue.apply()
    thread.join(stretched(30.0))
    queue.disown()
    assert done == ["result"]


def test_an_error_reaches_the_caller() -> None:
    queue = CommandQueue(_never)
    queue.own()
    caught: list[BaseException] = []

    def call() -> None:
        try:
            queue.call(lambda: 1 / 0)
        except ZeroDivisionError as error:
            caught.append(error)

    thread = threading.Thread(target=call)
    thread.start()
    queue.wait(stretched(30.0))
    queue.apply()
    thread.join(stretched(30.0))
    queue.disown()
    assert len(caught) == 1


def test_a_call_that_nobody_takes_says_so() -> None:
    queue = CommandQueue(_never)
    errors: list[str] = []
    queue.own()

    def call() -> None:
        try:
            queue.call(lambda: None, timeout_s=0.01)
        except GazelleError as error:
            errors.append(str(error))

    thread = threading.Thread(target=call)
    thread.start()
    thread.join(stretched(30.0))
    queue.disown()
    assert errors == ["the simulation did not take a command within 0.01 s"]


def test_what_is_queued_when_the_loop_ends_is_applied() -> None:
    queue, done = CommandQueue(_never), []
    queue.own()
    thread = threading.Thread(target=lambda: queue.post(lambda: done.append(1)))
    thread.start()
    thread.join(stretched(30.0))
    queue.disown()
    assert done == [1]


def test_posting_does_not_wait_for_the_command_of_another_thread() -> None:
    """Threads of the transport post: what that command asks of the graph comes through them."""
    queue, done = CommandQueue(_never), []
    acting, posted = threading.Event(), threading.Event()

    def command() -> None:
        acting.set()
        done.append("waited" if posted.wait(stretched(30.0)) else "waited in vain")
        queue.post(lambda: done.append("within"))

    thread = threading.Thread(target=lambda: queue.call(command))
    thread.start()
    assert acting.wait(stretched(30.0))
    queue.post(lambda: done.append("after"))
    posted.set()
    thread.join(stretched(30.0))
    assert done == ["waited", "within", "after"]


@pytest.mark.parametrize("through", ["post", "call"])
def test_the_loops_own_thread_acts_at_once(through: str) -> None:
    queue, done = CommandQueue(_never), []
    queue.own()
    getattr(queue, through)(lambda: done.append(1))
    assert done == [1]
    queue.disown()


def test_a_command_that_waits_while_a_loop_begins_is_taken_by_the_loop() -> None:
    """A spawner calls while a robot is being spawned, before the world's loop has begun."""
    queue, done = CommandQueue(_never), []
    acting, go_on, end = threading.Event(), threading.Event(), threading.Event()

    def spawn() -> None:
        acting.set()
        go_on.wait(stretched(30.0))

    def loop() -> None:
        queue.own()
        while not end.is_set():
            queue.wait(0.05)
            queue.apply()
        queue.disown()

    def late_call() -> None:
        done.append(queue.call(lambda: "taken"))

    threads = [threading.Thread(target=lambda: queue.call(spawn)), threading.Thread(target=loop)]
    threads[0].start()
    assert acting.wait(stretched(30.0))
    threads[1].start()
    late = threading.Thread(target=late_call)
    late.start()
    late.join(0.1)
    go_on.set()
    late.join(stretched(2.0))
    answered = list(done)
    end.set()
    for thread in threads:
        thread.join(stretched(30.0))
    assert answered == ["taken"]


def test_what_a_posted_command_raises_is_told_and_the_next_one_acts() -> None:
    told: list[Exception] = []
    queue, done = CommandQueue(told.append), []
    queue.own()
    poster = threading.Thread(
        target=lambda: (queue.post(lambda: 1 / 0), queue.post(lambda: done.append(1)))
    )
    poster.start()
    poster.join(stretched())
    queue.apply()
    queue.disown()
    assert [type(error) for error in told] == [ZeroDivisionError]
    assert done == [1]


def test_a_command_that_was_given_up_never_begins() -> None:
    """Its caller was told that it was not taken."""
    queue, done = CommandQueue(_never), []
    queue.own()
    thread = threading.Thread(target=lambda: _call_in_vain(queue, done))
    thread.start()
    thread.join(stretched())
    queue.apply()
    queue.disown()
    assert done == ["given up"]


def _call_in_vain(queue: CommandQueue, done: list[str]) -> None:
    with pytest.raises(GazelleError, match="did not take a command within"):
        queue.call(lambda: done.append("acted"), timeout_s=0.01)
    done.append("given up")


def test_of_the_messages_that_wait_for_a_busy_world_the_oldest_go_first() -> None:
    """As many as a topic sends while a world loads something, stands still or is stopped."""
    queue, told, done = CommandQueue(_never), [], []
    backlog = Backlog(queue.post, done.append, lambda: told.append("told"))
    queue.own()
    poster = threading.Thread(target=lambda: [backlog.put(n) for n in range(MAX_WAITING + 50)])
    poster.start()
    poster.join(stretched())
    queue.apply()
    assert done == list(range(50, MAX_WAITING + 50))
    assert told == ["told"]
    backlog.put("next")
    queue.disown()
    assert done[-1] == "next"
