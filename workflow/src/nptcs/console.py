"""What a script says when its input is at fault."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from nptcs.errors import InputError


@contextmanager
def clear_errors(log: str | Path) -> Iterator[None]:
    """Write an `InputError` to the log as one message without a traceback, and exit with 1.

    Any other exception is a fault of the program and keeps its traceback.
    """
    path = Path(log)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("", encoding="utf-8")
    try:
        yield
    except InputError as error:
        path.write_text(f"{error}\n", encoding="utf-8")
        sys.exit(1)
