"""What a script says when its input is at fault."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from nptcs.errors import InputError, explained
from nptcs.processes.stops import end_with_run


@contextmanager
def clear_errors(log: str | Path) -> Iterator[None]:
    """Write an `InputError` to the log as one message without a traceback, and exit with 1.

    The same goes for an error of the operating system with a known remedy (disk full, permission).
    Any other exception is a fault of the program and keeps its traceback. The script ends when its
    run does.
    """
    end_with_run()
    path = Path(log)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("", encoding="utf-8")
    try:
        yield
    except InputError as error:
        _say(path, str(error))
    except OSError as error:
        known = explained(error)
        if known is None:
            raise
        _say(path, str(known))


def _say(log: Path, text: str) -> None:
    """Write a message to log and screen, and exit; it may be the log that cannot be written."""
    with suppress(OSError):
        log.write_text(f"{text}\n", encoding="utf-8")
    print(text, file=sys.stderr)
    sys.exit(1)
