"""The tables of facts: the same as those of an installed sdformat, and read as they are meant."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import pytest

from gazelle.description.sdformat.document.specification import specification
from gazelle.description.sdformat.release import Release

from .facts import definitions_in, upgrade_rules

_INSTALLED = Path("/usr/share/sdformat12")
_PACKAGE = "gazelle.description.sdformat.document"

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
    for name, lines in definitions_in(_INSTALLED / "1.9").items():
        assert ours.get(f"{name} 1.9", ours.get(name)) == lines, name


@needs_sdformat
@pytest.mark.reference
def test_upgrade_rules_are_those_of_the_installed_files() -> None:
    text = (files(_PACKAGE) / "upgrades.txt").read_text(encoding="utf-8")
    assert text.splitlines() == list(upgrade_rules(_INSTALLED))


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
