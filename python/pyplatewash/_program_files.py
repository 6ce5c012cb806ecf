"""The files of a robot program, all of them written or none."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

from ._errors import ProgramFileError, ProgramNotFoundError
from ._whole_file import not_written, write_new


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
            write_new(beside, text)
        for beside, at in staged:
            os.replace(beside, at)
    except (OSError, ValueError) as error:
        raise not_written(str(at), error, ProgramNotFoundError, ProgramFileError) from error
    finally:
        for beside, _ in staged:
            beside.unlink(missing_ok=True)
