"""All decisions of a run, and the uncertainty of reference and chosen designs."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pandas as pd

from nptcs.campaign.record import RecordStore
from nptcs.config.root import Config
from nptcs.config.studies.decisions import Decision
from nptcs.config.studies.goals import ResponseName
from nptcs.config.studies.study import Study
from nptcs.decisions.confirm import ConfirmationRound, SolverRun, confirmed
from nptcs.decisions.decide import decide
from nptcs.decisions.tables import DecisionAnswer
from nptcs.errors import InputError
from nptcs.files import read_model
from nptcs.responses.strength import ply_strengths
from nptcs.solvers.registry import load_solver, module_of
from nptcs.surface.registry import SurfaceRegistry
from nptcs.surface.stored import read_registry
from nptcs.tables.io import read_table
from nptcs.tables.laboratory.material_card import MaterialCard, PlyCard
from nptcs.tables.laboratory.statistics import StatisticsTable
from nptcs.tables.problems import problems_table
from nptcs.tables.published.stiffness import StiffnessErrors
from nptcs.tables.tyres.cases import Cases
from nptcs.tables.tyres.tyre_responses import TyreCurves, TyreResponses
from nptcs.uncertainty.source import Materials, Source
from nptcs.uncertainty.study_results import StudyResults, results_of
from nptcs.uncertainty.tables import NamedDesign

REFERENCE = "reference"


@dataclass(frozen=True)
class SolvedStudies:
    """Results of a run that decisions are based on.

    Parameters
    ----------
    config : Config
    cases, responses, curves, statistics, errors : DataFrame
        ``cases.csv``, ``tyre_responses.csv``, ``tyre_curves.csv``, ``statistics.csv`` and
        ``stiffness_errors.csv``.
    card : MaterialCard
    registries : mapping of str to SurfaceRegistry
        Stored surfaces by study.
    added : DataFrame
        Designs that were solved to confirm a choice and go into the surfaces: ``study``,
        ``solver`` and the factors.
    """

    config: Config
    cases: pd.DataFrame
    responses: pd.DataFrame
    curves: pd.DataFrame
    statistics: pd.DataFrame
    errors: pd.DataFrame
    card: MaterialCard
    registries: Mapping[str, SurfaceRegistry]
    added: pd.DataFrame = field(default_factory=lambda: pd.DataFrame(columns=["study", "solver"]))


def read_solved_studies(
    config: Config, files: Mapping[str, str], models: Sequence[str], added: Path
) -> SolvedStudies:
    """Read the results of a run.

    Parameters
    ----------
    config : Config
    files : mapping of str to str
        Paths of ``cases``, ``responses``, ``curves``, ``statistics``, ``errors`` and ``card``.
    models : sequence of str
        Files of stored surfaces, each named by its study.
    added : Path
        CSV with added designs; a file that does not exist adds none.

    Raises
    ------
    InputError
        For a file that is missing, damaged or not what it should be.
    """
    return SolvedStudies(
        config=config,
        cases=read_table(files["cases"], Cases),
        responses=read_table(files["responses"], TyreResponses),
        curves=read_table(files["curves"], TyreCurves),
        statistics=read_table(files["statistics"], StatisticsTable),
        errors=read_table(files["errors"], StiffnessErrors),
        card=read_model(files["card"], MaterialCard),
        registries={Path(file).stem: read_registry(file) for file in models},
        **({"added": read_added(added)} if added.is_file() else {}),
    )


def read_added(path: Path) -> pd.DataFrame:
    """Read designs that were added by ``nptcs design --confirm``.

    Raises
    ------
    InputError
        For a file that is not a CSV table with the columns study and solver.
    """
    try:
        table = pd.read_csv(path)
    except (pd.errors.ParserError, pd.errors.EmptyDataError, UnicodeDecodeError) as error:
        raise InputError(f"is not a CSV table: {error}", "correct or delete it", path) from None
    if missing := {"study", "solver"} - set(table):
        raise InputError(
            f"has no column {', '.join(sorted(missing))}", "correct or delete it", path
        )
    return table


def source_of(
    run: SolvedStudies, study: Study, solver: str, with_added: SolverRun | None
) -> Source:
    """Gather what predictions of a study and solver are based on.

    Parameters
    ----------
    run : SolvedStudies
    study : Study
    solver : str
    with_added : SolverRun or None
        Solves the added designs of this study and solver, or takes them from its store; None
        leaves them out.

    Raises
    ------
    InputError
        If no case of the study is solved by this solver.
    """
    tables = run.cases, run.responses, run.curves
    results = results_of(study, solver, *tables)
    rubbers = run.config.uncertainty.rubber_study
    varied: StudyResults | None = None
    if rubbers in {one.name for one in run.config.studies} and (
        solver in run.config.study(str(rubbers)).solvers
    ):
        varied = results_of(run.config.study(str(rubbers)), solver, *tables)
    module = load_solver(module_of(solver, run.config.options_of(study.name, solver)))
    ply = _ply(run, study) if module.needs_ply or study.needs_ply() else None
    source = Source(
        results=results,
        rubbers=varied if varied is not None and not varied.solved.empty else None,
        registry=run.registries.get(study.name),
        materials=Materials(run.card, ply),
        tyre=run.config.tyre,
        whole_plates=module.realise is not None,
        settings=run.config.uncertainty,
    )
    if results.solved.empty:
        raise InputError(
            f"no case of study {study.name} has been solved by {solver}",
            column="decisions.study",
            value=study.name,
            remedy="see cases.csv for what failed",
        )
    rows = run.added[(run.added["study"] == study.name) & (run.added["solver"] == solver)]
    if with_added is None or rows.empty:
        return source
    designs = rows[results.factors].drop_duplicates().astype(float)
    designs.insert(0, "case_id", [f"{study.name}_added_{n + 1}" for n in range(len(designs))])
    _, further = with_added.solve(source, designs)
    return replace(source, results=results.with_cases(further))


def solver_run(run: SolvedStudies, study: Study, solver: str, store: Path, cores: int) -> SolverRun:
    """Return how designs of a study are solved."""
    composites = run.statistics[~run.statistics["material"].isin(run.card.rubbers)]["material"]
    names = sorted(set(composites))
    return SolverRun(
        options=run.config.options_of(study.name, solver),
        tyre=run.config.tyre,
        store=RecordStore(store),
        cores=cores,
        responses=run.config.tyre_responses,
        strengths=ply_strengths(run.statistics, names[0] if len(names) == 1 else None),
    )


def answer(
    run: SolvedStudies, decision: Decision, store: Path, cores: int
) -> tuple[DecisionAnswer, Source]:
    """Answer one decision, and confirm it where that is requested.

    Raises
    ------
    InputError
        Where the question cannot be answered from these cases.
    """
    study = run.config.study(decision.study)
    solving = solver_run(run, study, decision.solver, store, cores)
    source = source_of(run, study, decision.solver, solving)
    start = time.process_time()
    rounds: list[ConfirmationRound] = []
    if decision.confirm:
        outcome, rounds, source = confirmed(decision, source, solving)
    else:
        outcome = decide(decision, source)
    return DecisionAnswer(decision, outcome, tuple(rounds), time.process_time() - start), source


@dataclass(frozen=True)
class Answered:
    """The answers to all decisions of a run.

    Parameters
    ----------
    answers : tuple of DecisionAnswer
    designs : tuple of NamedDesign
        Reference designs and chosen ones.
    problems : DataFrame
        `nptcs.tables.problems.Problems`: what could not be answered or confirmed.
    """

    answers: tuple[DecisionAnswer, ...]
    designs: tuple[NamedDesign, ...]
    problems: pd.DataFrame


def answer_all(run: SolvedStudies, store: Path, cores: int) -> Answered:
    """Answer all decisions of the configuration and gather the designs to be assessed.

    A decision that cannot be answered, an infeasible one, and one whose design was not confirmed
    are listed as problems; the other decisions are still answered.
    """
    answers, designs, problems = [], [], []
    for study in run.config.studies:
        if study.reference:
            found, refused = _references(run, study)
            designs += found
            problems += refused
    for decision in run.config.decisions:
        try:
            one, source = answer(run, decision, store, cores)
        except InputError as error:
            answers.append(DecisionAnswer(decision, None, refusal=str(error)))
            problems.append(("decision", decision.name, decision.solver, "refused", str(error)))
            continue
        answers.append(one)
        problems += [("decision", decision.name, decision.solver, *row) for row in _faults(one)]
        if one.outcome is not None and one.outcome.found.feasible:
            point = one.outcome.found.designs.x[one.outcome.choice]
            fitted = tuple(one.outcome.problem.fitted.values())
            designs.append(NamedDesign(decision.name, source, point, fitted))
    return Answered(tuple(answers), tuple(designs), problems_table(problems))


def _faults(one: DecisionAnswer) -> Iterator[tuple[str, str]]:
    """Yield status and message of what a reader must see."""
    if one.outcome is not None and not one.outcome.found.feasible:
        yield "infeasible", one.outcome.why
    if one.rounds and one.rounds[-1].result != "inside":
        last = one.rounds[-1]
        why = last.record.result.message or "see decision_confirmation.csv"
        yield (
            last.result,
            f"the chosen design is not confirmed after {len(one.rounds)} rounds: {why}",
        )


def _references(
    run: SolvedStudies, study: Study
) -> tuple[list[NamedDesign], list[tuple[str, str, str, str, str]]]:
    """Gather a study's reference design by each solver that has the surface, and the refusals.

    A solver must give the stiffness; other responses that it does not give are left out.
    """
    found, refused = [], []
    for solver in study.solvers:
        options = run.config.options_of(study.name, solver)
        module = load_solver(module_of(solver, options))
        values = dict(study.reference)
        if module.realise is not None:
            realised = module.realise({**values, **_fixed_numbers(study)}, run.config.tyre)
            values |= {name: value for name, value in realised.items() if name in values}
        try:
            source = source_of(run, study, solver, None)
            stiffness, *further = map(source.results.at_its_load, _responses_of(study))
            given = [stiffness, *filter(source.results.gives, further)]
            fitted = tuple(source.fit(name) for name in given)
            point = np.array([values[name] for name in fitted[0].model.factors])
            _refuse_outside(fitted[0].model.inside(point[None, :])[0], study, values)
        except InputError as error:
            refused.append(("uncertainty", study.name, solver, "refused", str(error)))
            continue
        found.append(NamedDesign(REFERENCE, source, point, fitted))
    return found, refused


def _responses_of(study: Study) -> list[ResponseName]:
    stiffness = ResponseName("secant_stiffness", f"{study.load_n:g} N")
    further = [ResponseName(one.name, one.at(study.load_n)) for one in study.responses]
    return list(dict.fromkeys([stiffness, *further]))


def _refuse_outside(inside: bool, study: Study, values: Mapping[str, float]) -> None:
    if not inside:
        raise InputError(
            "the reference design is outside the solved cases",
            column=f"studies.{study.name}.reference",
            value=dict(values),
            remedy="give a design inside the range of the levels",
        )


def _fixed_numbers(study: Study) -> dict[str, float]:
    return {name: value for name, value in study.fixed.items() if isinstance(value, float)}


def _ply(run: SolvedStudies, study: Study) -> PlyCard | None:
    plies = run.card.plies
    if study.ply is not None:
        return plies.get(study.ply)
    return next(iter(plies.values())) if len(plies) == 1 else None
