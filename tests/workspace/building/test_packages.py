"""Finding, ordering and choosing packages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.workspace.building.packages import (
    BuildError,
    Selection,
    SourcePackage,
    find_packages,
    in_order,
    needed_by,
    select,
)

Make = Callable[..., Path]


def _ordered(tmp_path: Path) -> tuple[SourcePackage, ...]:
    return in_order(find_packages([tmp_path / "src"], Diagnostics()))


def _names(packages: tuple[SourcePackage, ...]) -> list[str]:
    return [item.name for item in packages]


def test_a_package_follows_what_it_needs_and_others_follow_by_name(
    make: Make, tmp_path: Path
) -> None:
    make("a_last", needs=("z_first",))
    make("z_first")
    make("m_free")
    assert _names(_ordered(tmp_path)) == ["m_free", "z_first", "a_last"]


def test_a_circle_is_named(make: Make, tmp_path: Path) -> None:
    make("one", needs=("two",))
    make("two", needs=("three",))
    make("three", needs=("one",))
    with pytest.raises(BuildError, match="one -> two -> three -> one"):
        _ordered(tmp_path)


def test_two_packages_of_one_name_are_refused_with_both_places(make: Make, tmp_path: Path) -> None:
    make("bot")
    other = make("other") / "package.xml"
    other.write_text(other.read_text().replace(">other<", ">bot<"))
    with pytest.raises(BuildError, match="Duplicate package names") as caught:
        _ordered(tmp_path)
    assert "src/bot" in str(caught.value)
    assert "src/other" in str(caught.value)


def test_a_broken_manifest_is_reported_and_the_package_left_out(make: Make, tmp_path: Path) -> None:
    make("bot")
    (make("bad") / "package.xml").write_text("<package><name>bad</name>")
    diagnostics = Diagnostics()
    assert _names(find_packages([tmp_path / "src"], diagnostics)) == ["bot"]
    (found,) = diagnostics.by_code("workspace.bad-manifest")
    assert "it is not built" in found.message


def test_an_ignored_folder_has_no_packages(make: Make, tmp_path: Path) -> None:
    (make("bot") / "COLCON_IGNORE").touch()
    assert _ordered(tmp_path) == ()


def test_up_to_takes_what_is_needed_and_above_what_needs(make: Make, tmp_path: Path) -> None:
    make("base")
    make("arm", needs=("base",))
    make("demo", needs=("arm",))
    make("alone")
    packages = _ordered(tmp_path)
    assert needed_by(["demo"], packages) == {"base", "arm", "demo"}
    assert _names(select(packages, Selection(up_to=("arm",)))[0]) == ["base", "arm"]
    assert _names(select(packages, Selection(above=("arm",)))[0]) == ["arm", "demo"]
    chosen, warnings = select(packages, Selection(only=("arm", "alnoe"), skip=("base",)))
    assert _names(chosen) == ["arm"]
    assert warnings == (
        "ignoring unknown package 'alnoe' in --packages-select; did you mean 'alone'?",
    )
