"""What the two halves of the bridge say to each other."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from typing import IO, NamedTuple

import pytest

from gazelle.bridge.ros2.rclpy_side.pipes import Frame, FrameKind, Pipes


class Ends(NamedTuple):
    here: Pipes
    there: Pipes


@pytest.fixture
def ends() -> Iterator[Ends]:
    (read_a, write_a), (read_b, write_b) = os.pipe(), os.pipe()
    files: list[IO[bytes]] = [os.fdopen(read_a, "rb"), os.fdopen(write_a, "wb", 0)]
    files += [os.fdopen(read_b, "rb"), os.fdopen(write_b, "wb", 0)]
    yield Ends(Pipes(files[0], files[3]), Pipes(files[2], files[1]))
    for file in files:
        file.close()


def test_frames_arrive_as_they_were_sent(ends: Ends) -> None:
    ends.here.send(FrameKind.MESSAGE, 7, 9, b"\0\1\0\0hello")
    ends.here.send_control(do="drop", channel=7)
    ends.here.send(FrameKind.FAILURE, 0xFFFFFFFF, 1, b"")
    assert ends.there.receive() == Frame(FrameKind.MESSAGE, 7, 9, b"\0\1\0\0hello")
    assert ends.there.receive().control() == {"do": "drop", "channel": 7}
    assert ends.there.receive() == Frame(FrameKind.FAILURE, 0xFFFFFFFF, 1, b"")


def test_frames_of_many_threads_do_not_mix(ends: Ends) -> None:
    """Images are larger than a pipe holds and are written in pieces."""
    sizes = {1: 900_000, 2: 3, 3: 70_000}

    def send(channel: int) -> None:
        for number in range(5):
            data = bytes([channel]) * sizes[channel]
            ends.here.send(FrameKind.MESSAGE, channel, number, data)

    threads = [threading.Thread(target=send, args=(one,)) for one in sizes]
    for thread in threads:
        thread.start()
    seen: dict[int, list[int]] = {1: [], 2: [], 3: []}
    for _ in range(15):
        frame = ends.there.receive()
        assert frame.data == bytes([frame.channel]) * sizes[frame.channel]
        seen[frame.channel].append(frame.number)
    assert all(numbers == [0, 1, 2, 3, 4] for numbers in seen.values())
    for thread in threads:
        thread.join()


def test_end_of_the_other_half_is_told(ends: Ends) -> None:
    ends.there.send(FrameKind.MESSAGE, 1, 1, b"abc")
    ends.there.close()
    assert ends.here.receive().data == b"abc"
    with pytest.raises(EOFError, match="the other side of the bridge has gone"):
        ends.here.receive()
    with pytest.raises(ValueError, match="closed file"):
        ends.there.send(FrameKind.MESSAGE, 1, 1, b"abc")


def test_a_program_that_prints_is_no_half_of_a_bridge() -> None:
    reader, writer = os.pipe()
    os.write(writer, b"Welcome to ROS 2 \xff\xff\xff\xff!")
    with os.fdopen(reader, "rb") as file, os.fdopen(writer, "wb", 0) as out:
        out.close()
        with pytest.raises(EOFError):
            Pipes(file, out).receive()
