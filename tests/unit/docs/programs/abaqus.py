"""A stand-in for ``abaqus job=JOB input=FILE datacheck interactive``.

As Abaqus does, it writes the faults of the deck to ``JOB.dat`` and ends with exit code 1 if there
are any: keywords that the reader of the tests does not know or finds in the wrong place, and what
the deck uses without defining it. It solves nothing.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "decks"))

from abaqus_deck import read_deck
from abaqus_references import undefined


def faults(file: Path) -> list[str]:
    try:
        return undefined(read_deck(file.read_text("utf-8")))
    except (AssertionError, KeyError, ValueError) as error:
        return [f"{type(error).__name__}: {error}"]


def main() -> int:
    words = sys.argv[1:]
    options = dict(word.split("=", 1) for word in words if "=" in word)
    flags = {word for word in words if "=" not in word}
    if set(options) != {"job", "input"} or flags != {"datacheck", "interactive"}:
        print(f"Abaqus Error: {words} is not a data check", file=sys.stderr)
        return 2
    found = faults(Path(options["input"]))
    errors = "".join(f" ***ERROR: {fault}\n" for fault in found)
    Path(f"{options['job']}.dat").write_text(errors, encoding="utf-8")
    if found:
        print("Abaqus Error: Analysis Input File Processor exited with an error.")
        return 1
    print(f"Abaqus JOB {options['job']} COMPLETED")
    return 0


if __name__ == "__main__":
    sys.exit(main())
