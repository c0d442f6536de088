"""``nptcs design``: the design that meets goals, from the surfaces of a finished run."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from nptcs.arguments import (
    add_command,
    existing_file,
    existing_folder,
    number_type,
    whole_number_type,
)
from nptcs.ranges import Range

if TYPE_CHECKING:
    from nptcs.config.root import Config
    from nptcs.config.studies.decisions import Decision
    from nptcs.decisions.decide import Outcome
    from nptcs.decisions.tables import DecisionAnswer

EXAMPLES = (
    "nptcs design k300",
    "nptcs design --target K=300±5@5000 --at-least K=250@3000 --minimise plate_mass",
    "nptcs design --target K=280+-8 --minimise plate_mass --minimise plate_largest_mises --json",
)
GOAL_WORDS = """K is the secant stiffness in N/mm, at the load after @ or at the study's; other
responses are those of tyre_responses.csv. ± may be written +-. *2 at the end of a goal is its
weight."""
GOALS = {
    "target": "response and half width that must hold, such as K=300±5@5000",
    "at-least": "bound that must hold, such as K=250@3000",
    "at-most": "bound that must hold, such as plate_largest_mises=120",
    "minimise": "response to make as small as possible, such as plate_mass",
    "maximise": "response to make as large as possible",
}
TABLES = {
    "cases": "cases.csv",
    "responses": "tyre_responses.csv",
    "curves": "tyre_curves.csv",
    "statistics": "statistics.csv",
    "errors": "stiffness_errors.csv",
}


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "design",
        "find the design that meets goals with a stated probability",
        "Looks for designs among those that the study's surfaces can predict, with a "
        "whole number of plates. All targets and bounds must hold together with the probability, "
        "over the uncertainty of materials, tolerances and surface. The study must have been run. "
        "Exit code 1: no design meets the goals, or the solver does not confirm it.",
        *EXAMPLES,
    )
    parser.epilog = f"{parser.epilog}\n\n{GOAL_WORDS}"
    parser.add_argument("decision", nargs="?", help="name of a decision of the configuration")
    for name, words in GOALS.items():
        parser.add_argument(f"--{name}", action="append", default=[], metavar="GOAL", help=words)
    parser.add_argument(
        "--with-probability",
        type=number_type(Range(0, 1, open_low=True, open_high=True)),
        metavar="P",
        help="probability with which all targets and bounds must hold together; default: 0.9",
    )
    parser.add_argument("--study", help="default: the only study whose cases vary the plates")
    parser.add_argument("--solver", help="default: the only one of the study that solves designs")
    parser.add_argument("--surface", help="default: that of `uncertainty`, or the best")
    parser.add_argument(
        "--hold", action="append", default=[], metavar="FACTOR=VALUE", help="fix a factor's value"
    )
    parser.add_argument(
        "--step",
        action="append",
        default=[],
        metavar="FACTOR=STEP",
        help="step between the values that can be made",
    )
    parser.add_argument("--top", type=whole_number_type(1, 50), help="designs to list; default: 5")
    parser.add_argument("--confirm", action="store_true", help="solve the chosen design")
    parser.add_argument(
        "--cores", type=whole_number_type(1), default=1, help="for --confirm; default: %(default)s"
    )
    parser.add_argument("--json", action="store_true", help="print JSON for programs")
    parser.add_argument(
        "--config",
        type=existing_file,
        default="config/config.yaml",
        help="configuration of the study; default: %(default)s",
    )
    parser.add_argument(
        "--results",
        type=existing_folder,
        default="results",
        help="folder of the finished run; default: %(default)s",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Print the designs; exit code 1 if none meets the goals or the choice is not confirmed."""
    from nptcs.config.files import read_config_files
    from nptcs.decisions.run import answer, read_solved_studies

    config = read_config_files([arguments.config])
    decision = decision_of(arguments, config)
    results: Path = arguments.results
    tables = {name: str(results / "tables" / file) for name, file in TABLES.items()}
    tables["card"] = str(results / "material_card.json")
    models = sorted(map(str, (results / "6_surface" / "models").glob("*.json")))
    added = results / "7_decide" / "added_cases.csv"
    finished = read_solved_studies(config, tables, models, added)
    store = results / "5_solve" / "records"
    done, source = answer(finished, decision, store, arguments.cores)
    print(as_json(done) if arguments.json else as_text(done))
    if new := _added(done):
        _append(added, decision, new)
        print(
            f"outside the prediction: the case was added to {added}; the next run of snakemake "
            "includes it in the fits without solving it again",
            file=sys.stderr,
        )
    if done.outcome is None or not done.outcome.found.feasible:
        return 1
    return 0 if not done.rounds or done.rounds[-1].result == "inside" else 1


def decision_of(arguments: argparse.Namespace, config: Config) -> Decision:
    """Return the decision of the configuration as changed by the options, or that of the options.

    Raises
    ------
    InputError
        For an unknown name, goals that cannot be read, or a study that must be named.
    """
    from pydantic import ValidationError

    from nptcs.config.studies.decisions import Decision
    from nptcs.errors import InputError

    values: dict[str, Any] = {"name": "command_line"}
    if arguments.decision is not None:
        known = {decision.name: decision for decision in config.decisions}
        if arguments.decision not in known:
            raise InputError(
                "the configuration has no such decision",
                file=arguments.config,
                value=arguments.decision,
                remedy=f"name one of {', '.join(known) or 'none'}, or give goals as options",
            )
        values = known[arguments.decision].model_dump()
    values |= {
        key: tuple(given)
        for key, given in (
            ("targets", arguments.target),
            ("at_least", arguments.at_least),
            ("at_most", arguments.at_most),
            ("minimise", arguments.minimise),
            ("maximise", arguments.maximise),
        )
        if given
    }
    for key in ("study", "solver", "surface", "with_probability", "top"):
        if (given := getattr(arguments, key)) is not None:
            values[key] = given
    for key, given in (("hold", arguments.hold), ("steps", arguments.step)):
        values[key] = {**values.get(key, {}), **dict(map(_assignment, given))}
    values["confirm"] = arguments.confirm
    _complete(values, config)
    try:
        decision = Decision.model_validate(values)
        config.check_decision(decision)
    except ValidationError as error:
        raise InputError(_first(error)) from None
    except ValueError as error:
        raise InputError(str(error)) from None
    return decision


def as_text(done: DecisionAnswer) -> str:
    """Write an answer for a reader."""
    from nptcs.decisions.tables import goals_text

    outcome = done.outcome
    if outcome is None:
        return done.refusal
    found, decision = outcome.found, done.decision
    lines = [
        f"study {decision.study}, solver {decision.solver}: {goals_text(decision)}",
        f"with probability {decision.with_probability:g}; {found.feasible_percent:.3g} % of "
        f"{len(found.candidates.x)} candidates meet all targets and bounds",
        "",
    ]
    lines[-1:] = [_surfaces_line(outcome), ""]
    if not found.feasible:
        lines += [outcome.why, "", "nearest design:"]
    elif outcome.why:
        lines += [outcome.why, ""]
    lines.append(_designs_table(outcome))
    lines += ["", "± is one standard deviation: materials, tolerances and surface; * is the choice"]
    lines += _short_line(outcome)
    lines += [f"not assessed: {', '.join(outcome.not_assessed)}"] if outcome.not_assessed else []
    return "\n".join([*lines, *_round_lines(done), f"fit and search: {done.cpu_s:.1f} s of CPU"])


def _short_line(outcome: Outcome) -> list[str]:
    """Say which designs are listed although fewer of their samples hold than asked for."""
    from nptcs.decisions.decide import SAMPLING_ERROR

    asked = outcome.decision.with_probability
    if not outcome.found.feasible or not (outcome.sampled < asked).any():
        return []
    less = [str(place + 1) for place, holds in enumerate(outcome.holds) if not holds]
    line = f"probabilities are sampled: {asked:g} is met within {SAMPLING_ERROR:g}"
    return [line + (f", but not by rank {', '.join(less)}" if less else "")]


def _surfaces_line(outcome: Outcome) -> str:
    """Say by which surface each response is predicted."""
    by_surface: dict[str, list[str]] = {}
    for response, fitted in outcome.problem.fitted.items():
        by_surface.setdefault(fitted.surface, []).append(str(response))
    said = (f"{', '.join(responses)} by {name}" for name, responses in by_surface.items())
    return f"predicted: {'; '.join(said)}"


def _designs_table(outcome: Outcome) -> str:
    """Write the designs as a table: factors, plates, responses, probability."""
    from nptcs.decisions.tables import plates_of
    from nptcs.report.tables.headings import heading
    from nptcs.report.text import number_text
    from nptcs.text_table import text_table

    found, fitted = outcome.found, outcome.problem.fitted
    heads = [heading(name) for name in outcome.space.factors]
    titles = [f"{head.name}\n({head.unit})" for head in heads]
    titles += ["plates"] if outcome.space.plates else []
    titles += [f"{response}\n({model.unit})" for response, model in fitted.items()]
    rows = []
    for place, point in enumerate(found.designs.x):
        samples = outcome.samples[place]
        chosen = found.feasible and place == outcome.choice
        rows.append(
            [
                f"{place + 1} *" if chosen else f"{place + 1}  ",
                *(number_text(float(value), 4) for value in point),
                *([str(plates_of(outcome, point))] if outcome.space.plates else []),
                *(f"{samples[r].mean():.5g} ± {samples[r].std():.2g}" for r in fitted),
                f"{outcome.sampled[place]:.3f}",
                f"{found.desirability[place]:.3f}",
            ]
        )
    titles = ["rank", *titles, "probability", "desirability"]
    return text_table(titles, rows, [True] * len(titles))


def as_json(done: DecisionAnswer) -> str:
    """Write an answer for a program: the rows of the result tables."""
    from nptcs.decisions.tables import decision_tables

    tables = decision_tables([done])
    content = {
        "decision": tables.decisions,
        "designs": tables.designs,
        "front": tables.front,
        "confirmation": tables.confirmation,
    }
    plain = {name: json.loads(table.to_json(orient="records")) for name, table in content.items()}
    plain["decision"] = plain["decision"][0]
    return json.dumps(plain, indent=1, ensure_ascii=False)


def _round_lines(done: DecisionAnswer) -> list[str]:
    lines = []
    for place, one in enumerate(done.rounds, start=1):
        for name, compared in one.compared.items():
            if compared.result == "not solved":
                text = f"not solved: {one.record.result.message}"
            else:
                text = (
                    f"solved {compared.solved:.6g}, predicted {compared.predicted:.6g} "
                    f"({compared.low:.6g} to {compared.high:.6g}): {compared.result}"
                )
            lines.append(f"round {place}, {one.record.wall_time_s:.1f} s: {name} {text}")
    return lines


def _added(done: DecisionAnswer) -> list[dict[str, float]]:
    """Return the designs that were solved outside the prediction."""
    return [
        one.outcome.design(one.outcome.choice) for one in done.rounds if one.result == "outside"
    ]


def _append(path: Path, decision: Decision, designs: list[dict[str, float]]) -> None:
    import pandas as pd

    from nptcs.decisions.run import read_added
    from nptcs.files import atomic_path

    new = pd.DataFrame([{"study": decision.study, "solver": decision.solver, **d} for d in designs])
    old = [read_added(path)] if path.is_file() else []
    path.parent.mkdir(parents=True, exist_ok=True)
    with atomic_path(path) as temporary:
        table = pd.concat([*old, new], ignore_index=True).drop_duplicates()
        table.to_csv(temporary, index=False, lineterminator="\n")


def _complete(values: dict[str, Any], config: Config) -> None:
    """Fill in study and solver if there is only one."""
    from nptcs.errors import InputError

    with_plates = [
        study.name
        for study in config.studies
        if study.terms and any(factor.name == "thickness_mm" for factor in study.factors)
    ]
    if "study" not in values:
        if len(with_plates) != 1:
            raise InputError(
                "which study?",
                column="--study",
                remedy=f"name one of {', '.join(s.name for s in config.studies if s.terms)}",
            )
        values["study"] = with_plates[0]
    names = {study.name: study for study in config.studies}
    if values["study"] not in names:
        raise InputError(
            "there is no such study",
            column="--study",
            value=values["study"],
            remedy=f"name one of {', '.join(names)}",
        )
    if "solver" not in values:
        solvers = [name for name in names[values["study"]].solvers if name != "published"]
        if len(solvers) != 1:
            raise InputError(
                "which solver?", column="--solver", remedy=f"name one of {', '.join(solvers)}"
            )
        values["solver"] = solvers[0]


def _assignment(text: str) -> tuple[str, float]:
    from nptcs.errors import InputError

    name, equals, value = text.partition("=")
    try:
        number = float(value)
    except ValueError:
        number = float("nan")
    if not equals or number != number:
        raise InputError(
            "is not FACTOR=NUMBER",
            column="--hold or --step",
            value=text,
            remedy="write it like thickness_mm=1.8",
        )
    return name.strip(), number


def _first(error: Any) -> str:
    """Return the first fault of a validation without pydantic's own words."""
    fault = error.errors()[0]
    place = ".".join(str(part) for part in fault["loc"])
    message = str(fault["msg"]).removeprefix("Value error, ")
    return f"{place}: {message}" if place else message
