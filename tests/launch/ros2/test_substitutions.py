"""Every substitution of launch gives the text that it says."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.launch.ros2 import LaunchContext, Substitution, logging
from gazelle.launch.ros2 import substitutions as s
from gazelle.launch.ros2.frontend.parse_substitution import parse_substitution
from gazelle.launch.ros2.utilities import perform_substitutions

_ROWS: dict[str, Callable[[LaunchContext], None]] = {}


def _row(test: Callable[[LaunchContext], None]) -> Callable[[LaunchContext], None]:
    _ROWS[test.__name__] = test
    return test


@pytest.mark.parametrize("name", s.__all__)
def test_substitution(name: str, context: LaunchContext) -> None:
    context.launch_configurations.update(yes="true", no="0", word="w")
    _ROWS[name](context)


def _markup(context: LaunchContext, text: str) -> str:
    return perform_substitutions(context, parse_substitution(text))


@_row
def TextSubstitution(context: LaunchContext) -> None:
    text = s.TextSubstitution(text="a")
    assert (text.perform(context), text.describe()) == ("a", "'a'")
    with pytest.raises(TypeError, match="TextSubstitution expected Text object got"):
        s.TextSubstitution(text=1)  # type: ignore[arg-type]


@_row
def LaunchConfiguration(context: LaunchContext) -> None:
    assert s.LaunchConfiguration("word").perform(context) == "w"
    assert s.LaunchConfiguration(["wo", "rd"]).perform(context) == "w"
    assert s.LaunchConfiguration("x", default=["a", s.LaunchConfiguration("word"), 1]).perform(
        context
    ) == ("aw1")
    assert _markup(context, "$(var word)/$(var x 'a b')") == "w/a b"
    with pytest.raises(s.SubstitutionFailure, match="launch configuration 'wrd' does not exist"):
        s.LaunchConfiguration("wrd").perform(context)


@_row
def EnvironmentVariable(context: LaunchContext) -> None:
    os.environ["GZ_X"] = "1"
    assert s.EnvironmentVariable("GZ_X").perform(context) == "1"
    assert s.EnvironmentVariable("GZ_Y", default_value="2").perform(context) == "2"
    assert _markup(context, "$(env GZ_X)$(env GZ_Y '')") == "1"
    with pytest.raises(s.SubstitutionFailure, match="environment variable 'GZ_Y' does not exist"):
        s.EnvironmentVariable("GZ_Y").perform(context)


@_row
def AnonName(context: LaunchContext) -> None:
    name = s.AnonName("a.b").perform(context)
    assert name.startswith("a_b_")
    assert name.endswith(tuple("0123456789"))
    assert set(name) & set(".-:") == set()
    assert _markup(context, "$(anon a.b)") == name
    assert s.AnonName("c").perform(context) != s.AnonName("d").perform(context)


@_row
def LocalSubstitution(context: LaunchContext) -> None:
    context.extend_locals({"event": ["x", "y"]})
    assert s.LocalSubstitution("event[1]").perform(context) == "y"
    assert s.LocalSubstitution("event[1]", "second").describe() == "LocalVar('second')"
    with pytest.raises(AttributeError, match="does not contain attribute 'evnt', it contains"):
        s.LocalSubstitution("evnt").perform(context)


@_row
def PathJoinSubstitution(context: LaunchContext) -> None:
    joined = s.PathJoinSubstitution(["/a", s.LaunchConfiguration("word"), ["b", ".x"]])
    assert joined.perform(context) == "/a/w/b.x"


@_row
def FindExecutable(context: LaunchContext) -> None:
    assert s.FindExecutable(name="sh").perform(context) == shutil.which("sh")
    assert _markup(context, "$(find-exec sh)") == shutil.which("sh")
    with pytest.raises(
        s.SubstitutionFailure, match="'xacr' not found on the PATH; did you mean 'xacro'"
    ):
        s.FindExecutable(name="xacr").perform(context)


@_row
def FileContent(context: LaunchContext) -> None:
    text = Path(__file__).read_text(encoding="utf-8")
    assert s.FileContent(__file__).perform(context) == text
    assert _markup(context, f"$(file-content {__file__})") == text
    with pytest.raises(s.SubstitutionFailure, match="File not found: /nothing"):
        s.FileContent("/nothing").perform(context)


@_row
def LaunchLogDir(context: LaunchContext) -> None:
    folder = logging.launch_config.log_dir
    assert s.LaunchLogDir().perform(context) == folder
    assert _markup(context, "$(log_dir)|$(launch_log_dir)") == f"{folder}|{folder}"


@_row
def ThisLaunchFile(context: LaunchContext) -> None:
    with pytest.raises(s.SubstitutionFailure, match="ThisLaunchFile used outside of a launch file"):
        s.ThisLaunchFile().perform(context)
    context.extend_locals({"current_launch_file_path": "/a/b.launch.py"})
    assert s.ThisLaunchFile().perform(context) == "/a/b.launch.py"
    assert _markup(context, "$(filename)") == "/a/b.launch.py"


@_row
def ThisLaunchFileDir(context: LaunchContext) -> None:
    with pytest.raises(s.SubstitutionFailure, match="ThisLaunchFileDir used outside"):
        s.ThisLaunchFileDir().perform(context)
    context.extend_locals({"current_launch_file_directory": "/a"})
    assert s.ThisLaunchFileDir().perform(context) == "/a"
    assert _markup(context, "$(dirname)/b") == "/a/b"


@_row
def Command(context: LaunchContext) -> None:
    code = "import sys; print(1); sys.stderr.write('bad')"
    loud = [sys.executable, ' -c "', code, '"']
    assert s.Command(["echo ", s.LaunchConfiguration("word")]).perform(context) == "w\n"
    assert _markup(context, "$(command 'echo a b')") == "a b\n"
    assert s.Command(loud, on_stderr="ignore").perform(context) == "1\n"
    assert s.Command(loud, on_stderr="warn").perform(context) == "1\n"
    assert sorted(s.Command(loud, on_stderr="capture").perform(context)) == sorted("1\nbad")
    with pytest.raises(s.SubstitutionFailure, match=r"showed stderr output(?s:.*)bad"):
        s.Command(loud).perform(context)
    with pytest.raises(s.SubstitutionFailure, match=r"executed command failed. Command: false"):
        s.Command("false").perform(context)
    with pytest.raises(s.SubstitutionFailure, match=r"file not found: .*nixda"):
        s.Command("nixda").perform(context)
    with pytest.raises(s.SubstitutionFailure, match="expected 'on_stderr' to be one of"):
        s.Command("true", on_stderr="drop").perform(context)


@_row
def PythonExpression(context: LaunchContext) -> None:
    less = s.PythonExpression(["'", s.LaunchConfiguration("word"), "' == 'w'"])
    assert less.perform(context) == "True"
    assert s.PythonExpression("floor(pi) + math.ceil(0.5)").perform(context) == "4"
    assert s.PythonExpression("sys.platform", ["sys"]).perform(context) == sys.platform
    assert _markup(context, "$(eval '1 + 2')") == "3"
    assert _markup(context, "$(eval 'sys.platform' 'sys, math')") == sys.platform


@_row
def NotSubstitution(context: LaunchContext) -> None:
    assert s.NotSubstitution(s.LaunchConfiguration("yes")).perform(context) == "false"
    assert _markup(context, "$(not $(var no))") == "true"
    with pytest.raises(s.SubstitutionFailure, match="Cannot convert value 'w'"):
        s.NotSubstitution(s.LaunchConfiguration("word")).perform(context)


@_row
def AndSubstitution(context: LaunchContext) -> None:
    assert s.AndSubstitution("true", "1").perform(context) == "true"
    assert _markup(context, "$(and $(var yes) $(var no))") == "false"


@_row
def OrSubstitution(context: LaunchContext) -> None:
    assert s.OrSubstitution("false", "0").perform(context) == "false"
    assert _markup(context, "$(or $(var yes) $(var no))") == "true"


@_row
def AnySubstitution(context: LaunchContext) -> None:
    assert s.AnySubstitution("false", "0", "true").perform(context) == "true"
    assert _markup(context, "$(any $(var no) false)") == "false"


@_row
def AllSubstitution(context: LaunchContext) -> None:
    assert s.AllSubstitution("true", "1", "true").perform(context) == "true"
    assert _markup(context, "$(all $(var yes) $(var no) true)") == "false"


@_row
def EqualsSubstitution(context: LaunchContext) -> None:
    pairs = [
        ("a", "a"),
        ("1", "True"),
        ("1.0", 1.0),
        (None, ""),
        (False, "0"),
        ("0.1", 0.1 + 1e-12),
    ]
    for left, right in pairs:
        assert s.EqualsSubstitution(left, right).perform(context) == "true"
    assert s.EqualsSubstitution("a", "b").perform(context) == "false"
    assert _markup(context, "$(equals $(var word) w)") == "true"


@_row
def NotEqualsSubstitution(context: LaunchContext) -> None:
    assert s.NotEqualsSubstitution("2", 2.0).perform(context) == "false"
    assert _markup(context, "$(not-equals $(var word) v)") == "true"


@_row
def IfElseSubstitution(context: LaunchContext) -> None:
    assert s.IfElseSubstitution("true", "a", "b").perform(context) == "a"
    assert s.IfElseSubstitution("0", if_value="a").perform(context) == ""
    assert _markup(context, "$(if $(var no) a b)") == "b"
    with pytest.raises(RuntimeError, match="One of if_value and else_value must be specified"):
        s.IfElseSubstitution("true")


@_row
def SubstitutionFailure(context: LaunchContext) -> None:
    with pytest.raises(RuntimeError, match="not here"):
        raise s.SubstitutionFailure("not here")
    with pytest.raises(NotImplementedError):
        Substitution().perform(context)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ""),
        ("plain $ and $x", "plain $ and $x"),
        (r"\$(var word)", "$(var word)"),
        ("$(var word)", "w"),
        ("a$(var word)b$(var word)", "awbw"),
        ("$(var $(var in))", "w"),
        ("$(var x $(var word)b)", "wb"),
        ("$(var x 'a $(var word) b')", "a w b"),
        ("$(var x \"a '$(var word)'\")", "a 'w'"),
        (r"$(var x a\)b)", "a)b"),
        ("$(var x '(a)')", "(a)"),
        ("$(var x '')", ""),
        (r'$(eval "\"$(var word)\" == \"w\"")', "True"),
        ('$(eval \'"$(var word)" == "w"\')', "True"),
    ],
)
def test_markup(text: str, expected: str, context: LaunchContext) -> None:
    context.launch_configurations.update({"word": "w", "in": "word"})
    assert _markup(context, text) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a $(var word", "'\\$\\(var word' is not closed"),
        ("$(var  word)", "an argument is empty; one blank parts them"),
        ("$(1 + 2)", "needs the name of a substitution"),
        ("$(eval int(1))", "a bracket within an argument; quote the argument"),
        ("$(var x 'a)", "the quotation mark ' is not closed"),
        ("$(var a'b')", "a quotation mark within an argument"),
        ("$(vra word)", "Unknown substitution: vra \\(did you mean 'var'"),
        ("$(var)", "var substitution expects 1 or 2 arguments"),
        ("$(not a b)", "not substitution expects 1 argument"),
        ("$(dirname x)", "dirname substitution doesn't expect arguments"),
        ("$(not " * 200 + "a" + ")" * 200, "more than 100 substitutions within each other"),
    ],
)
def test_wrong_markup(text: str, message: str) -> None:
    with pytest.raises((ValueError, RuntimeError, TypeError), match=message):
        parse_substitution(text)


@_row
def PathSubstitution(context: LaunchContext) -> None:
    path = s.PathSubstitution(s.LaunchConfiguration("word")) / "a" / ["b", ".txt"]
    assert path.perform(context) == os.path.join("w", "a", "b.txt")  # noqa: PTH118
    assert s.PathSubstitution(["x", "y"]).perform(context) == os.path.join("x", "y")  # noqa: PTH118
    joined = s.PathJoinSubstitution(["x"]) / s.LaunchConfiguration("word")
    assert joined.perform(context) == os.path.join("x", "w")  # noqa: PTH118


@_row
def StringJoinSubstitution(context: LaunchContext) -> None:
    texts = [["a", s.LaunchConfiguration("word")], "b"]
    assert s.StringJoinSubstitution(texts).perform(context) == "awb"
    assert s.StringJoinSubstitution(texts, "-").describe().startswith("StringJoin([")
    assert _markup(context, "$(string-join . x$(var word) y)") == "xw.y"
    with pytest.raises(TypeError, match="string-join substitution expects at least 2 arguments"):
        s.StringJoinSubstitution.parse(["."])


@_row
def ForEachVar(context: LaunchContext) -> None:
    context.extend_locals({s.ForEachVar.get_local_arg_name("n"): "5"})
    assert _markup(context, "$(for-var n)$(for-var m 6)") == "56"
    with pytest.raises(s.SubstitutionFailure, match="No value available for ForEachVar 'm'"):
        s.ForEachVar("m").perform(context)


@_row
def ForLoopIndex(context: LaunchContext) -> None:
    context.extend_locals({s.ForEachVar.get_local_arg_name("i"): "2"})
    assert _markup(context, "$(index i)") == "2"


def test_command_that_prints_without_end_is_ended(
    context: LaunchContext, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", "0.015625")
    with pytest.raises(s.SubstitutionFailure) as failure:
        s.Command("cat /dev/zero").perform(context)
    assert str(failure.value) == (
        "'cat /dev/zero' prints more than 1 MiB and was ended (if the file means it, set the "
        "environment variable GAZELLE_LIMITS=10 for ten times). Command: cat /dev/zero"
    )
