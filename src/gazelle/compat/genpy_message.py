"""Messages filled from lists and dictionaries, and shown: functions of `genpy.message`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from gazelle.errors import GazelleError
from gazelle.interfaces import Time, fill
from gazelle.interfaces.echo_text import strify

__all__ = ["fill_message_args", "strify_message"]


def fill_message_args(msg: Any, msg_args: Any, keys: Mapping[str, Any] | None = None) -> None:
    """Set a message's fields.

    Args:
        msg: the message.
        msg_args: a value for each field, or one dictionary of fields, as YAML gives them.
        keys: values that a text stands for, such as ``now``.

    Raises:
        MessageException: they do not fit.
        ValueError: `msg_args` is neither list nor dictionary.
    """
    from genpy import MessageException  # type: ignore[import-not-found]

    if not isinstance(msg_args, (list, dict)):
        raise ValueError(f"invalid message_args type: {msg_args}")
    try:
        fill(msg, msg_args, keys=keys)
    except (GazelleError, TypeError, ValueError) as error:
        raise MessageException(str(error)) from error


def strify_message(
    val: Any,
    indent: str = "",
    time_offset: Time | None = None,
    current_time: Time | None = None,
    field_filter: Callable[[Any], Iterable[str]] | None = None,
    fixed_numeric_width: int | None = None,
) -> str:
    """Return a message as the text that ``rostopic echo`` shows.

    Args:
        val: the message, or a value of one.
        indent: white space in front of each line.
        time_offset: times are shown relative to it.
        current_time: without effect, as in genpy.
        field_filter: gives the fields that are shown.
        fixed_numeric_width: numbers are cut or filled to so many characters.
    """
    return strify(
        val,
        indent,
        time_offset=time_offset,
        field_filter=field_filter,
        width=fixed_numeric_width,
    )
