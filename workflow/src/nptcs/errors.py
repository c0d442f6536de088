"""The one error that bad input raises, with the place where it was found."""

from __future__ import annotations

import errno
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path


@dataclass
class InputError(ValueError):
    """Input that cannot be used, and what the user can do about it.

    Parameters
    ----------
    message : str
        What is wrong, in the field's terms.
    remedy : str
        What to do about it.
    file : str or Path, optional
        File in which it was found.
    line : int, optional
        Line of that file, counted from 1.
    column : str, optional
        Column or key.
    specimen : str, optional
        Specimen id or case id.
    value : object, optional
        The offending value, quoted in the text.

    Examples
    --------
    >>> print(InputError("not a number", "correct it", "a.csv", 12, "force", value="x"))
    a.csv:12, column 'force': not a number (value: 'x'). Remedy: correct it
    """

    message: str
    remedy: str = ""
    file: str | Path | None = None
    line: int | None = None
    column: str | None = None
    specimen: str | None = None
    value: object = None

    def __str__(self) -> str:
        place = []
        if self.file is not None:
            place.append(f"{self.file}" + (f":{self.line}" if self.line is not None else ""))
        elif self.line is not None:
            place.append(f"line {self.line}")
        if self.specimen is not None:
            place.append(f"specimen {self.specimen}")
        if self.column is not None:
            place.append(f"column '{self.column}'")
        text = ", ".join(place) + (": " if place else "") + self.message
        if self.value is not None:
            text += f" (value: {self.value!r})"
        if self.remedy:
            text += f". Remedy: {self.remedy}"
        return text

    def __reduce__(self) -> tuple[type, tuple[object, ...]]:
        """Keep every field when the error is pickled on its way back from a worker process."""
        fields = (self.message, self.remedy, self.file, self.line, self.column)
        return (type(self), (*fields, self.specimen, self.value))


_GO_ON = "then type the same command again; no half-written file is left"
REMEDIES: Mapping[int, tuple[str, str]] = {
    errno.ENOSPC: ("the disk is full", f"make room on it, {_GO_ON}"),
    errno.EDQUOT: ("your quota on this disk is used up", f"make room on it, {_GO_ON}"),
    errno.EFBIG: ("a file is larger than this system allows", f"raise the limit, {_GO_ON}"),
    errno.EROFS: ("this disk is read-only", f"choose a folder that can be written to, {_GO_ON}"),
    errno.EACCES: ("you have no permission for this", f"correct the permissions, {_GO_ON}"),
    errno.EPERM: ("you have no permission for this", f"correct the permissions, {_GO_ON}"),
    errno.EMFILE: ("too many files are open", f"raise the limit (ulimit -n), {_GO_ON}"),
    errno.ENFILE: ("too many files are open", f"end other programs, {_GO_ON}"),
    errno.EIO: ("the disk reports an error", f"check the disk, {_GO_ON}"),
}
"""What went wrong and what to do, by the number of the system's error."""

SHORTAGES = frozenset(
    {errno.ENOSPC, errno.EDQUOT, errno.EMFILE, errno.ENFILE, errno.ENOMEM, errno.EIO, errno.EAGAIN}
)
"""Errors of a machine that lacks something for the moment: the same work may succeed later."""


def explained(error: OSError) -> InputError | None:
    """Turn an error of the operating system into words and a remedy; None for any other.

    Examples
    --------
    >>> print(explained(OSError(errno.ENOSPC, "No space left on device", "results/a.csv")))
    results/a.csv: the disk is full. Remedy: make room on it, then type the same command again; no \
half-written file is left
    """
    if error.errno is None or error.errno not in REMEDIES:
        return None
    message, remedy = REMEDIES[error.errno]
    return InputError(message, remedy, error.filename)
