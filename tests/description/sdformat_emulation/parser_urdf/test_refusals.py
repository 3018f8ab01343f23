from __future__ import annotations

import itertools

from gazelle.description.sdformat_emulation import Release
from gazelle.description.sdformat_emulation.parser_urdf import urdf_to_sdf

from .making import BOX, converted, joint, link, remarks_of, robot

ROOTS = (
    "Error:   Failed to find root link: Two root links found: [a] and [b]\n"
    "         at line 264 in ./urdf_parser/src/model.cpp"
)


def test_what_urdfdom_refuses_is_refused_with_its_words() -> None:
    assert urdf_to_sdf(robot(link("a"), link("b"))) is None
    assert remarks_of(link("a"), link("b")) == [ROOTS]


def test_what_urdfdom_only_remarks_is_said_twice() -> None:
    remarks = remarks_of(link("a", f'<visual>{BOX}<material name="nowhere"/></visual>'))
    assert len(remarks) == 4
    assert set(remarks) == {
        "Warning: link 'a' material 'nowhere' undefined.\n"
        "         at line 84 in ./urdf_parser/src/model.cpp"
    }


def test_a_loop_of_joints_crashes_the_library() -> None:
    loop = (joint("continuous", "a", "b"), joint("continuous", "b", "c"))
    parts = (link("a"), link("b"), link("c"), *loop, joint("continuous", "c", "b"))
    assert urdf_to_sdf(robot(*parts)) is None
    assert remarks_of(*parts) == ["Segmentation fault"]


def test_a_world_link_that_moves_crashes_the_library() -> None:
    parts = (link("a"), link("world", mass=None), joint("continuous", "a", "world"))
    assert urdf_to_sdf(robot(*parts), release=Release.V9) is None
    assert remarks_of(*parts) == ["Segmentation fault"]


def test_a_link_with_two_parents_is_modelled_under_both() -> None:
    both = (joint("continuous", "a", "c"), joint("continuous", "b", "c"))
    parts = (link("a"), link("b"), link("c"), joint("continuous", "a", "b"), *both)
    links = [item.attributes["name"] for item in converted(*parts).find_all("link")]
    assert links == ["a", "b", "c", "c"]


def test_a_thousand_fixed_links_become_one() -> None:
    names = [f"l{number}" for number in range(1000)]
    fixed = (joint("fixed", one, two) for one, two in itertools.pairwise(names))
    model = converted(*(link(name) for name in names), *fixed)
    assert [item.attributes["name"] for item in model.children] == ["l0"]
    mass = next(item for item in model.walk() if item.name == "mass")
    assert mass.text == "1000"
