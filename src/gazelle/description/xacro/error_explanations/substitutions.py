"""``$(arg …)``, ``$(find …)``, ``$(env …)`` and ``$(eval …)`` that fail."""

from __future__ import annotations

from gazelle.description.xacro.error_explanations.finding import Finding, is_below, listed, one_line
from gazelle.description.xacro.failure import Failure
from gazelle.description.xacro.macro_definitions import definitions_in
from gazelle.diagnostics import did_you_mean

__all__ = ["explain_substitution"]

_COMMANDS = ("arg", "cwd", "dirname", "env", "eval", "find", "optenv")


def explain_substitution(failure: Failure) -> Finding | None:
    """Explain what stands in ``$(…)``; None for other failures."""
    names = {type(item).__name__: item for item in failure.causes}
    if "ArgException" in names:
        return _no_argument(str(names["ArgException"]), failure)
    if failure.part.startswith("$(eval"):
        return _bad_eval(failure)
    if "SubstitutionException" not in names:
        return None
    message = f"cannot evaluate '{failure.part}': {one_line(str(names['SubstitutionException']))}"
    word = failure.part[2:-1].split(" ")[0] if failure.part else ""
    fix = ""
    if "Unknown substitution command" in message:
        message = f"there is no $({word} …); there are {listed(_COMMANDS)}"
        fix = did_you_mean(word, _COMMANDS)
    elif word == "env":
        fix = f"set the variable, or give a default: $(optenv {failure.part[6:-1].strip()} VALUE)"
    elif word == "dirname":
        fix = "xacro does not know $(dirname); paths of includes are relative to their file anyway"
    return Finding("xacro.bad-substitution", message, failure.span, fix)


def _no_argument(name: str, failure: Failure) -> Finding:
    message = f"$(arg {name}) has no value"
    arguments = failure.session.arguments
    fix = f'pass {name}:=… or write <xacro:arg name="{name}" default="…"/>'
    files = failure.session.tracker.files
    found = [item for item in definitions_in(files) if item.name == name]
    here = failure.span
    for item in found:
        if item.kind == "arg" and is_below(item.span, here):
            message += f"; its <xacro:arg> stands further down, in line {item.span.line}"
            fix = f"pass {name}:=…; its <xacro:arg> with the default comes after this use"
            break
        if item.kind == "property":
            fix = f"{name} is a property ({item.span}): write ${{{name}}}"
            break
    else:
        hint = did_you_mean(name, arguments)
        fix = f"{hint} or {fix}" if hint else fix
    return Finding("xacro.argument-missing", message, here, fix, name)


def _bad_eval(failure: Failure) -> Finding:
    reason = one_line(str(failure.causes[-1]))
    message = f"cannot evaluate '{failure.part}': {reason}"
    fix = ""
    if failure.part.count("(") > failure.part.count(")"):
        message = f"'{failure.part}' is incomplete: xacro ends $(…) at the first ')'"
        fix = "write ${…} with xacro.arg('name') in place of $(eval …)"
    return Finding("xacro.bad-expression", message, failure.span, fix)
