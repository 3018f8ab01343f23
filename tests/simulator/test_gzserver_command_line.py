from __future__ import annotations

from gazelle.diagnostics import Diagnostics
from gazelle.simulator import Mode
from gazelle.simulator.gzserver_command_line import ServerOptions, read_server_options


def read(text: str) -> tuple[ServerOptions, list[str]]:
    diagnostics = Diagnostics()
    options = read_server_options(text.split(), diagnostics)
    assert all(item.code == "simulator.unknown-argument" for item in diagnostics)
    return options, [item.message for item in diagnostics]


def test_the_words_of_roslaunch_are_understood() -> None:
    options, found = read("-u -e ode worlds/empty.world --verbose")
    assert (options.world, options.paused, options.verbose) == ("worlds/empty.world", True, True)
    assert options.mode is Mode.REAL_TIME
    assert found == []


def test_the_words_of_ros_2_are_understood() -> None:
    options, found = read("my.world -s libgazebo_ros_init.so -s libgazebo_ros_factory.so")
    assert options.plugins == ("libgazebo_ros_init.so", "libgazebo_ros_factory.so")
    assert found == []


def test_modes_seed_and_iterations() -> None:
    options, _ = read("--lockstep --seed 7 --iters=100")
    assert (options.mode, options.seed, options.iterations) == (Mode.LOCKSTEP, 7, 100)
    assert read("--fast")[0].mode is Mode.FAST
    assert read("--help")[0].shows_help
    assert read("-v")[0].shows_version


def test_options_without_a_meaning_here_are_named() -> None:
    _, found = read("--record_path /tmp -r a.world")
    assert found == [
        "option '--record_path' of Gazebo has no effect here",
        "option '-r' of Gazebo has no effect here",
    ]


def test_unknown_options_and_a_second_world_are_reported() -> None:
    options, found = read("a.world b.world --pase --seed x")
    assert options.world == "a.world"
    assert found[0] == "a world is named already ('a.world'); 'b.world' is dropped"
    assert found[1] == "gzserver has no option '--pase'; it is dropped"
    assert found[2] == "--seed needs a whole number, not 'x'; it is dropped"
