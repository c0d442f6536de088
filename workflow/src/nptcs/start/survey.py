"""Find the facts for the rules, and every fault of a configuration that is known before a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from nptcs.calibrate.plan import check_materials, plies, ply_of, rubbers
from nptcs.campaign.checks import name_faults, refuse_faults, study_faults
from nptcs.config.root import Config
from nptcs.config.studies.study import Study
from nptcs.files import sha256_of_text
from nptcs.ingest.reading.profiles import load_profiles
from nptcs.report.page_files import page_faults
from nptcs.solvers.registry import (
    MODULES,
    load_solver,
    model_choices,
    module_of,
    needs_ply,
    read_options,
)
from nptcs.start.facts import RuleFacts, SolverFacts, contents
from nptcs.tables.catalogue import result_files
from nptcs.tables.laboratory.specimens import Specimen


def survey(config: Config, specimens: Sequence[Specimen], checked: bool = True) -> RuleFacts:
    """Find the facts for the rules.

    Parameters
    ----------
    config : Config
    specimens : sequence of Specimen
        The good rows of the sheet.
    checked : bool
        Whether faults of studies and names are refused too; a job on another machine, whose run
        has been checked, need not look again.

    Raises
    ------
    InputError
        Naming every fault with its remedy.
    """
    takes_ply = [
        (study, needs_ply(study, config.solver_options(study))) for study in config.studies
    ]
    faults, _ = check_materials(takes_ply, specimens, config.calibration)
    if checked:
        faults = [*study_faults(config), *faults, *name_faults(specimens, config)]
        faults += page_faults(config)
    refuse_faults(faults)
    profiles = load_profiles(config.lab_data.formats)
    solvers = {study.name: _solvers(study, config) for study in config.studies}
    return RuleFacts(
        solvers=solvers,
        files=contents(_files(config, solvers)),
        modules=dict(MODULES),
        plies=tuple(plies(specimens, config.calibration)),
        rubbers=tuple(rubbers(specimens)),
        ply={
            study.name: ply_of(study, specimens, config.calibration)
            for study, needed in takes_ply
            if needed or study.needs_ply()
        },
        profiles={name: sha256_of_text(one.model_dump_json()) for name, one in profiles.items()},
        tables=tuple(
            file for file, _, _ in result_files([s.name for s in config.studies if s.terms])
        ),
    )


def _files(config: Config, solvers: Mapping[str, Mapping[str, SolverFacts]]) -> set[str]:
    """Name the files in which a check of the studies may have looked."""
    read = [one.tables().values() for named in solvers.values() for one in named.values()]
    of_solvers = {path for paths in read for path in paths}
    of_studies = {
        path
        for study in config.studies
        for path in (study.published_coefficients, study.published_spoke_stiffness)
        if path is not None
    }
    return of_solvers | of_studies | set(config.page_inputs())


def _solvers(study: Study, config: Config) -> dict[str, SolverFacts]:
    options = config.solver_options(study)
    bulk = study.number_of_cases() >= config.campaign.bulk_from
    return {name: _solver(name, options[name], bulk) for name in study.solvers}


def _solver(name: str, given: Mapping[str, Any], bulk: bool) -> SolverFacts:
    module = module_of(name, given)
    solver = load_solver(module)
    options = read_options(solver, given)
    in_tables = bulk and solver.solve_table is not None and solver.table_case_s is not None
    return SolverFacts(
        module=module,
        about=solver.about,
        needs_ply=solver.needs_ply,
        loads_tyre=solver.loads_tyre,
        solves_tables=solver.solve_table is not None,
        choices=model_choices(options),
        table_paths=dict(options.tables()),
        without_effect=tuple(sorted(options.without_effect)),
        cores=options.cores_per_case(),
        tokens=options.tokens_per_case(),
        case_s=(solver.table_case_s if in_tables else None) or options.case_s,
        case_memory_mb=options.case_memory_mb,
        timeout_s=options.timeout_s,
        whole_plates=solver.realise is not None,
        preload=solver.preload,
    )
