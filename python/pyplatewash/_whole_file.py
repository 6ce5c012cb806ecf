"""A scenario's file, written whole or not at all."""

from __future__ import annotations

import os
import secrets
from pathlib import Path
from typing import Any

from ._errors import InputTypeError, ScenarioAccessError, ScenarioNotFoundError


def save_text(path: Any, text: str) -> None:
    """Writes a text beside its place and renames it; a link stays one, and a file that stands there gives it its rights.

    Raises ScenarioAccessError, a FileError.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise InputTypeError(f"path: a path is needed; found a value of type {type(path).__name__}", argument="path")
    try:
        _replace(Path(path).resolve(), text)
    except (OSError, ValueError) as error:
        # A name with a zero in it is a ValueError.
        number, words = (error.errno, error.strerror) if isinstance(error, OSError) else (None, None)
        message = f"{os.fspath(path)}: cannot be written: {words or error}"
        kind = ScenarioNotFoundError if isinstance(error, FileNotFoundError) else ScenarioAccessError
        raise kind(message, filename=os.fspath(path), errno=number, strerror=message) from error


def _replace(place: Path, text: str) -> None:
    staged = place.parent / f".platewash-{secrets.token_hex(8)}"
    rights = place.stat().st_mode & 0o7777 if place.exists() else None
    handle = os.open(staged, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(text.encode())
            file.flush()
            os.fsync(file.fileno())
        if rights is not None:
            os.chmod(staged, rights)
        os.replace(staged, place)
    except BaseException:
        staged.unlink(missing_ok=True)
        raise
