"""What Abaqus says about a job: licence, warnings, errors, increments.

The exit code of Abaqus cannot be trusted, so its text files decide. The texts about licences are
those that Abaqus and FlexNet print while they queue for tokens or refuse them.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

QUEUED = re.compile(
    r"licen[cs]e request queued|total time in queue|waiting for (?:a |an )?(?:\w+ )?licen[cs]e",
    re.IGNORECASE,
)
GRANTED = re.compile(r"checked out|begin (?:analysis|abaqus)|run (?:pre|standard)", re.IGNORECASE)
DENIED = re.compile(
    r"error checking out abaqus licen[cs]e|insufficient licen[cs]es|licensing error"
    r"|time limit of in queue has been exceeded|licensed number of users already reached"
    r"|licen[cs]e server (?:machine|system)?.*(?:down|not respond|does not|cannot|unreachable)"
    r"|cannot connect to licen[cs]e server|unable to (?:check ?out|connect to|contact).*licen[cs]e"
    r"|(?:no|not enough) (?:\w+ )?(?:licen[cs]es?|tokens?) (?:is |are )?(?:available|left)"
    r"|licen[cs]e.*(?:has expired|not (?:available|granted))|checkout exceeds max",
    re.IGNORECASE,
)

CONTRADICTION = re.compile(r"ZERO PIVOT")
"""Constraints that contradict each other: forces and displacements may be meaningless."""

HARMLESS = re.compile(r"\bREQUEST|\bPRINTED\b|\bPREPRINT\b|OVERCONSTRAINT CHECKS")
"""About output and listings only, or about redundant constraints, which Abaqus applies once."""

FATAL = {
    "something is left out": re.compile(
        r"\b(?:IS|ARE|WAS|WERE|BE|BEEN|BEING) (?:IGNORED|DELETED|REMOVED|DISREGARDED)"
        r"|\bHAS NO EFFECT|\bNOT (?:BEEN )?APPLIED"
    ),
    "a word that Abaqus does not know": re.compile(
        r"UNKNOWN (?:KEYWORD|PARAMETER|OPTION|ELEMENT)|NOT RECOGNI[SZ]ED|AMBIGUOUS KEYWORD"
    ),
    "a value is not the deck's": re.compile(
        r"\b(?:HAS|HAVE) BEEN (?:CHANGED|RESET|REPLACED|OVERRIDDEN)"
        r"|\bWILL BE (?:CHANGED|RESET|REPLACED|OVERRIDDEN|ASSUMED)|\bDEFAULT\b.*\bASSUMED"
    ),
    "plates or wires are not embedded": re.compile(
        r"EMBED.*\b(?:NOT|NO|OUTSIDE|CANNOT|FAILED)\b|\b(?:NOT|NO|CANNOT)\b.*EMBED"
    ),
    "spokes are not tied": re.compile(
        r"\b(?:NOT|CANNOT|NEVER) (?:BE(?:EN)? )?TIED|\bUNTIED\b|POSITION TOLERANCE"
    ),
    "wires are left out": re.compile(r"REBAR.*\b(?:NOT|NO|CANNOT)\b"),
}
"""Warnings after which Abaqus solves a model other than the deck's. All others are kept as text."""

NOT_CONVERGED = re.compile(
    r"TOO MANY ATTEMPTS MADE FOR THIS INCREMENT|TOO MANY INCREMENTS"
    r"|TIME INCREMENT REQUIRED IS LESS THAN THE MINIMUM",
    re.IGNORECASE,
)
SHOWN = 5
"""Harmless warnings that a message quotes."""

COMPLETED = "THE ANALYSIS HAS COMPLETED SUCCESSFULLY"


@dataclass(frozen=True)
class Messages:
    """Warnings and errors of one job, each once, in the order of their first appearance."""

    fatal: tuple[str, ...]
    warnings: tuple[str, ...]
    errors: tuple[str, ...]

    def kept(self) -> str:
        """Return the first of the harmless warnings as text; an empty text if there are none."""
        if not self.warnings:
            return ""
        more = len(self.warnings) - SHOWN
        rest = f" | and {more} more" if more > 0 else ""
        return f"Abaqus warns: {' | '.join(self.warnings[:SHOWN])}{rest}"


def waits_for_licence(printed: str) -> bool:
    """Tell whether the last thing printed about a licence is that the job queues for it."""
    queued = [match.end() for match in QUEUED.finditer(printed)]
    granted = [match.end() for match in GRANTED.finditer(printed)]
    return bool(queued) and (not granted or queued[-1] > granted[-1])


def licence_denial(printed: str) -> str:
    """Return the lines that say that there was no licence, or an empty text."""
    lines = [line.strip() for line in printed.splitlines() if DENIED.search(line)]
    return " | ".join(dict.fromkeys(lines))


def read_messages(texts: Sequence[str], accepted: Sequence[str] = ()) -> Messages:
    """Collect warnings and errors from the text files of a job.

    Parameters
    ----------
    texts : sequence of str
        Contents of the .dat and .msg files.
    accepted : sequence of str
        Regular expressions of warnings that are not fatal although they look so.
    """
    found = [block for text in texts for block in _blocks(text)]
    warnings = dict.fromkeys(text for kind, text in found if kind == "WARNING")
    errors = dict.fromkeys(text for kind, text in found if kind == "ERROR")
    reasons = {text: reason(text, accepted) for text in warnings}
    return Messages(
        fatal=tuple(f"{why}: {text}" for text, why in reasons.items() if why),
        warnings=tuple(text for text, why in reasons.items() if not why),
        errors=tuple(errors),
    )


def reason(warning: str, accepted: Sequence[str] = ()) -> str:
    """Say why a warning is fatal; an empty text if it is not."""
    text = warning.upper()
    if any(re.search(pattern, warning, re.IGNORECASE) for pattern in accepted):
        return ""
    if CONTRADICTION.search(text):
        return "constraints contradict each other"
    if HARMLESS.search(text):
        return ""
    return next((why for why, pattern in FATAL.items() if pattern.search(text)), "")


def _blocks(text: str) -> list[tuple[str, str]]:
    """Find ``***WARNING:`` and ``***ERROR:`` with their continuation lines in a text."""
    pattern = r"^ *\*\*\*(WARNING|ERROR): *(.*(?:\n {6,}\S.*)*)"
    return [
        (match[1], " ".join(match[2].split())) for match in re.finditer(pattern, text, re.MULTILINE)
    ]
