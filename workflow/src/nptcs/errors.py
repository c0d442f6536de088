"""The one error that bad input raises, with the place where it was found."""

from __future__ import annotations

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
        """Survive the way back from a worker process with every field."""
        fields = (self.message, self.remedy, self.file, self.line, self.column)
        return (type(self), (*fields, self.specimen, self.value))
