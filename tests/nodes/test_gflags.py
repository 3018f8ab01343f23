"""Command lines of programs that read them with gflags."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.errors import LaunchError
from gazelle.nodes.gflags import Kind, read_flags
from gazelle.nodes.slam.cartographer.configuration import flags_of

_KINDS: dict[str, Kind] = {"name": "string", "x": "double", "allow_renaming": "bool"}


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("-name box --x=1.5", {"name": "box", "x": 1.5}),
        ("-x -2", {"x": -2.0}),
        ("--name -odd", {"name": "-odd"}),
        ("-allow_renaming", {"allow_renaming": True}),
        ("-allow-renaming", {"allow_renaming": True}),
        ("--allow-renaming=false", {"allow_renaming": False}),
        ("--noallow_renaming", {"allow_renaming": False}),
        ("-noallow-renaming", {"allow_renaming": False}),
        ("-allow_renaming false", {"allow_renaming": True}),
        ("-x 1 -x 2 word", {"x": 2.0}),
        ("-x 1 -- -nothing", {"x": 1.0}),
    ],
)
def test_flags_are_read_as_gflags_does(words: str, found: dict[str, Any]) -> None:
    assert read_flags(words.split(), _KINDS) == found


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("-nam box", "unknown command line flag 'nam'; did you mean 'name'?\nusage: create"),
        ("-noname", "unknown command line flag 'noname'"),
        ("-x", "flag '-x' is missing its argument"),
        ("--x=east", "illegal value 'east' specified for double flag 'x'"),
        ("--allow_renaming=perhaps", "illegal value 'perhaps' specified for bool flag"),
    ],
)
def test_wrong_flags_are_told_in_the_words_of_gflags(words: str, message: str) -> None:
    with pytest.raises(LaunchError) as wrong:
        read_flags(words.split(), _KINDS, "usage: create")
    assert str(wrong.value).startswith(message)


def test_programs_that_allow_reparsing_go_on_after_unknown_flags() -> None:
    told: list[str] = []
    words = ["-use_sim", "true", "-nam", "-x", "2"]
    assert read_flags(words, _KINDS, "usage", on_unknown=told.append) == {"x": 2.0}
    assert told == [
        "unknown command line flag 'use_sim'",
        "unknown command line flag 'nam'; did you mean 'name'?",
    ]


def test_cartographer_takes_its_flags_in_every_spelling() -> None:
    words = ("--configuration_directory=/lua", "--configuration-basename", "robot.lua")
    assert flags_of(words) == {
        "configuration_directory": "/lua",
        "configuration_basename": "robot.lua",
    }
