from __future__ import annotations

import pytest

from gazelle.description.sdf_reader import read_model_file, read_sdf, read_world_file

MODEL = "<model name='m'><pose>1 0 0 0 0 0</pose><link name='l'/></model>"


def test_text_with_everything(context):
    light = "<light name='s' type='point'/>"
    text = f"<sdf version='1.8'><world name='w'>{MODEL}</world>{MODEL}{light}</sdf>"
    found = read_sdf(text, context=context)
    assert (found.version, len(found.worlds), len(found.models), len(found.lights)) == (
        "1.8",
        1,
        1,
        1,
    )
    assert found.models[0].T_world_model.position_m == (1, 0, 0)
    assert found.models[0].source_format == "sdf"


def test_tag_is_read_like_its_text(context, tag):
    text = f"<sdf version='1.8'>{MODEL}</sdf>"
    assert read_sdf(tag(text), context=context).models == read_sdf(text, context=context).models


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<sdf version='1.6'/>", "holds neither world nor model"),
        ("<robot name='r'/>", "<robot>, not <sdf>"),
    ],
)
def test_nothing_to_load_is_an_error(context, diagnostics, text, words):
    found = read_sdf(text, context=context)
    assert (found.worlds, found.models) == ((), ())
    assert words in diagnostics.by_code("sdf.empty")[0].message


def test_broken_xml_is_one_error_with_its_place(context, diagnostics):
    assert read_sdf("<sdf>\n<world>\n</sdf>", context=context).worlds == ()
    (found,) = diagnostics.errors
    assert (found.code, found.span.line) == ("xml.malformed", 2)


def test_bare_model_is_taken_as_it_is(context):
    assert [item.name for item in read_sdf(MODEL, context=context).models] == ["m"]


def test_placement_frame_of_a_model_alone(context):
    text = (
        "<sdf version='1.9'><model name='m' placement_frame='l'><pose>5 0 0 0 0 0</pose>"
        "<link name='l'><pose>1 0 0 0 0 0</pose></link></model></sdf>"
    )
    assert read_sdf(text, context=context).models[0].T_world_model.position_m == (4, 0, 0)


def test_world_file_knows_where_it_comes_from(tmp_path, diagnostics):
    path = tmp_path / "a.world"
    path.write_text(f"<sdf version='1.6'><world name='w'>{MODEL}</world></sdf>", encoding="utf-8")
    world = read_world_file(path, workspace=None, diagnostics=diagnostics)
    assert (world.name, world.file) == ("w", path)


def test_file_with_models_only_becomes_a_world(tmp_path, diagnostics):
    path = tmp_path / "a.sdf"
    path.write_text(f"<sdf version='1.6'>{MODEL}</sdf>", encoding="utf-8")
    assert read_world_file(path, workspace=None, diagnostics=diagnostics).model("m") is not None


def test_model_folder_is_read_through_its_config(models_folder, diagnostics):
    folder = models_folder("m", MODEL)
    model = read_model_file(folder, workspace=None, diagnostics=diagnostics)
    assert (model.name, model.file) == ("m", folder / "model.sdf")


def test_folder_without_model_is_an_error(tmp_path, diagnostics):
    assert read_model_file(tmp_path, workspace=None, diagnostics=diagnostics) is None
    assert "neither model.config nor model.sdf" in diagnostics.by_code("sdf.no-model")[0].message


def test_world_without_model_opened_as_model_is_an_error(tmp_path, diagnostics):
    path = tmp_path / "a.world"
    path.write_text("<sdf version='1.6'><world name='w'/></sdf>", encoding="utf-8")
    assert read_model_file(path, workspace=None, diagnostics=diagnostics) is None
    assert "holds no model" in diagnostics.by_code("sdf.no-model")[0].message


def test_missing_file_is_one_error(tmp_path, diagnostics):
    assert read_world_file(tmp_path / "no.world", workspace=None, diagnostics=diagnostics) is None
    assert [item.code for item in diagnostics] == ["xml.unreadable"]
