"""Faults of a study that are known before anything is solved."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from nptcs.campaign.answers import (
    Asked,
    check_calibration_cases,
    check_loads,
    check_rounding,
    check_tables,
    check_terms,
)
from nptcs.config.root import Config
from nptcs.config.studies.study import Study
from nptcs.errors import InputError
from nptcs.solvers.registry import check_study
from nptcs.tables.laboratory.specimens import Specimen


def study_faults(config: Config) -> list[InputError]:
    """Find what would make cases fail, or their surface impossible, in all studies.

    Parameters
    ----------
    config : Config
        Checked against its schema.

    Returns
    -------
    list of InputError
        Each with the key at fault and a remedy: faults of `check_study`, more cases than
        ``campaign.most_cases``, more batches than cases, terms that the levels cannot tell apart,
        and what `nptcs.campaign.answers` finds for each solver.
    """
    return [fault for study in config.studies for fault in _faults(study, config)]


def refuse_faults(faults: Sequence[InputError]) -> None:
    """Raise one error that names all faults, one per line; no faults, no error.

    Raises
    ------
    InputError
        If there is a fault.
    """
    if len(faults) == 1:
        raise faults[0]
    if faults:
        raise InputError("\n".join([f"{len(faults)} faults were found:", *map(str, faults)]))


def _faults(study: Study, config: Config) -> Iterator[InputError]:
    options = config.solver_options(study)
    try:
        check_study(study, options)
    except InputError as error:
        yield error
        return
    cases = study.number_of_cases()
    if cases > config.campaign.most_cases:
        yield InputError(
            f"study {study.name} has {cases:,} cases (solvers: {', '.join(study.solvers)}); a run "
            f"solves at most {config.campaign.most_cases:,} cases of a study unless told otherwise",
            "use fewer levels, start the run with 'nptcs run --yes', or raise the key "
            "campaign.most_cases",
            column=f"studies.{study.name}.factors",
        )
        return
    if config.campaign.batches > cases:
        yield InputError(
            f"study {study.name} has only {cases:,} cases: some batches would be empty",
            "divide it into fewer batches",
            column="campaign.batches",
            value=config.campaign.batches,
        )
    try:
        asked = Asked.of(study, options, config.tyre)
    except InputError as error:
        yield error
        return
    for check in (check_terms, check_loads, check_tables, check_rounding, check_calibration_cases):
        yield from check(asked)


def name_faults(specimens: Sequence[Specimen], config: Config) -> list[InputError]:
    """Find names that cannot be used as file names, or that two things would share."""
    names = {
        "specimen": sorted({specimen.specimen for specimen in specimens}),
        "material": sorted({specimen.material for specimen in specimens}),
        "study": [study.name for study in config.studies],
    }
    faults = _capitals("material", names["material"])
    faults += [_kept("study", name) for name in names["study"] if name in KEPT_STUDIES]
    faults += [
        _kept(kind, name)
        for kind, used in names.items()
        for name in used
        if name.partition(".")[0].lower() in KEPT_BY_WINDOWS
    ]
    for kind, used in names.items():
        faults += [
            _unfit(kind, name) for name in used if len(name) > LONGEST_NAME or repeats_a_piece(name)
        ]
    return faults


KEPT_STUDIES = frozenset({"records", "bulk", "models", "sobol"})
"""Folders of results next to those of the studies."""

KEPT_BY_WINDOWS = frozenset({"con", "prn", "aux", "nul"}) | {
    f"{port}{number}" for port in ("com", "lpt") for number in range(1, 10)
}
"""Names that no file can have on Windows, whatever follows them after a dot."""


def _kept(kind: str, name: str) -> InputError:
    return InputError("this name is reserved", "choose another", column=kind, value=name)


def _capitals(kind: str, names: Sequence[str]) -> list[InputError]:
    """Find names that differ only in capital letters; for specimens the sheet's check does so."""
    folded = [name.casefold() for name in names]
    same = [name for name in names if folded.count(name.casefold()) > 1]
    if not same:
        return []
    return [
        InputError(
            "these names differ only in capital letters, which Windows and macOS ignore",
            "spell them the same way, or choose different names",
            column=kind,
            value=", ".join(same),
        )
    ]


def _unfit(kind: str, name: str) -> InputError:
    return InputError(
        f"this name is too long for a file ({len(name)} characters, at most {LONGEST_NAME}), or a "
        f"piece of it is repeated more than {MOST_REPEATS} times in a row",
        "shorten it",
        column=kind,
        value=name if len(name) < 40 else f"{name[:39]}…",
    )


LONGEST_NAME = 100
"""Characters of a name; file systems allow 255 for a whole file name, of which it is a part."""

MOST_REPEATS = 15
"""Times that a piece of a name may be repeated in a row; Snakemake refuses 20 as endless."""


def repeats_a_piece(name: str) -> bool:
    """Tell whether a piece of a name is repeated in a row more often than `MOST_REPEATS`.

    Examples
    --------
    >>> repeats_a_piece("T0-" + "0" * 12), repeats_a_piece("T0-" + "01" * 16)
    (False, True)
    """
    longest = len(name) // (MOST_REPEATS + 1)
    return any(
        name[start : start + size] * (MOST_REPEATS + 1)
        == name[start : start + size * (MOST_REPEATS + 1)]
        for size in range(1, longest + 1)
        for start in range(len(name) - size * (MOST_REPEATS + 1) + 1)
    )
