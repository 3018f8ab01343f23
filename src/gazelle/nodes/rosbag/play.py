"""``rosbag play``."""

from __future__ import annotations

import sys
import threading
import time
from functools import partial
from optparse import OptionParser, Values

from gazelle.bag import BagReader, bag_types, open_bag
from gazelle.bag.open_bag import warn_of_unindexed
from gazelle.bag.playing import Controls, Player, PlayOptions
from gazelle.bag.playing.controls import keyboard
from gazelle.graph import Graph, Node
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node
from gazelle.nodes.rosbag.options import add_flag, option_parser
from gazelle.nodes.workspace_types import learn_workspace_types

__all__ = ["play", "play_options", "run"]

_SHOW_S = 0.05
_LOOK_S = 0.1


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Play as ``rosbag play`` does; the node of launch files."""
    options, paths = play_options(list(arguments.rest))
    controls = Controls(paused=options.pause)

    def follow() -> None:
        stop.wait()
        controls.stop()

    threading.Thread(target=follow, daemon=True).start()
    # Its own /clock must not be the time it goes by.
    graph.clock.use(False)
    node = start_node(arguments, graph)
    node.on_shutdown(lambda _reason: controls.stop())
    return play(node, options, paths, controls)


def play_options(argv: list[str]) -> tuple[Values, list[str]]:
    """Return the options and the bags; ends the process when they are wrong."""
    for index, word in enumerate(argv):
        if word in ("--topics", "--pause-topics", "--bags"):
            # These take all words up to the next option.
            end = next(
                (k for k, item in enumerate(argv[index + 1 :], index + 1) if item[:1] == "-"),
                len(argv),
            )
            values = ",".join(argv[index + 1 : end])
            argv = [*argv[:index], f"{word}={values}", *argv[end:]]
            return play_options(argv)
    parser = _parser()
    options, paths = parser.parse_args(argv)
    paths += [one for one in (options.bags or "").split(",") if one]
    if not paths:
        parser.error("You must specify at least one bag file to play back.")
    if options.rate <= 0:
        parser.error("option -r: the rate must be more than 0")
    if options.hz <= 0:
        parser.error("option --hz: the frequency must be more than 0")
    return options, paths


def play(node: Node, options: Values, paths: list[str], controls: Controls) -> int:
    """Play as the options say.

    Raises:
        BagError: a bag cannot be read.
    """
    bags = [_open(node, path, quiet=options.quiet) for path in paths]
    screen = _Screen(options)

    def say(level: str, text: str) -> None:
        node.log(level, text)

    player = Player(node, bags, _how(options), controls, say, screen.show)
    _wait_for_others(player, options, controls)
    screen.print("\nHit space to toggle paused, or 's' to step.")

    def on_key(key: str) -> None:
        if key == " ":
            controls.toggle()
        elif key == "s":
            controls.step()

    with keyboard(on_key):
        while True:
            player.play()
            if not options.loop or controls.stopped:
                break
        if not controls.stopped and options.keep_alive:
            screen.print("\nDone. Keeping alive.")
            while not controls.stopped:
                player.tick()
                controls.wait(_LOOK_S)
    if not controls.stopped:
        screen.print("\nDone.")
    return 0


class _Screen:
    """Draws the line of the time, not more often than anybody can read."""

    def __init__(self, options: Values) -> None:
        self._quiet = options.quiet
        self._drawn_s = 0.0
        self._word = ""

    def print(self, text: str) -> None:
        if not self._quiet:
            _write(f"{text}\n")

    def show(self, player: Player, word: str, stamp_ns: int) -> None:
        now_s = time.monotonic()
        if self._quiet or (now_s - self._drawn_s < _SHOW_S and word == self._word):
            return
        self._drawn_s, self._word = now_s, word
        passed_s = (stamp_ns - player.start_ns) / 1e9
        span = f"{passed_s:.6f} / {player.length_ns / 1e9:.6f}"
        text = f" [{word}]  Bag Time: {stamp_ns / 1e9:13.6f}   Duration: {span}"
        _write(f"\r{text}               \r")


def _write(text: str) -> None:
    sys.stdout.write(text)
    sys.stdout.flush()


def _open(node: Node, path: str, *, quiet: bool) -> BagReader:
    if not quiet:
        node.log("info", f"Opening {path}")
    bag = open_bag(path)
    warn_of_unindexed(bag)
    learn_workspace_types()
    for name in bag_types(bag.connections).differing:
        text = f"{path} defines {name} differently from this machine; it is played as it is"
        node.log("warn", f"{text} (ROS: md5sum mismatch) [bag.other-definition]")
    return bag


def _how(options: Values) -> PlayOptions:
    return PlayOptions(
        rate=options.rate,
        start_s=options.start,
        duration_s=options.duration,
        skip_empty_s=options.skip_empty,
        immediate=options.immediate,
        clock_hz=options.hz if options.clock else 0.0,
        topics=frozenset(filter(None, (options.topics or "").split(","))),
        pause_topics=frozenset(filter(None, (options.pause_topics or "").split(","))),
        prefix=options.prefix,
    )


def _wait_for_others(player: Player, options: Values, controls: Controls) -> None:
    if not options.quiet:
        text = f"\nWaiting {options.delay:g} seconds after advertising topics..."
        _write(text)
    controls.wait(options.delay)
    if not options.quiet:
        _write(" done.\n")
    if not options.wait:
        return
    _write("Waiting for subscribers.\n")
    while not controls.stopped and not all(one.matched for one in player.publishers):
        controls.wait(_LOOK_S)
    _write("Finished waiting for subscribers.\n")


def _parser() -> OptionParser:
    parser = option_parser("play BAGFILE1 [BAGFILE2 BAGFILE3 ...]")
    add, flag = parser.add_option, partial(add_flag, parser)
    add("-p", "--prefix", default="", help="prefix all output topics")
    flag("-q", "--quiet", dest="quiet", text="suppress console output")
    flag("-i", "--immediate", dest="immediate", text="play all messages without waiting")
    flag("--pause", dest="pause", text="start in paused mode")
    add("--queue", type="int", default=100, metavar="SIZE", help="accepted: sending never queues")
    flag("--clock", dest="clock", text="publish the clock time")
    add("--hz", type="float", default=100.0, help="how often the clock is published (100)")
    add("-d", "--delay", type="float", default=0.2, metavar="SEC", help="wait after advertising")
    add("-r", "--rate", type="float", default=1.0, metavar="FACTOR", help="multiply the speed")
    add("-s", "--start", type="float", default=0.0, metavar="SEC", help="start SEC seconds in")
    add("-u", "--duration", type="float", metavar="SEC", help="play only SEC seconds")
    add("--skip-empty", type="float", metavar="SEC", help="skip gaps longer than SEC seconds")
    flag("-l", "--loop", dest="loop", text="loop playback")
    flag("-k", "--keep-alive", dest="keep_alive", text="stay after the end, for latched topics")
    flag("--try-future-version", dest="future", text="accepted: the version is 2.0")
    add("--topics", help="topics to play back")
    add("--pause-topics", help="topics to pause on")
    add("--bags", help="bags to play back from")
    flag("--wait-for-subscribers", dest="wait", text="wait for a subscriber on each topic")
    return parser
