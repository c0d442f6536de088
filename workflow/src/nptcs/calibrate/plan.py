"""Which cards a sheet can give and which of them a study uses, known before anything runs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from nptcs.calibrate.ply import MEASURED
from nptcs.config.materials.calibration import CalibrationSettings, ConstantSource
from nptcs.config.studies.study import Study
from nptcs.errors import InputError
from nptcs.mechanical_tests import HYPERELASTIC_FIT
from nptcs.tables.laboratory.specimens import Specimen


def composites(specimens: Iterable[Specimen]) -> list[str]:
    """Materials of the composite tests of a sheet."""
    return sorted({s.material for s in specimens if not s.test.is_rubber})


def rubbers(specimens: Iterable[Specimen]) -> list[str]:
    """Materials with a rubber test that enters a fit."""
    return sorted({s.material for s in specimens if s.test.is_rubber and s.gives(HYPERELASTIC_FIT)})


def lacking(
    material: str, specimens: Sequence[Specimen], settings: CalibrationSettings
) -> list[str]:
    """Say which constants of a ply no specimen of the sheet can give; empty if all are given."""
    own = [s for s in specimens if s.material == material]
    sources: dict[str, ConstantSource] = {name: getattr(settings.ply, name) for name in MEASURED}
    return [
        f"{name}: no {source.property} from {' or '.join(source.tests)} at "
        f"{source.orientation_deg:g} degrees"
        for name, source in sources.items()
        if not any(_serves(specimen, source) for specimen in own)
    ]


def _serves(specimen: Specimen, source: ConstantSource) -> bool:
    angle = specimen.orientation_deg
    return (
        specimen.test in source.tests
        and angle is not None
        and abs(angle) == abs(source.orientation_deg)
        and specimen.gives(source.property)
    )


def plies(specimens: Sequence[Specimen], settings: CalibrationSettings) -> list[str]:
    """Composites of the sheet whose specimens give all constants: each has its own card."""
    return [name for name in composites(specimens) if not lacking(name, specimens, settings)]


def ply_of(study: Study, specimens: Sequence[Specimen], settings: CalibrationSettings) -> str:
    """Name of the ply that a study's solvers use.

    Raises
    ------
    InputError
        If the study names none and the sheet gives several or none, or names one that the sheet
        does not give.
    """
    known = plies(specimens, settings)
    if study.ply is None and len(known) == 1:
        return known[0]
    if study.ply in known:
        return str(study.ply)
    reasons = [
        f"{name} lacks {'; '.join(missing)}"
        for name in composites(specimens)
        if study.ply in (None, name) and (missing := lacking(name, specimens, settings))
    ]
    remedy = f"name one of {', '.join(known)} as ply of the study" if known else "add specimens"
    if study.ply is None:
        message = f"study {study.name} needs one ply, the sheet has {len(known)}"
    else:
        message = f"study {study.name} names a ply that the sheet does not have"
    raise InputError(
        "; ".join([message, *reasons]),
        remedy,
        column=f"studies: {study.name}: ply",
        value=study.ply or ", ".join(known) or None,
    )


def check_materials(
    studies: Iterable[tuple[Study, bool]],
    specimens: Sequence[Specimen],
    settings: CalibrationSettings,
) -> tuple[list[InputError], list[str]]:
    """Find what cannot work between studies and sheet, and say which cards there will be.

    Parameters
    ----------
    studies : iterable of (Study, bool)
        Each study, and whether one of its solvers needs a ply.
    specimens : sequence of Specimen
        The sheet.
    settings : CalibrationSettings
        Where the constants come from.

    Returns
    -------
    errors : list of InputError
        A ply or rubber that a study needs and the sheet does not give; a material that is tested
        as composite and as rubber.
    notes : list of str
        One line for each card, and for each composite that gets none.
    """
    errors = _both_kinds(specimens)
    known = rubbers(specimens)
    for study, needs_ply in studies:
        errors += [
            InputError(
                f"study {study.name} names rubber {name}, but no specimen of it enters a fit",
                "add or include its specimens"
                + (f", or name one of {', '.join(known)}" if known else ""),
                column=f"studies: {study.name}",
                value=name,
            )
            for name in study.rubbers()
            if name not in known
        ]
        if needs_ply:
            try:
                ply_of(study, specimens, settings)
            except InputError as error:
                errors.append(error)
    notes = [f"card of rubber {name}" for name in known]
    for name in composites(specimens):
        missing = lacking(name, specimens, settings)
        words = f"no card of ply {name}: {'; '.join(missing)}" if missing else f"card of ply {name}"
        notes.append(words)
    return errors, notes


def _both_kinds(specimens: Sequence[Specimen]) -> list[InputError]:
    rubber = {s.material for s in specimens if s.test.is_rubber}
    return [
        InputError(
            f"material {name} has composite and rubber tests",
            "give the two materials different names",
            column="material",
            value=name,
        )
        for name in composites(specimens)
        if name in rubber
    ]
