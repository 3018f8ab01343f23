from __future__ import annotations

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.patience import stretched
from tests.shared_files import needs_shared

from gazelle.description.xacro import Expanded, expand_xacro
from gazelle.diagnostics import Diagnostics, Severity
from gazelle.workspace import Workspace

HEAD = '<robot name="f" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'


def _expand(text: str, folder: Path, **options) -> tuple[Expanded | None, Diagnostics]:
    path = folder / "one.xacro"
    path.write_text(f"{HEAD}{text}\n</robot>", encoding="utf-8")
    diagnostics = Diagnostics()
    options.setdefault("workspace", None)
    return expand_xacro(path, diagnostics=diagnostics, **options), diagnostics


@pytest.fixture
def inputs(oracles_dir: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(oracles_dir / "xacro" / "inputs")
    return oracles_dir / "xacro"


@needs_shared
@pytest.mark.reference
@pytest.mark.parametrize(
    ("name", "recorded"), [("feat.xacro", "feat_xacro.xml"), ("big.xacro", "inputs/big_x.urdf")]
)
def test_output_equals_that_of_the_real_program(name: str, recorded: str, inputs: Path) -> None:
    expanded = expand_xacro(name, workspace=None, diagnostics=Diagnostics())
    assert expanded is not None
    assert expanded.text == (inputs / recorded).read_text(encoding="utf-8")


@needs_shared
@pytest.mark.reference
def test_48_features_give_the_recorded_results(
    inputs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    features = _features(inputs)
    recorded = re.findall(
        r"^(\S.*?)\s+xacro rc=(\d) (.*)$", (inputs / "features.txt").read_text("utf-8"), re.M
    )
    assert len(recorded) == len(features) == 48
    for name in ("inc.xacro", "conf.yaml"):
        (tmp_path / name).write_bytes((inputs / "inputs" / name).read_bytes())
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", "/root")
    for name, status, result in recorded:
        Path("one.xacro").write_text(f"{HEAD.strip()}{features[name]}</robot>", "utf-8")
        expanded = expand_xacro("one.xacro", workspace=None, diagnostics=Diagnostics())
        assert (expanded is None) == (status == "2"), name
        if expanded is not None:
            expected = result.strip().replace("/example/xac", str(tmp_path))
            assert _as_recorded(expanded.text) == expected, name


def _features(inputs: Path) -> dict[str, str]:
    """Return the table of features in the script that made the recording."""
    tree = ast.parse((inputs / "inputs" / "one.py").read_text(encoding="utf-8"))
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "F":
            return ast.literal_eval(node.value)
    raise AssertionError("the script has no table F")


def _as_recorded(text: str) -> str:
    """Shorten an output as the recording does."""
    text = re.sub(r"<\?xml.*?\?>", "", text)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r" ?(/?>) ?", r"\1", re.sub(r"\s+", " ", text)).replace("> <", "><").strip()
    return text[text.find(">") + 1 :][:110].strip()


@pytest.mark.parametrize(
    "text",
    [
        '<xacro:property name="w" value="0.3"/><v a="${2*w}"/><!-- kept ${w} -->',
        '<xacro:macro name="m" params="n:=2 *b"><l n="${n}"/><xacro:insert_block name="b"/>'
        '</xacro:macro>\n<xacro:m><o x="1"/></xacro:m>',
        '<t>${1+1} and\n text</t><a b="&lt;&quot;ü"/>',
    ],
)
def test_bytes_equal_those_of_the_command(text: str, tmp_path: Path) -> None:
    expanded, _ = _expand(text, tmp_path)
    command = [sys.executable, "-c", "import xacro; xacro.main()", str(tmp_path / "one.xacro")]
    real = subprocess.run(command, capture_output=True, check=True, timeout=stretched())
    assert expanded is not None
    assert expanded.text.encode() == real.stdout


def test_arguments_and_packages_are_given(tmp_path: Path) -> None:
    package = tmp_path / "src" / "my_pkg"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(
        '<package format="2"><name>my_pkg</name><version>0.0.0</version></package>', "utf-8"
    )
    workspace = Workspace.discover(environ={}, cwd=tmp_path)
    text = '<xacro:arg name="p" default="x"/><v a="$(arg p) $(find my_pkg)"/>'
    mappings = {"p": "given"}
    expanded, _ = _expand(text, tmp_path, workspace=workspace, mappings=mappings)
    assert expanded is not None
    assert f'<v a="given {package}"/>' in expanded.text
    assert mappings == {"p": "given"}


def test_source_map_names_file_line_and_macro_calls(tmp_path: Path) -> None:
    (tmp_path / "inc.xacro").write_text(
        f'{HEAD}<xacro:macro name="m" params="n">\n  <link name="${{n}}"/>\n</xacro:macro>'
        "\n</robot>",
        encoding="utf-8",
    )
    text = '<xacro:include filename="inc.xacro"/>\n<xacro:m n="one"/>\n<xacro:m n="two"/>'
    expanded, diagnostics = _expand(text, tmp_path)
    assert expanded is not None
    tag = expanded.tag(diagnostics)
    assert tag is not None
    spans = {link.attributes["name"]: link.span for link in tag.find_all("link")}
    one, two = spans["one"], spans["two"]
    assert (Path(one.file).name, one.line, one.column) == ("inc.xacro", 3, 3)
    assert [(Path(item.file).name, item.line) for item in one.via] == [("one.xacro", 3)]
    assert [(Path(item.file).name, item.line) for item in two.via] == [("one.xacro", 4)]
    assert [Path(item).name for item in expanded.dependencies] == ["inc.xacro"]


def test_root_dir_is_where_relative_paths_start(tmp_path: Path) -> None:
    (tmp_path / "r.xacro").write_text(f'{HEAD}<v a="$(cwd)"/></robot>', encoding="utf-8")
    expanded = expand_xacro(
        "r.xacro", workspace=None, diagnostics=Diagnostics(), root_dir=str(tmp_path)
    )
    assert expanded is not None
    assert f'<v a="{tmp_path}"/>' in expanded.text


def test_library_is_left_as_it_was(tmp_path: Path) -> None:
    import xacro
    from xacro import substitution_args

    before = (xacro.parse, xacro.handle_macro_call, xacro.root_dir, substitution_args._eval_find)
    limit = sys.getrecursionlimit()
    _expand("<v a='${nope}'/>", tmp_path)
    after = (xacro.parse, xacro.handle_macro_call, xacro.root_dir, substitution_args._eval_find)
    assert before == after
    assert not hasattr(xacro, "print")
    assert sys.getrecursionlimit() == limit


def test_warnings_and_messages_have_a_place(tmp_path: Path) -> None:
    text = "<v a=\"${xacro.message('hi')}\"/>\n<xacro:property name='len' value='3'/>"
    expanded, diagnostics = _expand(text, tmp_path)
    assert expanded is not None
    message, warning = diagnostics
    assert (message.code, message.message, message.span.line) == ("xacro.message", "hi", 2)
    assert (warning.code, warning.span.line) == ("xacro.warning", 3)
    assert warning.message == "redefining global symbol: len"
    assert warning.severity is Severity.WARNING
