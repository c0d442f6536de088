"""Gauges on both faces of a flat specimen: their mean is free of bending."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pandas as pd

from nptcs.reduce.curve.branch import Branch


def mean_of_faces(branch: pd.DataFrame) -> pd.DataFrame:
    """Branch with strain_axial as the mean of both faces where the back face was measured."""
    if branch["strain_axial_back"].isna().all():
        return branch
    return branch.assign(strain_axial=(branch["strain_axial"] + branch["strain_axial_back"]) / 2)


def branch_of_faces(branch: Branch) -> tuple[Branch, tuple[str, ...]]:
    """Replace the axial strain of a branch by the mean of both faces, and say so.

    Returns
    -------
    Branch
        The same one where only one face was measured.
    tuple of str
        A flag with the bending between the faces at the end of the strain; empty for one face.
    """
    front, back = (branch.rows[name] for name in ("strain_axial", "strain_axial_back"))
    both = np.flatnonzero((front.notna() & back.notna()).to_numpy())
    if not len(both):
        return branch, ()
    first, second = float(front.iloc[both[-1]]), float(back.iloc[both[-1]])
    total = first + second
    share = f"{100 * abs(first - second) / total:.3g} %" if total > 0 else "not assessed"
    words = f"strain is the mean of both faces, bending {share}"
    mean = replace(
        branch,
        rows=mean_of_faces(branch.rows),
        to_peak=mean_of_faces(branch.to_peak),
        turned=mean_of_faces(branch.turned),
    )
    return mean, (words,)
