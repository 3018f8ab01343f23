from __future__ import annotations

import pytest

from gazelle.description.sdf_reader.model_config import model_file_in, read_model_config

MODEL = "<model name='m'><link name='l'/></model>"


def _config(*files):
    lines = "".join(f"<sdf version='{version}'>{name}</sdf>" for version, name in files)
    return (
        "<model><name>Nice Box</name><version>1.2</version><author><name>A</name>"
        f"<email>a@b.c</email></author><author><name>B</name></author>{lines}"
        "<description> two\n lines</description></model>"
    )


def test_everything_it_says(models_folder, context):
    folder = models_folder("m", MODEL, config=_config(("1.6", "model.sdf")))
    found = read_model_config(folder, context)
    assert (found.name, found.version, found.description) == ("Nice Box", "1.2", "two lines")
    assert found.authors == (("A", "a@b.c"), ("B", ""))
    assert found.sdf_files == (((1, 6), "model.sdf"),)


@pytest.mark.parametrize(
    ("files", "best"),
    [
        ([("1.4", "old.sdf"), ("1.5", "new.sdf")], "new.sdf"),
        ([("1.10", "new.sdf"), ("1.9", "old.sdf")], "new.sdf"),
        ([("1.5", "first.sdf"), ("1.5", "second.sdf")], "first.sdf"),
        ([("1.99", "future.sdf"), ("1.6", "usable.sdf")], "usable.sdf"),
    ],
)
def test_newest_version_that_can_be_read_is_taken(models_folder, context, files, best):
    folder = models_folder("m", MODEL, config=_config(*files))
    for _, name in files:
        (folder / name).write_text("<sdf/>", encoding="utf-8")
    assert model_file_in(folder, context) == folder / best


def test_missing_named_file_is_reported_and_model_sdf_tried(models_folder, context, diagnostics):
    folder = models_folder("m", MODEL, config=_config(("1.6", "no.sdf")))
    assert model_file_in(folder, context) == folder / "model.sdf"
    assert (
        "names 'no.sdf', which is not in its folder"
        in diagnostics.by_code("sdf.model-config")[0].message
    )


def test_broken_config_is_a_warning(models_folder, context, diagnostics):
    folder = models_folder("m", MODEL, config="<model>")
    assert model_file_in(folder, context) == folder / "model.sdf"
    assert "model.sdf is tried" in diagnostics.by_code("sdf.model-config")[0].message
    assert not diagnostics.errors


def test_folder_without_config(models_folder, context):
    folder = models_folder("m", MODEL)
    (folder / "model.config").unlink()
    assert model_file_in(folder, context) == folder / "model.sdf"
    (folder / "model.sdf").unlink()
    assert model_file_in(folder, context) is None
