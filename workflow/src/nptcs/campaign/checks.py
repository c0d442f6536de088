"""Faults of a study that are known before anything is solved."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from nptcs.config.root import Config
from nptcs.config.study import Factor, MeasuredRubber, Study
from nptcs.config.tyre import TyreGeometry
from nptcs.design import build_design
from nptcs.errors import InputError
from nptcs.solvers.contract import Solver, SolverOptions
from nptcs.solvers.registry import check_study, load, module_of, read_options
from nptcs.surface.fit import refuse_aliased
from nptcs.tables.specimens import Specimen
from nptcs.terms import parse


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
        a load at which a solver has no result.
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
            f"study {study.name} has {cases:,} cases by {len(study.solvers)} solvers; a run solves "
            f"at most {config.campaign.most_cases:,} of a study unless told otherwise",
            "use fewer levels, or raise the key campaign.most_cases",
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
    for check in (_check_terms, _check_loads):
        try:
            check(study, options, config.tyre)
        except InputError as error:
            yield error


def solvers_of(
    study: Study, options: Mapping[str, Mapping[str, Any]]
) -> list[tuple[Solver, SolverOptions]]:
    """Return the solvers of a study with their checked options."""
    solvers = [(load(module_of(name, options[name])), options[name]) for name in study.solvers]
    return [(solver, read_options(solver, given)) for solver, given in solvers]


def _check_terms(study: Study, options: Mapping[str, Any], tyre: TyreGeometry) -> None:
    """Refuse terms that this study cannot estimate, even if every case is solved."""
    if not study.terms:
        return
    names = [factor.name for factor in study.factors]
    polynomial = parse(study.terms, names)
    numbered = study.model_copy(
        update={"factors": tuple(map(_numbered, study.factors)), "fixed": {}}
    )
    x = build_design(numbered, {}, tyre)[names].to_numpy(float)
    key = f"studies.{study.name}.terms"
    if len(x) <= len(polynomial):
        raise InputError(
            f"{len(x)} cases are too few for {len(polynomial)} terms",
            "add levels, or use fewer terms",
            column=key,
        )
    middle, half = (x.max(axis=0) + x.min(axis=0)) / 2, (x.max(axis=0) - x.min(axis=0)) / 2
    try:
        refuse_aliased(polynomial.matrix((x - middle) / half), polynomial.names)
    except InputError as error:
        raise InputError(error.message, error.remedy, column=key) from None


def _numbered(factor: Factor) -> Factor:
    """Give tested rubbers, whose moduli are not known yet, moduli that differ from all others."""
    numbers = [level for level in factor.levels if not isinstance(level, MeasuredRubber)]
    above = max(numbers, default=0.0)
    rubbers = len(factor.levels) - len(numbers)
    levels = (*numbers, *(above + 1.0 + 1.7 * number for number in range(rubbers)))
    return factor.model_copy(update={"levels": levels})


def _check_loads(
    study: Study, options: Mapping[str, Mapping[str, Any]], tyre: TyreGeometry
) -> None:
    """Refuse a load at which one of the solvers can solve no case."""
    for solver, checked in solvers_of(study, options):
        reason = checked.load_fault(study.load_n) if solver.loads_tyre else ""
        if reason:
            raise InputError(
                f"solver '{solver.name}': {reason}",
                "change the load, or leave the solver out of this study",
                column=f"studies.{study.name}.load_n",
                value=study.load_n,
            )


def name_faults(specimens: Sequence[Specimen], config: Config) -> list[InputError]:
    """Find names that cannot be used as file names, or that two things would share."""
    names = {
        "specimen": sorted({specimen.specimen for specimen in specimens}),
        "material": sorted({specimen.material for specimen in specimens}),
        "study": [study.name for study in config.studies],
    }
    faults = _capitals("material", names["material"])
    for kind, used in names.items():
        faults += [_unfit(kind, name) for name in used if len(name) > LONGEST_NAME or repeats(name)]
    return faults


def _capitals(kind: str, names: Sequence[str]) -> list[InputError]:
    """Find names that differ only in capital letters; specimens so named are refused row by row."""
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
"""Characters of a name; file systems allow 255 in a file name, which holds more than this name."""

MOST_REPEATS = 15
"""Times that a piece of a name may be repeated in a row; Snakemake refuses 20 as endless."""


def repeats(name: str) -> bool:
    """Tell whether a piece of a name is repeated in a row more often than `MOST_REPEATS`.

    Examples
    --------
    >>> repeats("T0-" + "0" * 12), repeats("T0-" + "01" * 16)
    (False, True)
    """
    longest = len(name) // (MOST_REPEATS + 1)
    return any(
        name[start : start + size] * (MOST_REPEATS + 1)
        == name[start : start + size * (MOST_REPEATS + 1)]
        for size in range(1, longest + 1)
        for start in range(len(name) - size * (MOST_REPEATS + 1) + 1)
    )
