"""``ros2 bag play``."""

from __future__ import annotations

import argparse
import re
from functools import partial

from gazelle.bag import Connection, bag_types, open_bag
from gazelle.bag.open_bag import warn_of_unindexed
from gazelle.bag.playing import Controls, Player, PlayOptions
from gazelle.bag.playing.controls import keyboard
from gazelle.cli.ros2.bag import log_line
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.graph import Graph
from gazelle.process_lifetime import at_stop_signal

__all__ = ["main"]

_say = partial(log_line, "rosbag2_player")
_FASTER, _SLOWER = 1.1, 0.9
_KEYS = (
    "Adding keyboard callbacks.",
    "Press SPACE for Pause/Resume",
    "Press CURSOR_RIGHT for Play Next Message",
    "Press CURSOR_UP for Increase Rate 10%",
    "Press CURSOR_DOWN for Decrease Rate 10%",
)


def main(argv: list[str]) -> int:
    """Play a bag until it ends, or until Ctrl-C."""
    options = _options(argv)
    controls = Controls(paused=options.start_paused)
    at_stop_signal(controls.stop)
    with Graph.open(role="client") as graph:
        return _play(graph, options, controls)


def _play(graph: Graph, options: argparse.Namespace, controls: Controls) -> int:
    remaps = dict(word.split(":=", 1) for word in options.remap)
    node = graph.create_node("rosbag2_player", remappings=remaps)
    node.on_shutdown(lambda _reason: controls.stop())
    bag = open_bag(options.bag_path)
    warn_of_unindexed(bag)
    learn_workspace_types()
    for name in bag_types(bag.connections).differing:
        text = f"{name} is defined differently on this machine; it is played as it is"
        _say("warn", f"{text} [bag.other-definition]")
    topics = frozenset(one.topic for one in bag.connections if _wanted(one, options))
    how = PlayOptions(
        rate=options.rate,
        start_s=options.start_offset,
        duration_s=None if options.playback_duration < 0 else options.playback_duration,
        clock_hz=options.clock,
        topics=topics or frozenset([""]),
    )
    player = Player(node, [bag], how, controls, _say, lambda *_args: None)
    _say("info", f"Set rate to {options.rate:g}")

    def on_key(key: str) -> None:
        if key == " ":
            controls.toggle()
            _say("info", "Pausing play." if controls.paused else "Resuming play.")
        elif key == "C":
            controls.step()
        elif key in "AB":
            player.timeline.set_rate(player.timeline.rate * (_FASTER if key == "A" else _SLOWER))
            _say("info", f"Set rate to {player.timeline.rate:g}")

    for text in () if options.disable_keyboard_controls else _KEYS:
        _say("info", text)
    controls.wait(options.delay)
    with keyboard(on_key if not options.disable_keyboard_controls else lambda _key: None):
        while True:
            player.play()
            if not options.loop or controls.stopped:
                return 0


def _wanted(one: Connection, options: argparse.Namespace) -> bool:
    if options.exclude and re.fullmatch(options.exclude, one.topic):
        return False
    if options.topics or options.regex:
        named = one.topic in {f"/{topic.lstrip('/')}" for topic in options.topics}
        return named or bool(options.regex and re.fullmatch(options.regex, one.topic))
    return True


def _options(argv: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="ros2 bag play", description="Play back ROS data")
    add = parser.add_argument
    real, flag = partial(add, type=float), partial(add, action="store_true")
    add("bag_path", help="Bag to open")
    add("-s", "--storage", help="accepted: the file itself tells its format")
    add("--read-ahead-queue-size", type=int, help="accepted: messages are always read ahead")
    real("-r", "--rate", default=1.0, help="rate at which to play back messages (> 0)")
    add("--topics", nargs="+", default=[], help="topics to replay")
    add("-e", "--regex", default="", help="play topics that match this regular expression")
    add("-x", "--exclude", "--exclude-regex", default="", help="leave these topics out")
    add("-m", "--remap", nargs="+", default=[], help="topics to be published as others: a:=b")
    flag("-l", "--loop", help="play again and again")
    real("--clock", nargs="?", const=40.0, default=0.0, help="publish /clock so often (40 Hz)")
    real("-d", "--delay", default=0.2, help="seconds to wait before playing")
    real("--start-offset", default=0.0, help="start so many seconds in")
    real("--playback-duration", default=-1.0, help="play so many seconds; negative: all")
    flag("-p", "--start-paused", help="start paused")
    flag("--disable-keyboard-controls", help="do not listen to keys")
    options = parser.parse_args(argv)
    if options.rate <= 0:
        parser.error("argument -r/--rate: must be more than 0")
    for word in options.remap:
        if ":=" not in word:
            parser.error(f"argument -m/--remap: '{word}' is not written old:=new")
    return options
