"""Codes of the XML reader that URDF, SDF, SRDF and launch files share."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "xml.malformed",
        "error",
        "The file is not well-formed XML",
        "Nothing after the place named can be trusted, so nothing of the file is used.",
        "close the tag or quote the attribute at the place shown",
        "XML parsing error",
    ),
    Entry(
        "xml.entity",
        "error",
        "The file defines XML entities",
        "Entities can read other files or grow without bound; robot descriptions do not need them.",
        "write the text itself where the entity is used",
    ),
    Entry(
        "xml.lenient",
        "info",
        "The file is read although it is no well-formed XML",
        "Gazebo's parser reads '--' in comments, a bare '&' and a comment before <?xml …?>, and so "
        "does Gazelle; xacro and most other tools refuse them.",
        "write '-' in comments, '&amp;' for '&', and <?xml …?> first",
    ),
    Entry(
        "xml.unreadable",
        "error",
        "The file cannot be read",
        "It does not exist, is a folder, is not readable by this user, or is not text.",
        "check the path, its permissions and its encoding (UTF-8)",
        "Unable to open file",
    ),
    Entry(
        "xml.bad-number",
        "error",
        "A number cannot be understood",
        "Numbers are read without the locale: a dot is the decimal sign, whatever LANG says.",
        "write plain numbers separated by spaces, such as 0.5 0 1e-3",
        "Unable to parse component to a double (while parsing a vector value)",
    ),
    Entry(
        "xml.unknown-tag",
        "warning",
        "A tag is not known here",
        "It has no effect. ROS and Gazebo drop such tags in silence, which hides typing mistakes.",
        "correct the name or remove the tag",
    ),
    Entry(
        "xml.unknown-attribute",
        "warning",
        "An attribute is not known here",
        "It has no effect. ROS and Gazebo drop such attributes in silence.",
        "correct the name or remove the attribute",
    ),
    Entry(
        "xml.missing-attribute",
        "error",
        "A required attribute is missing",
        "The element cannot be used without it.",
        "add the attribute",
    ),
    Entry(
        "xml.missing-tag",
        "error",
        "A required child element is missing",
        "The element cannot be used without it.",
        "add the child element",
    ),
    Entry(
        "xml.repeated-tag",
        "warning",
        "An element that may stand once stands twice",
        "The first one counts, as in ROS and Gazebo.",
        "remove one of the two",
    ),
)
