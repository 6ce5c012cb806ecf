"""Arrays of the document that pages show."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

_TYPES = {"f64": "<f8", "f32": "<f4", "u32": "<u4", "u16": "<u2", "u8": "u1"}


def array(numbers: Mapping[str, Any]) -> npt.NDArray[Any]:
    """An array of numbers, in the shape that it states."""
    name = next(name for name in _TYPES if name in numbers)
    return np.frombuffer(base64.b64decode(numbers[name]), _TYPES[name]).reshape(numbers["shape"])
