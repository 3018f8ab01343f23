"""xacro's own elements that are written wrongly, and ``$(arg …)``, ``$(find …)`` and their like."""

from __future__ import annotations

import re

from gazelle.description.xacro.dom import span_of
from gazelle.description.xacro.failure import Explanation, Failure, is_below, listed, one_line
from gazelle.description.xacro.macro_definitions import definitions_in
from gazelle.description.xacro.xml_output import UnwritableError
from gazelle.diagnostics import did_you_mean

__all__ = ["explain_element", "explain_substitution"]

_COMMANDS = ("arg", "cwd", "dirname", "env", "eval", "find", "optenv")
_MISSING = re.compile(r"(\S+): missing attribute '(.+?)'")
_CONDITION = re.compile(r'Xacro conditional "(.*)" evaluated to "(.*)", which is not', re.DOTALL)


def explain_substitution(failure: Failure) -> Explanation | None:
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
    return Explanation("xacro.bad-substitution", message, failure.span, fix)


def explain_element(failure: Failure) -> Explanation | None:
    """Explain missing attributes, conditions and names; None for other failures."""
    text = str(failure.error)
    if isinstance(failure.error, UnwritableError):
        return _unwritable(failure.error, failure)
    found = _MISSING.search(text)
    if found is not None:
        return _missing(found[1], found[2], failure)
    found = _CONDITION.search(text)
    if found is not None:
        return _condition(found[1], found[2], failure)
    if text.startswith("Property "):
        return _property(text, failure)
    if "empty name" in text or "Invalid use of macro name" in text or "macro names must" in text:
        span = failure.attribute_place("name")
        return Explanation("xacro.bad-element", one_line(text), span, "give it another name")
    return None


def _no_argument(name: str, failure: Failure) -> Explanation:
    message = f"$(arg {name}) has no value"
    arguments = failure.library_run.arguments
    fix = f'pass {name}:=… or write <xacro:arg name="{name}" default="…"/>'
    files = failure.library_run.tracker.files
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
    return Explanation("xacro.argument-missing", message, here, fix, name)


def _bad_eval(failure: Failure) -> Explanation:
    reason = one_line(str(failure.causes[-1]))
    message = f"cannot evaluate '{failure.part}': {reason}"
    fix = ""
    if failure.part.count("(") > failure.part.count(")"):
        message = f"'{failure.part}' is incomplete: xacro ends $(…) at the first ')'"
        fix = "write ${…} with xacro.arg('name') in place of $(eval …)"
    return Explanation("xacro.bad-expression", message, failure.span, fix)


def _unwritable(error: UnwritableError, failure: Failure) -> Explanation:
    tag, value = error.element.tagName, f"{error.name}={error.value!r}"
    message = f"{error}: <xacro:attribute> gives <{tag}> the number {value}, and xacro can only"
    message += " write texts"
    fix = 'write value="${str(…)}" in <xacro:attribute>'
    return Explanation("xacro.failed", message, span_of(error.element) or failure.span, fix)


def _missing(tag: str, attribute: str, failure: Failure) -> Explanation:
    written = list(failure.node.attributes.keys())
    message = f"<{tag}> needs the attribute '{attribute}'"
    fix = did_you_mean(attribute, written) and f"rename the attribute to '{attribute}'"
    if tag == "xacro:arg" and attribute == "default":
        message += "; an argument without a default is not declared at all"
        fix = 'add default="…", or remove the element: $(arg …) works without it'
    failure.text = ""
    fix = fix or f'add {attribute}="…"'
    return Explanation("xacro.bad-element", message, failure.span, fix)


def _condition(condition: str, value: str, failure: Failure) -> Explanation:
    shown = f"'{condition}' is '{value}', which" if condition != value else f"'{value}'"
    message = f"{shown} is not a boolean expression: <{failure.node.tagName}> takes "
    message += "true, false, 1, 0 or an expression in ${…}"
    fix = ""
    word = value.strip().lower()
    if word in {"yes", "on"}:
        fix = "write true"
    elif word in {"no", "off", "none", ""}:
        fix = "write false"
    elif word in {"true", "false"}:
        fix = f"write {word}"
    elif re.search(r"==|!=|<|>|\b(and|or|not)\b", value):
        fix = f"put it into braces: ${{{value}}}"
    elif value.isidentifier():
        fix = f"write ${{{value}}} for a property, $(arg {value}) for an argument"
    elif re.fullmatch(r"-?\d*\.\d*", value):
        fix = f"write ${{{value} != 0}}"
    return Explanation("xacro.bad-condition", message, failure.attribute_place("value"), fix)


def _property(text: str, failure: Failure) -> Explanation:
    name = text.rpartition(":")[2].strip()
    span = failure.attribute_place("name")
    if "mutually exclusive" in text:
        message = f"property '{name}' has more than one of value, default and remove"
        return Explanation("xacro.bad-element", message, span, "keep one of them", name)
    fixed = re.sub(r"\W", "_", name)
    fixed = f"_{fixed}" if fixed[:1].isdigit() else fixed
    fix = f"write '{fixed}'" if fixed.isidentifier() and fixed != name else "use another name"
    if "double underscore" not in text:
        text = f"Property names must be valid python identifiers: '{name}' is none"
    return Explanation("xacro.bad-element", one_line(text), span, fix, name)
