"""``.db3`` files: rosbag2's storage in SQLite, schema version 4 (Iron and later)."""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from gazelle.bag.storage import (
    BagError,
    BagMessage,
    Connection,
    Encoding,
    Storage,
    Summary,
    Wanted,
)
from gazelle.rich_display import shown_by

__all__ = ["SQLITE_MAGIC", "SqliteBag", "SqliteWriter"]

SQLITE_MAGIC = b"SQLite format 3\0"

_SCHEMA = """
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL,
  metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
  serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL,
  type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL,
  encoding TEXT NOT NULL, encoded_message_definition TEXT NOT NULL,
  type_description_hash TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,
  timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
"""
_SCHEMA_VERSION = 4
_INSERT = "INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)"
_HELD_BYTES = 1 << 20


class SqliteWriter:
    """Writes a ``.db3``: the journal is written ahead, so a killed writer loses no transaction.

    Attributes:
        path: the file.
    """

    storage: str = Storage.SQLITE
    encoding = Encoding.CDR

    def __init__(self, path: Path) -> None:
        """Create the file.

        Raises:
            BagError: the file system refuses it.
        """
        self.path = path
        try:
            path.unlink(missing_ok=True)
            self._database = sqlite3.connect(path, isolation_level=None, check_same_thread=False)
            self._database.execute("PRAGMA journal_mode=WAL")
            self._database.execute("PRAGMA synchronous=NORMAL")
            self._database.executescript(_SCHEMA)
        except (OSError, sqlite3.Error) as error:
            raise BagError(f"Error opening file: {path}: {error}") from None
        distribution = os.environ.get("ROS_DISTRO", "unknown")
        self._database.execute("INSERT INTO schema VALUES (?, ?)", (_SCHEMA_VERSION, distribution))
        self._added = 0
        self._waiting: list[tuple[int, int, bytes]] = []
        self._held = 0
        self._written = 0
        self._types: set[str] = set()
        self._closed = False

    @property
    def size(self) -> int:
        """Bytes of messages written so far, those that wait included."""
        return self._written + self._held

    def add(self, connection: Connection) -> Connection:
        """Add a topic; returns it with its number in this bag."""
        self._added += 1
        own = replace(connection, id=self._added)
        row = (own.id, own.topic, own.type_name, "cdr", own.qos, own.type_hash)
        self._database.execute("INSERT INTO topics VALUES (?, ?, ?, ?, ?, ?)", row)
        if own.type_name not in self._types:
            self._types.add(own.type_name)
            columns = "(topic_type, encoding, encoded_message_definition, type_description_hash)"
            values = (own.type_name, "ros2msg", own.definition, own.type_hash)
            insert = f"INSERT INTO message_definitions {columns} VALUES (?, ?, ?, ?)"  # noqa: S608
            self._database.execute(insert, values)
        return own

    def write(self, connection: Connection, stamp_ns: int, data: bytes) -> None:
        """Write one message."""
        self._waiting.append((connection.id, stamp_ns, data))
        self._held += len(data)
        if self._held >= _HELD_BYTES:
            self.flush()

    @property
    def restored(self) -> int:
        """How often the file was written anew: SQLite cannot do that."""
        return 0

    def flush(self) -> None:
        """Write what waits, as one transaction.

        Raises:
            BagError: the disk is full, somebody removed the file, or SQLite fails otherwise.
        """
        if not self._waiting:
            return
        if not self.path.exists():
            raise BagError(f"Error writing to file: {self.path}: somebody has removed it")
        try:
            self._database.execute("BEGIN")
            self._database.executemany(_INSERT, self._waiting)
            self._database.execute("COMMIT")
        except sqlite3.Error as error:
            raise BagError(f"Error writing to file: {self.path}: {error}") from None
        self._written += self._held
        self._waiting, self._held = [], 0

    def close(self) -> None:
        """Finish the file, which is one file again; calling it twice does nothing."""
        if self._closed:
            return
        self.flush()
        self._closed = True
        self._database.execute("PRAGMA journal_mode=DELETE")
        self._database.close()


@shown_by("bags:bag_bundle")
class SqliteBag:
    """An open ``.db3``, of any schema version.

    Attributes:
        path: the file.
    """

    storage: str = Storage.SQLITE

    def __init__(self, path: Path) -> None:
        """Open a file.

        Raises:
            BagError: it cannot be read or is not such a bag.
        """
        self.path = path
        try:
            self._database = _open(path)
            self._connections = _topics(self._database)
        except (OSError, sqlite3.Error, KeyError, ValueError) as error:
            raise BagError(f"{path}: this is not a bag of rosbag2: {error}") from None

    @property
    def connections(self) -> tuple[Connection, ...]:
        """All topics, by number."""
        return tuple(self._connections.values())

    @property
    def summary(self) -> Summary:
        """What is in it."""
        with _told(self.path):
            chosen = f"FROM messages WHERE {_WHOLE}"
            select = f"SELECT topic_id, COUNT(*) {chosen} GROUP BY topic_id"
            rows = self._database.execute(select).fetchall()
            counts = {number: count for number, count in rows if number in self._connections}
            edge = f"SELECT timestamp {chosen} ORDER BY timestamp {{}} LIMIT 1"
            first, last = (self._database.execute(edge.format(way)).fetchone() for way in _WAYS)
        start_ns, end_ns = (first[0], last[0]) if first and last else (0, 0)
        return Summary(counts, start_ns, end_ns, self.path.stat().st_size)

    def messages(
        self, wanted: Wanted | None = None, start_ns: int | None = None, end_ns: int | None = None
    ) -> Iterator[BagMessage]:
        """Yield messages by time, those of `wanted` topics between two stamps.

        Raises:
            BagError: the file is damaged there.
        """
        chosen = {
            number: one
            for number, one in self._connections.items()
            if wanted is None or wanted(one)
        }
        marks = ",".join("?" * len(chosen))
        span = (0 if start_ns is None else start_ns, (1 << 63) - 1 if end_ns is None else end_ns)
        where = f"{_WHOLE} AND timestamp BETWEEN ? AND ? AND topic_id IN ({marks})"
        columns = "SELECT topic_id, timestamp, data FROM messages"
        select = f"{columns} WHERE {where} ORDER BY timestamp, id"
        with _told(self.path):
            rows = self._database.execute(select, (*span, *chosen))
        while True:
            with _told(self.path):
                row = rows.fetchone()
            if row is None:
                return
            yield BagMessage(chosen[row[0]], row[1], row[2])

    def close(self) -> None:
        """Close the file."""
        self._database.close()


_WAYS = ("ASC", "DESC")
# SQLite keeps values of any type in any column; a damaged file has some.
_WHOLE = "typeof(timestamp) = 'integer' AND typeof(data) = 'blob'"


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Raise what SQLite finds wrong as the bag's error."""
    try:
        yield
    except (sqlite3.Error, OverflowError, UnicodeDecodeError) as error:
        raise BagError(f"{path}: the file is damaged: {error}") from None


def _open(path: Path) -> sqlite3.Connection:
    if not path.is_file():
        raise FileNotFoundError("there is no such file")
    # What a killed writer left in its journal belongs to the bag; reading that needs writing.
    left = path.with_name(f"{path.name}-wal")
    if left.is_file() and left.stat().st_size and os.access(path, os.W_OK):
        return sqlite3.connect(path, check_same_thread=False)
    return sqlite3.connect(
        f"{path.absolute().as_uri()}?mode=ro&immutable=1", uri=True, check_same_thread=False
    )


def _topics(database: sqlite3.Connection) -> dict[int, Connection]:
    rows: list[tuple[Any, ...]] = database.execute("SELECT * FROM topics ORDER BY id").fetchall()
    names = [one[1] for one in database.execute("PRAGMA table_info(topics)")]
    definitions = _definitions(database)
    found = {}
    for row in rows:
        values = dict(zip(names, row, strict=True))
        found[values["id"]] = Connection(
            values["id"],
            values["name"],
            values["type"],
            Encoding.CDR,
            definitions.get(values["type"], ""),
            qos=values.get("offered_qos_profiles", ""),
            type_hash=values.get("type_description_hash", ""),
        )
    return found


def _definitions(database: sqlite3.Connection) -> dict[str, str]:
    """Return the texts of types; Humble's schema has none."""
    tables = {one[0] for one in database.execute("SELECT name FROM sqlite_master")}
    if "message_definitions" not in tables:
        return {}
    select = "SELECT topic_type, encoded_message_definition FROM message_definitions"
    return dict(database.execute(f"{select} WHERE encoding = 'ros2msg'").fetchall())
