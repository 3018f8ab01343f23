"""The tables of facts: the same as those of an installed sdformat, and read as they are meant."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import pytest

from gazelle.description.sdformat_emulation.gz_sdf_command.specification import specification
from gazelle.description.sdformat_emulation.release import Release

from .facts import definitions_in, upgrade_rules

_INSTALLED = Path("/usr/share/sdformat12")
_PACKAGE = "gazelle.description.sdformat_emulation.gz_sdf_command"

needs_sdformat = pytest.mark.skipif(
    not _INSTALLED.is_dir(), reason="sdformat's files are not installed (sdformat-sdf)"
)


def _blocks(name: str) -> dict[str, list[str]]:
    text = (files(_PACKAGE) / name).read_text(encoding="utf-8")
    blocks = (block.splitlines() for block in text.split("== ")[1:])
    return {title: lines for title, *lines in blocks}


@needs_sdformat
@pytest.mark.reference
def test_specification_is_that_of_the_installed_files() -> None:
    ours = _blocks("specification.txt")
    of_1_9 = {
        title.partition(" ")[0]: lines
        for title, lines in ours.items()
        if " " not in title or "1.9" in title.split()[1:]
    }
    for name, lines in definitions_in(_INSTALLED / "1.9").items():
        assert of_1_9.get(name) == lines, name


@needs_sdformat
@pytest.mark.reference
def test_upgrade_rules_are_those_of_the_installed_files() -> None:
    text = (files(_PACKAGE) / "upgrades.txt").read_text(encoding="utf-8")
    # sdformat 14 has two steps more, without any rule.
    steps = ["== 1.9 1.10", "== 1.10 1.11"]
    assert text.splitlines() == [*upgrade_rules(_INSTALLED), *steps]


def test_camera_has_type_limits_and_default() -> None:
    camera = specification(Release.V12).book["camera"]
    angle = camera.children["horizontal_fov"].value
    assert angle is not None
    assert (angle.kind, angle.default, angle.least, angle.most) == (
        "double",
        "1.047",
        0.1,
        6.283186,
    )
    assert camera.children["image"].required == "1"


def test_model_is_nested_in_itself() -> None:
    model = specification(Release.V12).children["model"]
    assert model.children["model"].resolved is model


def test_placement_frame_came_after_sdf_1_7() -> None:
    old, new = (specification(release).book["model"] for release in (Release.V9, Release.V12))
    assert old.attribute("placement_frame") is None
    assert new.attribute("placement_frame") is not None


def test_what_sdf_1_11_has_new_is_known_to_it_alone() -> None:
    old, new = (specification(release).book for release in (Release.V12, Release.V14))
    assert "cone_shape" not in old
    assert "cone" in new["geometry"].children
    assert "mimic" in new["joint"].children["axis"].children
    assert "joint" in new["world"].children
    assert new["inertial"].attribute("auto") is not None
    upper = new["joint"].children["axis"].children["limit"].children["upper"].value
    assert upper is not None
    assert upper.default == "inf"
