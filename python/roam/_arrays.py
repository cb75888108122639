"""Checks and conversions of arguments. Each message names the argument, what it is and what it must be."""

import os
from typing import Any, Callable, Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._library import free_memory
from ._structs import Vec3

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]
Progress = Optional[Callable[[float], object]]
Floats = NDArray[np.float64]


_LITTLE = 64 << 20  # bytes that need no question


def check_memory(wanted: int, name: str) -> None:
    """Raises MemoryError if so many bytes are not free: the system would end a process later."""
    if wanted < _LITTLE:
        return
    free = free_memory()
    if free is not None and wanted > free:
        raise MemoryError(f"{name} would take {wanted / 1e9:.1f} GB, and {free / 1e9:.1f} GB are free; "
                          "pass less at a time")


def _converted(value: Any, name: str, wanted: str) -> NDArray[Any]:
    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"{name} must be {wanted}, without a mask; pass {name}.compressed() or {name}.filled(...)")
    try:
        return np.asarray(value)
    except ValueError as error:
        raise ValueError(f"{name} must be {wanted}; its parts differ in length") from error


def _array(value: Any, name: str, kinds: str, wanted: str) -> NDArray[Any]:
    array = _converted(value, name, wanted)
    if array.dtype.kind not in kinds:
        kind = "integers" if kinds == "iu" else "numbers"
        raise TypeError(f"{name} must be {wanted}, of {kind}; it has the type {array.dtype}, shape {array.shape}")
    return array


def _as_float64(array: NDArray[Any], name: str) -> Floats:
    if array.dtype == np.float64:
        return array
    check_memory(8 * array.size, name)
    return array.astype(np.float64)


def positions(value: ArrayLike, name: str) -> Floats:
    """float64 of shape (N, 3) or (3,)."""
    wanted = "an array of shape (N, 3) or (3,)"
    array = _array(value, name, "fiu", wanted)
    if array.ndim not in (1, 2) or array.shape[-1] != 3:
        raise ValueError(f"{name} must be {wanted}; it has the shape {array.shape}")
    array = _as_float64(array, name)
    if array.strides[-1] != array.itemsize:  # x, y and z of a row must lie side by side
        check_memory(array.nbytes, name)
        array = np.ascontiguousarray(array)
    return array


def position(value: ArrayLike, name: str) -> Floats:
    """float64 of shape (3,)."""
    wanted = "an array of shape (3,)"
    array = _array(value, name, "fiu", wanted)
    if array.shape != (3,):
        raise ValueError(f"{name} must be {wanted}; it has the shape {array.shape}")
    return _as_float64(array, name)


def lengths(value: ArrayLike, name: str) -> Floats:
    """float64 of shape () or (N,)."""
    wanted = "one number or an array of shape (N,)"
    array = _array(value, name, "fiu", wanted)
    if array.ndim > 1:
        raise ValueError(f"{name} must be {wanted}; it has the shape {array.shape}")
    return _as_float64(array, name)


def number(value: Any, name: str) -> float:
    if isinstance(value, (str, bytes)):
        raise TypeError(f"{name} must be a number; it is {value!r}")
    try:
        return float(value)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{name} must be a number; it is a {type(value).__name__}") from error
    except OverflowError as error:
        raise ValueError(f"{name} must be a number below 1.8e308; it is larger") from error


def positive(value: Any, name: str) -> float:
    result = number(value, name)
    if not result > 0.0:
        raise ValueError(f"{name} must be above 0; it is {value}")
    return result


def whole(value: Any, name: str, least: int = 0, most: int = 2**31 - 1) -> int:
    try:
        result = value.__index__()
    except AttributeError:
        raise TypeError(f"{name} must be a whole number; it is a {type(value).__name__}") from None
    if not least <= result <= most:
        raise ValueError(f"{name} must be from {least} to {most}; it is {result}")
    return result


def mesh(name: str, vertices: ArrayLike, triangles: ArrayLike) -> Tuple[str, Floats, NDArray[np.uint32]]:
    """Packed float64 of shape (V, 3) and uint32 of shape (T, 3)."""
    if not isinstance(name, str):
        raise TypeError(f"the name of a mesh must be a str; it is a {type(name).__name__}")
    if "\0" in name:
        raise ValueError(f"the name {name!r} of a mesh has a null byte")
    corners = _array(vertices, "vertices", "fiu", "an array of shape (V, 3)")
    if corners.size == 0:
        corners = np.empty((0, 3))
    if corners.ndim != 2 or corners.shape[1] != 3:
        raise ValueError(f"vertices must be an array of shape (V, 3); it has the shape {corners.shape}")
    wanted = "an array of shape (T, 3)"
    indices = _converted(triangles, "triangles", wanted)
    if indices.size == 0:
        indices = np.empty((0, 3), np.uint32)
    indices = _array(indices, "triangles", "iu", wanted)
    if indices.ndim != 2 or indices.shape[1] != 3:
        raise ValueError(f"triangles must be an array of shape (T, 3); it has the shape {indices.shape}")
    # As packed copies here, and for a world and its construction.
    check_memory(48 * corners.shape[0] + 80 * indices.shape[0], "the world")
    if len(indices) > 0:
        least, most = int(indices.min()), int(indices.max())
        if least < 0 or most >= len(corners):
            wrong = least if least < 0 else most
            row = int(np.argmax((indices == wrong).any(axis=1)))
            raise ValueError(f"triangle {row} has the index {wrong}, and there are {len(corners)} vertices")
    return name, np.ascontiguousarray(corners, np.float64), np.ascontiguousarray(indices, np.uint32)


def meshes(value: Iterable[Tuple[str, ArrayLike, ArrayLike]]) -> List[Tuple[str, Floats, NDArray[np.uint32]]]:
    result = []
    for item in value:
        if not isinstance(item, Sequence) or len(item) != 3:
            raise TypeError("each mesh must be a tuple (name, vertices, triangles)")
        result.append(mesh(*item))
    return result


def objects(value: Iterable[int], name: str) -> List[int]:
    if not isinstance(value, Iterable):
        raise TypeError(f"{name} must be a list of numbers of objects; it is a {type(value).__name__}")
    return sorted({whole(item, name, 0, 2**32 - 1) for item in value})


def vec3(array: Floats) -> Vec3:
    return Vec3(*(float(x) for x in array))


def array3(vec: Vec3) -> Floats:
    return np.array((vec.x, vec.y, vec.z))


def path_text(path: Path) -> bytes:
    text = os.fsencode(path)
    if b"\0" in text:
        raise ValueError("the path has a null byte")
    return text


def memory_bytes(value: Union[int, str], name: str = "memory") -> int:
    """Bytes of 64 << 20 or of "64M"; K, M and G are powers of 1024."""
    if not isinstance(value, str):
        return whole(value, name, 1, 2**63)
    units = {"K": 1 << 10, "M": 1 << 20, "G": 1 << 30}
    digits, unit = (value[:-1], units[value[-1]]) if value[-1:] in units else (value, 1)
    if not (digits.isascii() and digits.isdigit()):
        raise ValueError(f'{name} must be bytes, or a text such as "64M"; it is {value!r}')
    return whole(int(digits) * unit, name, 1, 2**63)


def one_of(value: str, names: Sequence[str], name: str) -> int:
    if value not in names:
        raise ValueError(f"{name} must be one of {', '.join(names)}; it is {value!r}")
    return list(names).index(value)
