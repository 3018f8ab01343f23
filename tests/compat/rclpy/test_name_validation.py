"""Names that rclpy (rmw and rcl) takes and refuses; texts are those of rclpy 9.1.2."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.compat.rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException
from gazelle.compat.rclpy.name_validation import (
    expand_topic_name,
    validate_full_topic_name,
    validate_namespace,
    validate_node_name,
    validate_parameter_name,
    validate_topic_name,
)

_OTHER = "must not contain characters other than alphanumerics"


@pytest.mark.reference
@pytest.mark.parametrize(
    ("check", "name", "text"),
    [
        (validate_topic_name, "a/", "topic name must not end with a forward slash:\n  'a/'\n    ^"),
        (validate_topic_name, "1a", "topic name token must not start with a number:\n  '1a'\n   ^"),
        (
            validate_topic_name,
            "a b",
            f"topic name {_OTHER}, '_', '~', '{{', or '}}':\n  'a b'\n    ^",
        ),
        (validate_topic_name, "", "topic name must not be empty string:\n  ''\n   ^"),
        (validate_topic_name, "a~b", "must not have tilde '~' unless it is the first character"),
        (validate_topic_name, "{bad/x", "substitution name must not contain"),
        (
            validate_topic_name,
            "{",
            "must not have unmatched (unbalanced) curly braces '{}':\n  '{'",
        ),
        (validate_topic_name, "a}", "must not have unmatched (unbalanced) curly braces '{}'"),
        (validate_full_topic_name, "a", "topic name must be absolute, it must lead with a '/'"),
        (validate_full_topic_name, "/a//b", "must not contain repeated '/':\n  '/a//b'\n      ^"),
        (validate_full_topic_name, "/a/", "topic name must not end with a '/':\n  '/a/'\n     ^"),
        (validate_full_topic_name, "/1a", "must not have a token that starts with a number"),
        (validate_full_topic_name, "", "topic name must not be empty:\n  ''\n   ^"),
        (validate_node_name, "1a", "node name must not start with a number:\n  '1a'\n   ^"),
        (validate_node_name, "a/b", f"node name {_OTHER} or '_':\n  'a/b'\n    ^"),
        (validate_node_name, "", "node name must not be empty"),
        (validate_namespace, "a", "namespace must be absolute, it must lead with a '/'"),
        (validate_namespace, "/a/", "namespace must not end with a '/', unless only a '/'"),
        (validate_namespace, "/a b", f"namespace {_OTHER}, '_', or '/':\n  '/a b'\n     ^"),
        (validate_parameter_name, "", "Invalid parameter name: "),
    ],
)
def test_illegal_name_is_refused_in_rmws_words(check: Any, name: str, text: str) -> None:
    with pytest.raises(Exception, match=r"^Invalid ") as caught:
        check(name)
    assert text in str(caught.value)


@pytest.mark.parametrize("name", ["chatter", "/a/b", "~/x", "~", "a//b", "{node}/x", "a__b"])
def test_legal_topic_is_taken(name: str) -> None:
    assert validate_topic_name(name) is True


def test_services_have_an_exception_of_their_own() -> None:
    with pytest.raises(InvalidServiceNameException, match="Invalid service name"):
        validate_topic_name("a b", is_service=True)
    with pytest.raises(InvalidTopicNameException) as caught:
        validate_full_topic_name("/a b")
    assert caught.value.invalid_index == 2


@pytest.mark.reference
def test_names_are_expanded_as_rcl_does() -> None:
    def expanded(name: str) -> str:
        return expand_topic_name(name, "me", "/space")

    assert expanded("chatter") == "/space/chatter"
    assert expanded("/a/b") == "/a/b"
    assert (expanded("~/x"), expanded("~")) == ("/space/me/x", "/space/me")
    assert (expanded("{node}/x"), expanded("{ns}/y")) == ("/space/me/x", "/space/y")
    assert expand_topic_name("a", "me", "/") == "/a"
    with pytest.raises(ValueError, match=r"'\{q\}/x' is invalid: unknown substitution: \{q\}"):
        expanded("{q}/x")
    with pytest.raises(ValueError, match="node name 'b ad' is invalid"):
        expand_topic_name("a", "b ad", "/")
    with pytest.raises(ValueError, match="node namespace '/1' is invalid: namespace must not have"):
        expand_topic_name("a", "b", "/1")
