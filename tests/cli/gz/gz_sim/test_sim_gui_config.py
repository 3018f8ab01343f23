"""A world that the window's control lets go, without ``-r``."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cli.gz.gz_sim.sim import _is_let_go, lets_world_go, read_sim

CONTROL = """<plugin filename="{file}" name="World control"><gz-gui><title>c</title></gz-gui>
<play_pause>{buttons}</play_pause>{paused}</plugin>"""
WINDOW = """<?xml version="1.0"?>
<window><width>1000</width></window>
<plugin filename="MinimalScene" name="3D View"><start_paused>false</start_paused></plugin>
"""


def control(paused: str, file: str = "WorldControl", buttons: str = "true") -> str:
    tag = f"<start_paused>{paused}</start_paused>" if paused else ""
    return CONTROL.format(file=file, buttons=buttons, paused=tag)


@pytest.mark.parametrize(
    ("plugin", "goes"),
    [
        (control("false"), True),
        (control("0"), True),
        (control("false", "libWorldControl.so"), True),
        (control("true"), False),
        (control(""), False),
        (control("false", buttons="false"), False),
        ("", False),
        ("<plugin", False),
    ],
)
def test_start_paused_decides(tmp_path: Path, plugin: str, goes: bool) -> None:
    config = tmp_path / "gui.config"
    config.write_text(WINDOW + plugin)
    world = tmp_path / "w.sdf"
    world.write_text(
        f'<?xml version="1.0"?><sdf version="1.9"><world name="w"><gui>{plugin}</gui></world></sdf>'
    )
    assert lets_world_go("", str(config)) is goes
    assert lets_world_go(str(world), "") is goes


def test_a_configuration_counts_in_place_of_the_worlds(tmp_path: Path) -> None:
    world, config = tmp_path / "w.sdf", tmp_path / "gui.config"
    body = f'<sdf version="1.9"><world name="w"><gui>{control("false")}</gui></world></sdf>'
    world.write_text(body)
    config.write_text(control("true"))
    assert lets_world_go(str(world), "") is True
    assert lets_world_go(str(world), str(config)) is False
    assert lets_world_go("", "") is False
    assert lets_world_go(str(tmp_path / "none.sdf"), "") is False


def test_the_option_is_read_and_not_told_as_idle() -> None:
    start = read_sim(["w.sdf", "--gui-config", "my.config"])
    assert (start.gui_config, start.notes) == ("my.config", [])


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (None, ["--gui-config my.config: No such file or directory", "fix: name a file"]),
        ("<a/>\n<plugin", ["my.config:2:", "error: "]),
    ],
)
def test_a_configuration_that_cannot_be_read_is_told(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    text: str | None,
    told: list[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    if text is not None:
        (tmp_path / "my.config").write_text(text)
    assert _is_let_go(read_sim(["w.sdf", "--gui-config", "my.config"])) is False
    said = "".join(capsys.readouterr())
    assert all(words in said for words in told), said
