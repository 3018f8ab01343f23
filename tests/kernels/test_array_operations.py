"""Places in arrays, parts of them, and new ones, as NumPy has them."""

from __future__ import annotations

import itertools
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.kernels.python_oracle import assert_as_in_python, exact

from gazelle.kernels import kernel

_NAMES = (
    "bool", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32",
    "float64",
)  # fmt: skip
_MATRIX = np.arange(12.0).reshape(3, 4)
_CUBE = np.arange(24).reshape(2, 3, 4)


def _layouts(array: Any) -> list[Any]:
    """Return arrays of the same dimensions that lie differently in memory."""
    wide = np.repeat(array, 2, axis=-1)
    return [array, np.asfortranarray(array), wide[..., ::2], array[..., ::-1], array[::-1]]


# Elements


@kernel
def _element(row, k):
    return row[k]


@pytest.mark.parametrize("name", _NAMES)
def test_elements_of_every_type_are_read_and_written(name: str) -> None:
    row = np.array([0, 1, 2, 100]).astype(name)
    assert_as_in_python(_written, row)
    for k in range(-4, 4):
        assert exact(_element(row, k)) == exact(row[k])


@kernel
def _written(row):
    row[0], row[1] = row[3], row[0]
    row[-1] = 1
    row[-2] = True
    row[1] += 1


@kernel
def _everywhere(row, k):
    return row[k], row[-1], row[0], row[len(row) - 1], row[-len(row)]


@given(st.lists(st.integers(-100, 100), min_size=1), st.data())
def test_a_negative_index_counts_from_the_end(numbers: list[int], data: st.DataObject) -> None:
    k = data.draw(st.integers(-len(numbers), len(numbers) - 1))
    row = np.array(numbers)
    for layout in (row, np.repeat(row, 2)[::2], row[::-1]):
        assert_as_in_python(_everywhere, layout, k)


@kernel
def _at_unsigned(row, places):
    total = 0
    for k in range(len(places)):
        total += row[places[k]]
    return total


def test_integers_without_a_sign_are_indices() -> None:
    for name in ("uint8", "uint16", "uint32", "uint64", "int8"):
        assert_as_in_python(_at_unsigned, np.arange(300), np.array([3, 127, 7], name))


@kernel
def _sums(matrix):
    rows, columns = matrix.shape
    total, last = 0.0, 0.0
    for k in range(rows):
        for j in range(columns):
            total += matrix[k, j] * (k + 1) * (j + 3)
            last = matrix[-k - 1, -j - 1]
            matrix[k, j] += 1
    return total, last, matrix.size, len(matrix)


@kernel
def _cube_sums(cube):
    total = 0
    for i in range(cube.shape[0]):
        for j in range(cube.shape[1]):
            row = cube[i, j]
            for k in range(cube.shape[2]):
                total += cube[i, j, k] * (i + 2 * j + 5 * k) + row[k] + cube[i][j][-k]
    return total


def test_arrays_of_several_dimensions_lie_in_any_order() -> None:
    for matrix in (*_layouts(_MATRIX), _MATRIX.T, _MATRIX[1:, 1:3], _MATRIX[:0], _MATRIX[:, :0]):
        assert_as_in_python(_sums, matrix)
    for cube in (*_layouts(_CUBE), _CUBE.T, _CUBE.transpose(1, 0, 2), _CUBE[:, 1:, ::3]):
        assert_as_in_python(_cube_sums, cube)


# Parts


@kernel
def _slices(row, first, last):
    return (
        (row[first:last].copy(), row[first:].copy(), row[:last].copy(), row[:].copy()),
        (row[1:last].copy(), row[-2:].copy(), row[:-1].copy(), row[first:-1].copy()),
        (len(row[first:last]), len(row[2:1]), len(row[-100:100]), len(row[first:][1:last])),
    )


@given(st.integers(0, 6), st.integers(-9, 9), st.integers(-9, 9))
def test_slices_are_those_of_numpy(size: int, first: int, last: int) -> None:
    row = np.arange(float(size))
    for layout in (row, np.repeat(row, 2)[::2], row[::-1]):
        assert_as_in_python(_slices, layout, first, last)


@kernel
def _parts_of_matrix(matrix, k, m, n):
    column, row = matrix[:, k], matrix[k]
    block = matrix[m:n, 1:3]
    rows, last = matrix[m:n], matrix[m:, -1]
    whole = matrix[:, :]
    corner = matrix[m:n][:, n:][:1]
    return (
        column.copy(), row.copy(), block.copy(), rows.copy(), last.copy(), whole.copy(),
        corner.copy(), block.shape, block.size, matrix[k, 1:].copy(), matrix[m:n, :].copy(),
        matrix[:, m:n].copy(), matrix[k][m:n].copy(),
    )  # fmt: skip


@pytest.mark.parametrize("layout", range(5))
def test_parts_of_matrices_are_those_of_numpy(layout: int) -> None:
    matrix = _layouts(_MATRIX)[layout]
    for k, m, n in itertools.product((-3, 0, 2), (-2, 0, 1), (-1, 0, 2, 9)):
        assert_as_in_python(_parts_of_matrix, matrix, k, m, n)


@kernel
def _parts_of_cube(cube, k, m):
    return (
        cube[k].copy(), cube[:, k].copy(), cube[:, :, k].copy(), cube[k, :, m:].copy(),
        cube[k:, m].copy(), cube[k, m:].copy(), cube[:, m:, k].copy(), cube[:, :, m:].copy(),
        cube[m:, :, :].copy(), cube[k, m].copy(), cube[m:, m:, m:].copy(), cube[:, k, m],
    )[:11]  # fmt: skip


@kernel
def _changed(matrix, k):
    part = matrix[1:, 1:]
    part[0, k] = -1.0
    matrix[:, 0] = 7
    matrix[0, 2:] = 2.5
    row = matrix[2]
    row[-1] += 4
    row[:2] = matrix[1, 1:3]
    matrix[-1, -1] *= 2
    column = matrix[:, 1]
    column[:] = 9
    column[k] -= 1


@pytest.mark.parametrize("layout", range(5))
def test_parts_share_the_memory_of_the_whole(layout: int) -> None:
    for k in (-1, 0, 1):
        assert_as_in_python(_changed, _layouts(_MATRIX)[layout], k)


@kernel
def _filled(matrix, other, value):
    matrix[:] = value
    matrix[1:, :2] = other
    matrix[0] = other[0, 0]
    return matrix.copy()


def test_parts_are_filled_with_numbers_and_with_parts() -> None:
    other = np.arange(4.0).reshape(2, 2) + 0.25
    for matrix, there in itertools.product(_layouts(_MATRIX)[1:3], _layouts(other)[1:3]):
        assert_as_in_python(_filled, matrix, there, 3.5)
        assert_as_in_python(_filled, matrix.astype(np.int8), there, 3)
        assert_as_in_python(_filled, matrix.astype(bool), there, 0.5)


@kernel
def _reshaped(matrix):
    flat = matrix.ravel()
    flat[1] = 100
    again = flat.reshape(2, matrix.size // 2)
    again[1, 0] = 200
    other = matrix.reshape((matrix.size, 1))
    other[2, 0] = 300
    return flat.copy(), again.copy(), other.copy(), again.shape, other.shape


def test_another_shape_shares_the_memory() -> None:
    assert_as_in_python(_reshaped, _MATRIX)
    assert_as_in_python(_reshaped, _CUBE)


def test_what_does_not_lie_in_order_has_no_other_shape() -> None:
    line = _reshaped.source.function.__code__.co_firstlineno + 2
    with pytest.raises(TypeError) as error:
        _reshaped(_MATRIX.T)
    assert (
        str(error.value)
        == f"kernel {__file__}:{line}:12: kernels have no .ravel() of such an array"
    )


@kernel
def _empty_parts(row, matrix):
    none = row[0:0]
    none[:] = 3.0
    total = 0.0
    for k in range(len(none)):
        total += none[k]
    return none.copy(), len(none), matrix.shape, matrix.size, matrix.copy(), total


def test_arrays_without_elements_are_arrays() -> None:
    for shape in ((0, 3), (3, 0), (0, 0)):
        for matrix in (
            np.zeros(shape),
            np.zeros(shape).T,
            np.zeros((4, 6))[: shape[0], ::2][:, :0],
        ):
            assert_as_in_python(_empty_parts, np.arange(3.0), matrix)


@kernel
def _moved(row, k, m):
    row[k:] = row[: len(row) - k]
    row[: len(row) - m] = row[m:]
    row[1:-1] = row[2:]


def test_a_part_is_moved_within_its_array() -> None:
    for row in (np.arange(9.0), np.arange(18.0)[::2], np.arange(9.0)[::-1], np.arange(9)):
        for k, m in ((1, 1), (3, 2), (0, 0)):
            assert_as_in_python(_moved, row, k, m)


@kernel
def _moved_rows(matrix):
    matrix[1:, :] = matrix[:-1, :]
    matrix[:, :-1] = matrix[:, 1:]
    matrix[:2, 1:3] = matrix[1:, :2]


@pytest.mark.parametrize("layout", range(5))
def test_a_block_is_moved_within_its_matrix(layout: int) -> None:
    assert_as_in_python(_moved_rows, _layouts(_MATRIX)[layout])


@kernel
def _left_out(matrix):
    return matrix.reshape(-1).shape, matrix.reshape(2, -1).shape, matrix.reshape((-1, 3)).shape


def test_one_number_of_a_shape_may_be_left_out() -> None:
    assert_as_in_python(_left_out, _MATRIX)


@kernel
def _changing(row):
    row[0] = 100
    return 1


@kernel
def _changed_meanwhile(row):
    row[0] += _changing(row)


def test_what_is_changed_in_place_is_read_first() -> None:
    assert_as_in_python(_changed_meanwhile, np.array([1.0]))


# New arrays


@kernel
def _made(n):
    return (
        (np.zeros(n), np.ones(n), np.full(n, 2.5), np.full(n, 7), np.arange(n)),
        (np.zeros((n, 2)), np.ones((2, n, 1)), np.full((n, n), -1), np.zeros((3,))),
        (np.array([1, 2, n]), np.array((1.5, 2, n)), np.array([n * 0.5])),
        (np.full(n, n > 1), np.array([n > 1, n > 2]), np.array([1, n], dtype=np.float32)),
        (np.full(3, np.uint8(n)), np.arange(n, dtype=np.float32), np.array([np.float32(n)])),
    )


def test_new_arrays_are_those_of_numpy() -> None:
    for n in (0, 1, 5, 100):
        assert_as_in_python(_made, n)


@kernel
def _of_types(n):
    a = np.zeros(n, np.int8)
    b = np.ones(n, dtype=np.uint8)
    c = np.full(n, 3.7, np.int16)
    d = np.full(n, 3, dtype=np.float32)
    e = np.zeros((n, 2), np.uint16)
    f = np.ones(n, np.int32)
    g = np.zeros(n, dtype=np.uint32)
    h = np.ones(n, np.uint64)
    i = np.zeros(n, np.bool_)
    j = np.ones(n, bool)
    k = np.zeros(n, int)
    m = np.ones(n, dtype=float)
    return a, b, c, d, e, f, g, h, i, j, k, m


def test_new_arrays_have_the_type_that_is_asked_for() -> None:
    for n in (0, 3):
        assert_as_in_python(_of_types, n)


@kernel
def _emptied(n, value):
    found = np.empty((n, 2), np.float32)
    found[:] = value
    local = np.empty(3)
    local[:] = value
    local[0] = found[-1, -1]
    return found, local[0] + local[1]


def test_an_empty_array_can_be_filled() -> None:
    assert_as_in_python(_emptied, 4, 0.5)


@kernel
def _copies(row):
    other = row.copy()
    other[0] = 100
    part = row[1:].copy()
    part[0] = 99
    return other, part


def test_a_copy_has_memory_of_its_own() -> None:
    for name in ("float64", "int8", "bool"):
        for layout in _layouts(np.arange(4).astype(name)):
            assert_as_in_python(_copies, layout)


# Memory


@kernel
def _local(seed):
    work = np.zeros(8)
    big = np.zeros(1000)
    for k in range(len(work)):
        work[k] += seed + k
    big[-1] = work[-1]
    return work[0] + work[7] + big[999] + big[0]


@kernel
def _many_locals(n):
    total = 0.0
    for k in range(n):
        total += _local(k)
    return total


def test_local_arrays_are_cleared_in_each_call() -> None:
    assert_as_in_python(_local, 3)
    assert_as_in_python(_many_locals, 20)


@kernel
def _in_loop(n):
    kept = np.zeros(1)
    before = np.zeros(1)
    for k in range(n):
        row = np.zeros(4)
        row[0] = k
        if k > 0:
            kept[0] += before[0] + row[1]
        before = row
    return kept[0], before


def test_an_array_that_is_made_in_a_loop_is_another_one_each_time() -> None:
    assert_as_in_python(_in_loop, 5)


@kernel
def _new_row(n):
    row = np.zeros(n)
    row[:] = n
    return row


@kernel
def _two(n):
    one, other = _new_row(n), _new_row(n + 1)
    return one, other, one[0] + other[0]


@kernel
def _uses_two(n):
    total = 0.0
    for k in range(1, n):
        one, other, whole = _two(k)
        total += one[-1] * other[0] + whole + len(one)
    return total


def test_a_kernel_returns_arrays_to_another_one() -> None:
    assert_as_in_python(_two, 3)
    assert_as_in_python(_uses_two, 10)


@kernel
def _spent(n):
    total = 0.0
    for k in range(n):
        row = np.zeros(1000)
        row[k] = 1.0
        total += row[k] + len(_new_row(500))
    return total


def test_memory_is_given_back() -> None:
    process = psutil.Process()
    calls = {
        "in a loop": lambda: _spent(20),
        "by what is called": lambda: _uses_two(20),
        "returned": lambda: _two(2000),
    }
    for what, call in calls.items():
        for _ in range(100):
            call()
        before = process.memory_info().rss
        for _ in range(10_000 if what != "returned" else 2_000):
            call()
        # One block for each call would be some hundred megabytes.
        assert process.memory_info().rss - before < 10 * 2**20, what


# Records

_Record = np.dtype(
    [("x", np.float64), ("id", np.uint32), ("lit", np.bool_), ("near", np.float32, (3,)),
     ("turn", np.float64, (2, 2))],
    align=True,
)  # fmt: skip
_Packet = np.dtype([("origin", np.float32, (3, 4)), ("count", np.int32)], align=True)


def _records(n: int) -> Any:
    rows = np.zeros(n, _Record).view(np.recarray)
    rows.x, rows.id, rows.lit = np.arange(n) + 0.5, np.arange(n) + 7, np.arange(n) % 2 == 0
    rows.near = np.arange(3 * n).reshape(n, 3)
    rows.turn = np.arange(4 * n).reshape(n, 2, 2)
    return rows


@kernel
def _read_records(rows):
    total = 0.0
    for k in range(len(rows)):
        row = rows[k]
        total += row.x * row.id + row.near[k] * 3 + row.turn[1, 0] + len(row.near)
        if row.lit:
            total += 1000
    return total, rows[-1].id, rows[1:][0].x, rows[0].turn.shape


@kernel
def _change_records(rows):
    for k in range(len(rows)):
        rows[k].x = k * 2.5
        rows[k].id = rows[k].id + 1
        rows[k].lit = k > 0
        rows[k].near[1] += 4
        rows[k].turn[0] = -1
        rows[k].turn[:, 1] = k
        rows[k].near[:] = rows[0].near


def test_fields_of_records_are_read() -> None:
    assert_as_in_python(_read_records, _records(3))
    assert_as_in_python(_read_records, _records(6)[::2])


def test_fields_of_records_are_written() -> None:
    here, there = _records(3), _records(3)
    _change_records(here)
    _change_records.source.function(there)
    assert here.tobytes() == there.tobytes()


@kernel
def _local_records(n):
    packets = np.zeros(2, _Packet)
    for k in range(n):
        packets[1].origin[2, k] = k
        packets[1].count = packets[1].count + 1
    return packets[1].origin[2, n - 1] + packets[0].origin[0, 0], packets[1].count


def test_records_are_made_in_a_kernel() -> None:
    assert _local_records(4) == (3.0, 4)


def test_records_of_another_type_are_another_kind_of_argument() -> None:
    other = np.dtype([("id", np.uint32), ("x", np.float64)], align=True)
    rows = np.zeros(2, other).view(np.recarray)
    rows.x = 4.5
    assert _first_x(_records(2)) == 0.5
    assert _first_x(rows) == 4.5
    assert _first_x(_records(2)) == 0.5
    assert len(_first_x.signatures) == 2


@kernel
def _first_x(rows):
    return rows[0].x


def test_records_may_lie_without_gaps() -> None:
    packed = np.dtype([("id", np.int8), ("x", np.float64), ("near", np.float32, (3,))])
    rows = np.zeros(20, packed).view(np.recarray)
    rows.x, rows.near = np.arange(20), np.arange(60).reshape(20, 3)
    assert_as_in_python(_summed_records, rows)
    assert_as_in_python(_summed_records, rows[1::3])


@kernel
def _summed_records(rows):
    total = 0.0
    for k in range(len(rows)):
        total += rows[k].x + rows[k].near[0] * rows[k].near[2]
    return total


@kernel
def _no_such_field(rows):
    return rows[0].y


def test_a_field_that_is_not_there_is_told() -> None:
    line = _no_such_field.source.function.__code__.co_firstlineno + 2
    with pytest.raises(TypeError) as error:
        _no_such_field(_records(1))
    assert str(error.value) == f"kernel {__file__}:{line}:5: there is no 'y' of this"


def test_an_array_that_there_is_no_memory_for_ends_the_process_in_words(tmp_path: Path) -> None:
    (tmp_path / "large.py").write_text(
        "import numpy as np\n"
        "from gazelle.kernels import kernel\n"
        "@kernel\n"
        "def first(count):\n"
        "    row = np.ones(count)\n"
        "    return row[0]\n",
        encoding="utf-8",
    )
    run = subprocess.run(
        [sys.executable, "-c", "from large import first; first(-1)"],
        check=False, cwd=tmp_path, capture_output=True, text=True,
        env={**os.environ, "GAZELLE_KERNEL_CACHE": str(tmp_path / "kept")},
    )  # fmt: skip
    assert run.returncode != 0
    assert run.stderr.startswith("Gazelle: no room for a kernel's array")
