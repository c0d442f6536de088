"""The solvers by name: those of this package and those that a laboratory adds."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Mapping, Set
from pathlib import Path
from typing import Any, Literal, get_origin

from pydantic import ValidationError

from nptcs.config.explain import describe_faults
from nptcs.config.studies.study import Study
from nptcs.errors import InputError
from nptcs.solvers.contract import Solver, SolverOptions

MODULES = {
    "abaqus": "nptcs.solvers.abaqus",
    "calculix": "nptcs.solvers.calculix",
    "fe_spoke": "nptcs.solvers.fe_spoke",
    "fe_tyre": "nptcs.solvers.fe_tyre",
    "fe_tyre_paper": "nptcs.solvers.fe_tyre_paper",
    "lca": "nptcs.solvers.lca",
    "published": "nptcs.solvers.published",
    "ring": "nptcs.solvers.ring",
}
"""Solvers of this package: a name and the module that defines ``SOLVER``."""


def module_of(name: str, options: Mapping[str, Any]) -> str:
    """Return the module, or the Python file, in which a solver is defined.

    Parameters
    ----------
    name : str
        Name of the solver.
    options : mapping
        Its section of the configuration; a key ``module`` names the Python file of a solver
        that does not belong to this package.

    Raises
    ------
    InputError
        For an unknown name.
    """
    if "module" in options:
        return str(options["module"])
    if name not in MODULES:
        raise InputError(
            "unknown solver",
            column="solvers",
            value=name,
            remedy=f"use one of {', '.join(sorted(MODULES))}, or give the file of your own "
            f"solver as solvers.{name}.module",
        )
    return MODULES[name]


def load_solver(module: str) -> Solver:
    """Import a solver's module (dotted name, or the path of a Python file).

    Raises
    ------
    InputError
        If the file does not exist, or is not a Python file.
    """
    if not module.endswith(".py"):
        return importlib.import_module(module).SOLVER
    path = Path(module)
    if not path.is_file():
        raise InputError("the solver's file does not exist", file=path, remedy="correct `module`")
    spec = importlib.util.spec_from_file_location(f"nptcs_solver_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise InputError("not a Python file", file=path, remedy="give a file that ends in .py")
    loaded = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = loaded
    spec.loader.exec_module(loaded)
    return loaded.SOLVER


def read_options(solver: Solver, options: Mapping[str, Any]) -> SolverOptions:
    """Check a solver's options against its schema.

    Raises
    ------
    InputError
        Naming the key, the value and the nearest known key.
    """
    own = {key: value for key, value in options.items() if key != "module"}
    try:
        return solver.options.model_validate(own)
    except ValidationError as error:
        raise InputError(
            describe_faults(error, solver.options), column=f"solvers.{solver.name}"
        ) from None


def model_choices(options: SolverOptions) -> dict[str, str]:
    """Options that name one of several models, for example how plates are joined to the rubber."""
    return {
        name: str(getattr(options, name))
        for name, field in type(options).model_fields.items()
        if get_origin(field.annotation) is Literal
    }


def needs_ply(study: Study, options: Mapping[str, Mapping[str, Any]]) -> bool:
    """Tell whether one of a study's solvers needs the constants of a ply.

    Parameters
    ----------
    study : Study
        With the names of its solvers.
    options : mapping
        Options of each of these solvers.
    """
    return any(load_solver(module_of(name, options[name])).needs_ply for name in study.solvers)


def check_study(study: Study, options: Mapping[str, Mapping[str, Any]]) -> None:
    """Refuse a study that one of its solvers cannot answer.

    Parameters
    ----------
    study : Study
        Factors, fixed values and the names of the solvers.
    options : mapping
        Options of each of these solvers.

    Raises
    ------
    InputError
        If a solver does not use a factor of the study (it would return a constant), lacks a value
        that it needs, has faulty options, or cannot give what the study needs.
    """
    solvers = {name: load_solver(module_of(name, options[name])) for name in study.solvers}
    _check_responses(study, solvers)
    for name, solver in solvers.items():
        read_options(solver, options[name])
        varied = {factor.name for factor in study.factors}
        if unseen := sorted(varied - solver.factors):
            raise InputError(
                f"solver '{name}' does not use {', '.join(unseen)}: its result would not change "
                "with it",
                column=f"studies.{study.name}.solvers",
                value=name,
                remedy=f"leave '{name}' out of this study; it uses "
                + ", ".join(sorted(solver.factors)),
            )
        if lacking := sorted(solver.required - varied - set(study.fixed)):
            raise InputError(
                f"solver '{name}' needs {', '.join(lacking)}",
                column=f"studies.{study.name}.fixed",
                remedy="give a value under `fixed`, or make it a factor",
            )


def _check_responses(study: Study, solvers: Mapping[str, Solver]) -> None:
    """Refuse responses that the study requests and none of its solvers gives."""
    spokes = [name for name, solver in solvers.items() if not solver.loads_tyre]
    if spokes and study.terms:
        raise InputError(
            "solvers of single spokes give no vertical stiffness, to which a surface could be "
            "fitted",
            column=f"studies.{study.name}.solvers",
            value=", ".join(spokes),
            remedy="leave `terms` out, or put the spokes in a separate study",
        )
    if study.published_spoke_stiffness and not spokes:
        raise InputError(
            "no solver of this study computes single spokes",
            column=f"studies.{study.name}.published_spoke_stiffness",
            remedy="leave the key out, or run fe_spoke",
        )
    _check_calibration_cases(study, {*solvers} - {*spokes, "published"})


def _check_calibration_cases(study: Study, tyres: Set[str]) -> None:
    """Refuse calibration cases of a solver whose stiffness is not compared with the published."""
    compared = tyres if "published" in study.solvers else set()
    if stray := sorted(set(study.calibration_cases) - compared):
        raise InputError(
            "calibration cases have no effect where no stiffness is compared with the paper's",
            column=f"studies.{study.name}.calibration_cases",
            value=", ".join(stray),
            remedy="run the solver 'published' in this study as well as these solvers of tyres, or "
            "leave the key out",
        )
