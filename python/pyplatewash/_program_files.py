"""The files of a robot program, all of them written or none."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

from ._errors import ProgramFileError, ProgramNotFoundError


def save(folder: str | os.PathLike[str], files: dict[str, str]) -> None:
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
            _write(beside, text)
        for beside, at in staged:
            os.replace(beside, at)
    except (OSError, ValueError) as error:
        # A name with a zero in it is a ValueError.
        number, words = (error.errno, error.strerror) if isinstance(error, OSError) else (None, None)
        message = f"{at}: cannot be written: {words or error}"
        kind = ProgramNotFoundError if isinstance(error, FileNotFoundError) else ProgramFileError
        raise kind(message, filename=str(at), errno=number, strerror=message) from error
    finally:
        for beside, _ in staged:
            beside.unlink(missing_ok=True)


def _write(file: Path, text: str) -> None:
    handle = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666)
    with os.fdopen(handle, "wb") as out:
        out.write(text.encode())
        out.flush()
        os.fsync(out.fileno())
