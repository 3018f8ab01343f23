from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from xml.dom import minidom

import pytest
from tests.patience import stretched

from gazelle.description.loader import load_models
from gazelle.description.robot_description import TEXT_FILES_VARIABLE, copy_name, read_text
from gazelle.description.source_maps import SourceMap, placed, remember, source_map_of
from gazelle.description.xacro import Expanded, expand_xacro
from gazelle.diagnostics import Diagnostics, SourceSpan

ROBOT = """<robot name="pair" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <!-- Two links. -->
  <xacro:include filename="part.xacro"/>
  <link name="base"/>
  <xacro:part name="one"/>
  <xacro:part name="two"/>
</robot>
"""
PART = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="part" params="name">
    <link name="${name}">
      <inertial><mass value="1"/></inertial>
    </link>
    <joint name="to_${name}" type="fixed">
      <parent link="base"/><child link="${name}"/>
    </joint>
  </xacro:macro>
</robot>
"""


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "gazelle" / "xacro_maps"


@pytest.fixture
def expanded(tmp_path: Path, cache: Path) -> Expanded:
    (tmp_path / "pair.xacro").write_text(ROBOT, encoding="utf-8")
    (tmp_path / "part.xacro").write_text(PART, encoding="utf-8")
    found = expand_xacro(tmp_path / "pair.xacro", workspace=None, diagnostics=Diagnostics())
    assert found is not None
    remember(found)
    return found


def _places(found: SourceMap | None) -> list[str]:
    assert found is not None
    return [_short(span) for span in found.spans]


def _short(span: SourceSpan | None) -> str:
    if span is None:
        return "-"
    way = "".join(f" from {call.line}" for call in span.via)
    return f"{Path(span.file).stem}:{span.line}{way}"


ALL = [
    "pair:1", "pair:4",
    *("part:3 from 5", "part:4 from 5", "part:4 from 5"),
    *("part:6 from 5", "part:7 from 5", "part:7 from 5"),
    *("part:3 from 6", "part:4 from 6", "part:4 from 6"),
    *("part:6 from 6", "part:7 from 6", "part:7 from 6"),
]  # fmt: skip


def test_text_leads_back_to_the_xacro_lines(expanded: Expanded) -> None:
    found = source_map_of(expanded.text)
    assert _places(found) == ALL
    assert found is not None
    assert found.spans == expanded.spans


def test_other_layout_and_lost_comments_change_nothing(expanded: Expanded) -> None:
    plain = re.sub(r"<!--.*?-->", "", expanded.text, flags=re.DOTALL)
    one_line = minidom.parseString(re.sub(r">\s+<", "><", plain)).toxml()
    for text in (plain, one_line, one_line.replace('" ', '"\n\t')):
        found = source_map_of(text)
        assert _places(found) == ALL


def test_a_changed_text_may_be_another_robots(expanded: Expanded) -> None:
    for old, new in (('"to_two"', '"to_2"'), ("</robot>", '<link name="added"/></robot>')):
        assert source_map_of(expanded.text.replace(old, new)) is None


def test_equal_elements_with_another_text_inside_are_another_robot(expanded: Expanded) -> None:
    assert source_map_of(expanded.text.replace("</robot>", "word</robot>")) is None


def test_other_robots_lead_nowhere(expanded: Expanded) -> None:
    text = "<robot name='x'>" + "".join(f'<link name="l{n}"/>' for n in range(9)) + "</robot>"
    assert source_map_of(text) is None
    assert source_map_of("<robot") is None


def test_files_that_changed_since_are_not_named(expanded: Expanded, tmp_path: Path) -> None:
    os.utime(tmp_path / "part.xacro", (1, 1))
    assert _places(source_map_of(expanded.text)) == ["pair:1", "pair:4", *["-"] * 12]


def test_unwritable_or_broken_cache_is_passed_over(
    expanded: Expanded, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (kept,) = cache.iterdir()
    for broken in ("", "{}\n{}\n", '{"version": 1, "sketch": [1]}\n[]', "\0"):
        kept.write_text(broken, encoding="utf-8")
        assert source_map_of(expanded.text) is None
    monkeypatch.setenv("XDG_CACHE_HOME", str(kept))
    remember(expanded)
    assert source_map_of(expanded.text) is None


def test_oldest_maps_make_room(expanded: Expanded, cache: Path, tmp_path: Path) -> None:
    (first,) = cache.iterdir()
    os.utime(first, (1, 1))
    for number in range(64):
        name = f"<robot><link name='l{number}'/></robot>"
        remember(Expanded(name, "f", (None, None), (1, 1)))
    assert len(list(cache.iterdir())) == 64
    assert not first.exists()


def test_another_process_finds_the_places(expanded: Expanded, tmp_path: Path) -> None:
    (tmp_path / "pair.urdf").write_text(expanded.text, encoding="utf-8")
    script = (
        "import sys; from gazelle.description.source_maps import source_map_of;"
        "print([str(p) for p in source_map_of(open(sys.argv[1]).read()).spans][2])"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, "pair.urdf"],
        cwd=tmp_path, capture_output=True, text=True, check=True, timeout=stretched(),
    )  # fmt: skip
    assert done.stdout.strip() == f"{tmp_path}/part.xacro:3:5"


def test_findings_about_a_text_name_the_xacro_line(expanded: Expanded) -> None:
    diagnostics = Diagnostics()
    load_models(expanded.text, workspace=None, diagnostics=diagnostics)
    (finding, *_) = diagnostics.by_code("urdf.bad-inertia") or list(diagnostics)
    assert finding.span is not None
    assert _short(finding.span).startswith("part:")
    assert finding.span.via


def test_copies_of_a_launcher_are_seen_through(
    expanded: Expanded, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copy, own = tmp_path / copy_name("/ns/robot_description"), tmp_path / "own.urdf"
    assert copy.name == "ns-robot_description.text.xml"
    changed = expanded.text.replace('"to_two"', '"to_2"')
    for path, text, expected in (
        (copy, expanded.text, "pair.xacro"),
        (own, expanded.text, "pair.xacro"),
        (copy, changed, copy.name),
        (own, changed, "own.urdf"),
    ):
        path.write_text(text, encoding="utf-8")
        monkeypatch.setenv(TEXT_FILES_VARIABLE, str(path))
        root = read_text(text, Diagnostics())
        assert root is not None
        assert Path(root.span.file).name == expected


def test_tree_keeps_its_own_places_where_nothing_is_known(cache: Path) -> None:
    root = read_text("<robot><link/></robot>", Diagnostics())
    assert root is not None
    assert placed(root) is root
    assert root.children[0].span.file == "<robot_description>"
