"""Files written completely or not at all, and files identified by their content."""

from __future__ import annotations

import hashlib
import json
import os
import socket
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

import psutil
from pydantic import BaseModel, ValidationError

from nptcs.errors import InputError
from nptcs.seal import BrokenSealError, open_object, sealed_object

Model = TypeVar("Model", bound=BaseModel)


@contextmanager
def atomic_path(path: str | Path) -> Iterator[Path]:
    """Give a temporary name next to `path`; rename it to `path` when the block succeeds.

    A reader sees the old file or the new one, never half a file, even after ``kill -9``.

    Parameters
    ----------
    path : str or Path
        Where the finished file goes; its folder is created.

    Yields
    ------
    Path
        The name to write to, with the same suffix.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     target = Path(folder) / "table.csv"
    ...     with atomic_path(target) as temporary:
    ...         _ = temporary.write_text("a,b")
    ...         print(target.exists())
    ...     print(target.exists())
    False
    True
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=_own_prefix(), suffix=path.suffix)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        with temporary.open("rb+") as stream:
            os.fsync(stream.fileno())
        # mkstemp makes files private; results are to be as readable as any other file
        umask = os.umask(0)
        os.umask(umask)
        temporary.chmod(0o666 & ~umask)
        temporary.replace(path)
    except OSError as error:
        if error.filename in (None, name):  # the user knows the file by its own name
            error.filename = str(path)
        raise
    finally:
        temporary.unlink(missing_ok=True)


UNFINISHED = ".nptcs-"
"""Start of the name of a file that is being written."""


def _own_prefix() -> str:
    """Return the start of a name, which says which process writes the file."""
    return f"{UNFINISHED}{socket.gethostname()}-{os.getpid()}-"


def remove_unfinished(folder: str | Path) -> list[Path]:
    """Remove the files that processes of this machine were writing when they were killed.

    Parameters
    ----------
    folder : str or Path
        Searched with all folders in it.

    Returns
    -------
    list of Path
        What was removed.
    """
    ours = f"{UNFINISHED}{socket.gethostname()}-"
    removed = []
    for path in sorted(Path(folder).rglob(f"{UNFINISHED}*")):
        pid, _, _ = path.name.removeprefix(ours).partition("-")
        if path.name.startswith(ours) and pid.isdecimal() and not psutil.pid_exists(int(pid)):
            path.unlink(missing_ok=True)
            removed.append(path)
    return removed


def write_text(path: str | Path, text: str) -> None:
    """Write `text` to `path` as UTF-8, atomically."""
    with atomic_path(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


REWRITE = "delete this file and run snakemake again; the run writes a new one"
"""Remedy for a file of ours that is damaged: Snakemake does not look into existing files."""


def write_model(path: str | Path, record: BaseModel) -> None:
    """Write one record or one card as JSON with a checksum, atomically (`nptcs.seal`)."""
    content = json.loads(record.model_dump_json())
    write_text(path, sealed_object(content, type(record).__name__))


def read_model(path: str | Path, model: type[Model], by_hand: bool = False) -> Model:
    """Read a JSON file that contains one record or one card.

    Parameters
    ----------
    path : str or Path
        Written by `write_model`.
    model : type of BaseModel
        What the file must contain.
    by_hand : bool
        Whether a file without a checksum, as a user may write it, is accepted.

    Raises
    ------
    InputError
        For a file that is missing, was edited or damaged, or does not contain such a record.
    """
    kind = model.__name__
    try:
        return model.model_validate(open_object(read_stored(path, kind), kind, by_hand))
    except (BrokenSealError, ValidationError) as error:
        reason = " ".join(str(error).splitlines()[:3])
        raise InputError(f"this file is not a valid {kind}: {reason}", REWRITE, path) from None


def write_sealed(path: str | Path, content: Mapping[str, Any], kind: str) -> None:
    """Write plain values as JSON with a checksum, atomically: for whatever is not a pydantic model.

    Parameters
    ----------
    path : str or Path
    content : mapping
        Plain values; numbers must be finite.
    kind : str
        A key of `nptcs.seal.FORMATS`; a new kind of file is added there.
    """
    write_text(path, sealed_object(content, kind))


def read_sealed(path: str | Path, kind: str) -> dict[str, Any]:
    """Read what `write_sealed` wrote.

    Raises
    ------
    InputError
        For a file that is missing, was edited or damaged, or is of another kind or version.
    """
    try:
        return open_object(read_stored(path, kind), kind)
    except BrokenSealError as error:
        raise InputError(f"this file is not a valid {kind}: {error}", REWRITE, path) from None


def read_stored(path: str | Path, kind: str) -> str:
    """Read the text of a file that this pipeline wrote.

    Raises
    ------
    InputError
        For a file that is missing or is not UTF-8.
    """
    if not Path(path).is_file():
        remedy = "run snakemake again; the run writes this file"
        raise InputError(f"this {kind} does not exist", remedy, file=path)
    try:
        return Path(path).read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise InputError(f"this file is not a valid {kind}: {error}", REWRITE, path) from None


def files_below(folder: str | Path) -> list[Path]:
    """List the files of a folder and its subfolders, sorted; none if it does not exist."""
    return sorted(path for path in Path(folder).rglob("*") if path.is_file())


def sha256_of_file(path: str | Path) -> str:
    """SHA-256 of a file's content, as 64 hexadecimal digits."""
    with Path(path).open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def sha256_of_text(text: str) -> str:
    """SHA-256 of a text's UTF-8 bytes, as 64 hexadecimal digits.

    Examples
    --------
    >>> sha256_of_text("nptcs")[:12]
    'dc31111c47cb'
    """
    return hashlib.sha256(text.encode("utf-8")).hexdigest()
