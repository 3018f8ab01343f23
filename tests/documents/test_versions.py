"""A newer version's files are refused with a sentence."""

from __future__ import annotations

import pytest

from gazelle.documents.versions import refused_version


def test_known_versions_are_read() -> None:
    assert refused_version("the map", 1, 2) == ""
    assert refused_version("the map", 2, 2) == ""


def test_a_newer_version_says_what_would_read_it() -> None:
    assert refused_version("the map", 3, 2) == (
        "the map is of version 3, saved by a newer Gazelle; this one reads versions up to 2 "
        "(pip install --upgrade gazelle-sim)"
    )


@pytest.mark.parametrize("version", [0, -1, "1", None, True, 1.0])
def test_what_is_no_version_is_told(version: object) -> None:
    assert "which is none: versions are 1, 2, 3 …" in refused_version("the map", version, 2)
