from __future__ import annotations

import base64
import io
import zipfile
from typing import Any

import pytest
from tests.studio.page import RefusedError

from gazelle.studio.robot_files import dropped_files

BOX = "<box size='1 1 1'/>"
STL = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
STL += "endfacet\nendsolid a\n"


def urdf(geometry: str = BOX) -> str:
    return (
        "<robot name='bot'>\n<link name='base'>\n<visual><geometry>\n"
        f"{geometry}\n</geometry></visual></link></robot>\n"
    )


def drop(page: Any, **files: str | bytes) -> str:
    name = page.call("robot_file.begin")
    for path, content in files.items():
        put(page, name, path, content)
    return str(name)


def put(page: Any, name: str, path: str, content: str | bytes, **more: bool) -> None:
    data = content.encode() if isinstance(content, str) else content
    coded = base64.b64encode(data).decode()
    page.call("robot_file.put", set=name, path=path, base64=coded, **more)


def read(page: Any, name: str, **params: str) -> Any:
    return page.call("robot_file.read", set=name, **params)


def test_a_robot_is_shown(page):
    value = read(page, drop(page, **{"bot.urdf": urdf()}))
    assert (value["file"], value["files"]) == ("bot.urdf", ["bot.urdf"])
    assert value["scene"]["models"][0]["name"] == "bot"
    assert value["counts"] == "1 model, 1 link, 0 joints, 0 sensors"
    assert not [each for each in value["findings"] if each["severity"] == "error"]


def test_a_mistake_is_told_with_line_and_fix_under_the_name_of_the_file(page):
    text = urdf().replace("</link>", "<visula/></link>").replace("<link", "<lnik")
    value = read(page, drop(page, **{"bot/urdf/bot.urdf": text}))
    assert value["scene"] is None
    finding = value["findings"][0]
    assert finding["place"].startswith("bot/urdf/bot.urdf:")
    assert finding["source"]["text"]
    assert finding["message"]
    assert finding["fix"]


def test_xacro_is_expanded_and_meshes_are_found_without_a_manifest(page):
    xacro = (
        "<robot name='bot' xmlns:xacro='http://www.ros.org/wiki/xacro'>"
        "<xacro:include filename='$(find bot_description)/urdf/base.xacro'/>"
        "<xacro:base size='${1 + 1}'/></robot>"
    )
    base = (
        "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'><xacro:macro name='base' params='size'>"
        "<link name='base'><visual><geometry><mesh scale='${size} 1 1' "
        "filename='package://bot_description/meshes/a.stl'/></geometry></visual></link>"
        "</xacro:macro></robot>"
    )
    files = {"bot/urdf/bot.urdf.xacro": xacro, "bot/urdf/base.xacro": base, "bot/meshes/a.stl": STL}
    value = read(page, drop(page, **files))
    assert value["file"] == "bot/urdf/bot.urdf.xacro"
    (shape,) = value["scene"]["bodies"][0]["visuals"]
    assert shape["geometry"]["type"] == "mesh"
    assert shape["geometry"]["scale"] == [2.0, 1.0, 1.0]


def test_a_zip_is_unpacked(page):
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as file:
        file.writestr("bot/", "")
        file.writestr("bot/model.sdf", f"<sdf version='1.6'><model name='m'>{link()}</model></sdf>")
        file.writestr("bot/bot.urdf", urdf())
    name = drop(page, **{"bot.zip": packed.getvalue()})
    assert sorted(read(page, name)["files"]) == ["bot/bot.urdf", "bot/model.sdf"]
    assert read(page, name, file="bot/model.sdf")["scene"]["models"][0]["name"] == "m"


def link() -> str:
    return "<link name='l'><visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry></visual></link>"  # noqa: E501


def test_long_files_come_in_pieces(page):
    name = page.call("robot_file.begin")
    text = urdf()
    put(page, name, "bot.urdf", text[:20])
    put(page, name, "bot.urdf", text[20:], more=True)
    assert read(page, name)["scene"]["models"][0]["name"] == "bot"


@pytest.mark.parametrize(
    "path", ["../a.urdf", "/etc/a.urdf", "a/../../b", "", "a\\b", "c:/a", "x" * 500]
)
def test_a_name_that_leads_elsewhere_is_refused(page, path):
    name = page.call("robot_file.begin")
    with pytest.raises(RefusedError, match="is no name of a file in a folder"):
        put(page, name, path, "x")


def test_a_zip_that_leads_elsewhere_is_refused(page):
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as file:
        file.writestr("../../outside.urdf", urdf())
    with pytest.raises(RefusedError, match="is no name of a file in a folder"):
        read(page, drop(page, **{"bot.zip": packed.getvalue()}))


def test_what_is_no_zip_is_told(page):
    with pytest.raises(
        RefusedError, match=r"'bot\.zip' cannot be unpacked: File is not a zip file"
    ):
        read(page, drop(page, **{"bot.zip": "no"}))


def test_too_much_is_refused(page, monkeypatch):
    monkeypatch.setattr(dropped_files, "_MOST_BYTES", 10 << 20)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("zeros", bytes(30 << 20))
    name = drop(page, **{"bot.zip": packed.getvalue()})
    with pytest.raises(RefusedError, match="the files have more than 10 MiB"):
        read(page, name)
    monkeypatch.setattr(dropped_files, "_MOST_FILES", 2)
    with pytest.raises(RefusedError, match="these are more than 2 files"):
        drop(page, a="", b="", c="")


def test_without_a_robot_it_is_said_what_one_is(page):
    with pytest.raises(RefusedError, match="there is no robot among these files") as refused:
        read(page, drop(page, **{"readme.txt": "x"}))
    assert ".urdf" in refused.value.error["hint"]


def test_what_is_gone_is_to_be_dropped_again(page):
    with pytest.raises(RefusedError, match="these files are not here any more"):
        read(page, "0123")
    names = [page.call("robot_file.begin") for _ in range(6)]
    with pytest.raises(RefusedError, match="these files are not here any more"):
        read(page, names[0])
    with pytest.raises(RefusedError, match=r"there is no 'b\.urdf' among these files"):
        read(page, drop(page, **{"bot.urdf": urdf()}), file="b.urdf")


def test_dropped_files_go_with_their_studio():
    files = dropped_files.DroppedFiles()
    name = files.begin()
    files.put(name, "a/b.urdf", "", is_more=False)
    folder = files.folder(name)
    assert (folder / "a" / "b.urdf").is_file()
    files.close()
    assert not folder.parent.exists()
