"""Snakemake's logger plugin: what a person sees of a run."""

from __future__ import annotations

import logging
import os
import shutil
import sys
import threading
import time
from typing import Any, TextIO

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from nptcs.monitor.run import Run
from nptcs.monitor.words import (
    SAID,
    closing_lines,
    error_message,
    page_lines,
    status_line,
    unrecorded_lines,
)
from nptcs.processes.scratch import hold_temporary_files

REFRESH_S = 0.5
CLEAR = "\r\x1b[K"
"""Return to the start of the line, and clear it."""


class RunHandler(LogHandlerBase):
    """Shows a run as one line that refreshes on a terminal, each failure, and the end.

    If the output is not a terminal there is no such line. With ``--dry-run``, ``--verbose`` or
    ``--printshellcmds`` Snakemake's own messages are shown instead.
    """

    def __post_init__(self) -> None:
        """Choose between our own lines and Snakemake's.

        No other code of ours runs earlier in Snakemake's process, and Snakemake has no temporary
        folder yet.
        """
        hold_temporary_files()
        settings = self.common_settings
        self.stream: TextIO = sys.stdout if settings.stdout else sys.stderr
        self.run = Run()
        self.began = time.monotonic()
        self.line_shown = False
        self.idle = False
        self.ended = threading.Event()
        self.plain: logging.Handler | None = None
        if settings.dryrun or settings.verbose or settings.printshellcmds:
            self.plain = _snakemakes_own(settings, self.stream)
        elif self.stream.isatty() and os.environ.get("TERM") != "dumb":
            threading.Thread(target=self._refresh, daemon=True).start()

    @property
    def writes_to_stream(self) -> bool:
        """Tell Snakemake that it need not write to the screen itself."""
        return True

    @property
    def writes_to_file(self) -> bool:
        """Tell Snakemake to keep its own log file."""
        return False

    @property
    def has_filter(self) -> bool:
        """Tell Snakemake that all events are wanted."""
        return True

    @property
    def has_formatter(self) -> bool:
        """Tell Snakemake that events are put into words here."""
        return True

    @property
    def needs_rulegraph(self) -> bool:
        """Tell Snakemake that its graph of rules is not needed."""
        return False

    def emit(self, record: logging.LogRecord) -> None:
        """Note an event of Snakemake, or show a message."""
        if self.plain is not None:
            self.plain.handle(record)
            return
        event = getattr(record, "event", None)
        facts: dict[str, Any] = record.__dict__
        if event == LogEvent.RUN_INFO:
            self.run.total = max(self.run.total, int(facts["stats"].get("total", 0)))
        elif event == LogEvent.JOB_INFO:
            self.run.job_info(facts)
        elif event == LogEvent.PROGRESS:
            self.run.done, self.run.total = int(facts["done"]), int(facts["total"])
        elif event in (LogEvent.JOB_ERROR, LogEvent.GROUP_ERROR) and "jobid" in facts:
            job = self.run.job_failed(facts)
            self._say(f"failed: {job}" + (f" (log: {job.log})" if job.log else ""))
        elif event in (None, LogEvent.ERROR):
            self._message(record)

    def _message(self, record: logging.LogRecord) -> None:
        """Show a message that is not an event, if a person needs it."""
        text = record.getMessage()
        if record.levelno >= logging.WARNING:
            text = error_message(text)
            if text:
                self._say(text)
        elif record.levelno == logging.INFO and SAID.match(text):
            self.idle = text.startswith("Nothing to be done")
            self._say(text)

    def _say(self, text: str) -> None:
        self._write(f"{CLEAR if self.line_shown else ''}{text}\n", line=False)

    def _write(self, text: str, line: bool) -> None:
        """Write to the screen; `line` tells whether the line that refreshes is left there."""
        self.acquire()
        try:
            self.stream.write(text)
            self.stream.flush()
            self.line_shown = line
        finally:
            self.release()

    def _refresh(self) -> None:
        """Show the line again and again until the run ends."""
        while not self.ended.wait(REFRESH_S):
            if not self.run.total:
                continue
            self.run.look()
            width = shutil.get_terminal_size().columns
            self._write(CLEAR + status_line(self.run, width), line=True)

    def close(self) -> None:
        """Say at the end what was done, what failed, and where the report is."""
        already = self.ended.is_set()
        self.ended.set()
        if not already and self.plain is None and self.run.total and self.run.jobs:
            self.run.look()
            lines = closing_lines(self.run, time.monotonic() - self.began, _newest_log())
            self._say("\n".join(lines))
        elif not already and self.idle:
            self._say("\n".join([*page_lines(), *unrecorded_lines()]))
        super().close()


def _newest_log() -> str:
    """Name Snakemake's log of this run, which has all its messages."""
    folder = os.path.join(".snakemake", "log")  # noqa: PTH118 - a name to print
    try:
        names = sorted(os.listdir(folder))  # noqa: PTH208 - a name to print
    except OSError:
        return ""
    return f"{folder}/{names[-1]}" if names else ""


def _snakemakes_own(settings: Any, stream: TextIO) -> logging.Handler:
    """Return the handler that Snakemake has without this plugin."""
    from snakemake.logging import ColorizingTextHandler, DefaultFilter, DefaultFormatter

    handler = ColorizingTextHandler(nocolor=settings.nocolor, stream=stream)
    handler.addFilter(
        DefaultFilter(
            settings.quiet,
            settings.debug_dag,
            settings.verbose,
            settings.dryrun,
            settings.printshellcmds,
        )
    )
    handler.setFormatter(DefaultFormatter(settings.quiet, settings.show_failed_logs))
    return handler
