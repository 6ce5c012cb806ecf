"""Files, written whole or not at all; the files of a robot program, all of them written or none."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ._errors import FileError, InputTypeError, ProgramFileError, ProgramNotFoundError, ScenarioAccessError, ScenarioNotFoundError


def save_text(path: Any, text: str) -> None:
    """Writes a scenario beside its place and renames it; a link stays one, and a file that stands there gives it its rights.

    Raises ScenarioAccessError, a FileError.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise InputTypeError(f"path: a path is needed; found a value of type {type(path).__name__}", argument="path")
    try:
        _replace(Path(path).resolve(), text)
    except (OSError, ValueError) as error:
        raise not_written(os.fspath(path), error, ScenarioNotFoundError, ScenarioAccessError) from error


def not_written(place: str, error: OSError | ValueError, missing: type[FileError], otherwise: type[FileError]) -> FileError:
    """What to raise for a place that cannot be written: ``missing`` where something on the way there is not there."""
    # A name with a zero in it is a ValueError.
    number, words = (error.errno, error.strerror) if isinstance(error, OSError) else (None, None)
    message = f"{place}: cannot be written: {words or error}"
    kind = missing if isinstance(error, FileNotFoundError) else otherwise
    return kind(message, filename=place, errno=number, strerror=message)


def write_new(file: Path, text: str) -> None:
    """Writes a text to a file that is not there yet, to the disk."""
    handle = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666)
    with os.fdopen(handle, "wb") as out:
        out.write(text.encode())
        out.flush()
        os.fsync(out.fileno())


@contextmanager
def staged(place: Path, *, as_folder: bool = False) -> Iterator[Path]:
    """A path beside a place, of a new file or folder, which takes the place where all goes well, and else goes. A folder takes the place of
    none but an empty one."""
    beside = place.parent / f".platewash-{secrets.token_hex(8)}"
    try:
        if as_folder:
            beside.mkdir()
        yield beside
        for file in beside.iterdir() if as_folder else (beside,):
            with open(file, "rb+") as kept:
                os.fsync(kept.fileno())
        if as_folder and place.is_dir():
            place.rmdir()
        os.replace(beside, place)
    except BaseException:
        if as_folder:
            shutil.rmtree(beside, ignore_errors=True)
        else:
            beside.unlink(missing_ok=True)
        raise


def _replace(place: Path, text: str) -> None:
    staged = place.parent / f".platewash-{secrets.token_hex(8)}"
    rights = place.stat().st_mode & 0o7777 if place.exists() else None
    try:
        write_new(staged, text)
        if rights is not None:
            os.chmod(staged, rights)
        os.replace(staged, place)
    except BaseException:
        staged.unlink(missing_ok=True)
        raise


def save_program(folder: str | os.PathLike[str], files: dict[str, str]) -> None:
    """Writes each text beside its place, and renames them when all are there. The folder is made where it is missing, and no other.

    Raises ProgramFileError, a FileError; ProgramNotFoundError where the folder around it is missing.
    """
    at = place = Path(folder)
    staged: list[tuple[Path, Path]] = []
    try:
        place.mkdir(exist_ok=True)
        for name, text in files.items():
            at = place / name
            if at.is_dir():
                raise IsADirectoryError(None, "there is a folder of that name")
            beside = place / f".platewash-{secrets.token_hex(8)}"
            staged.append((beside, at))
            write_new(beside, text)
        for beside, at in staged:
            os.replace(beside, at)
    except (OSError, ValueError) as error:
        raise not_written(str(at), error, ProgramNotFoundError, ProgramFileError) from error
    finally:
        for beside, _ in staged:
            beside.unlink(missing_ok=True)
