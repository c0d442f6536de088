"""Why something gave no result: messages of the stages in the language of the page.

The tables hold what a stage wrote: place, message, value and remedy as `nptcs.errors.InputError`
joins them. Each part is translated where its sentence is known, and stays as it is where it is not.
"""

from __future__ import annotations

from nptcs.language import tr, translatable
from nptcs.report.words.flags import flag_text, translated

SENTENCES = (
    # solved cases
    translatable("spoke: {reason}"),
    translatable("out of memory: {reason}"),
    translatable("must be positive"),
    translatable("give a number above zero"),
    translatable("the finite element model needs this value"),
    translatable("give it as a factor or a fixed value of the study"),
    translatable("plates {width} mm wide overlap at this spacing"),
    translatable("choose a spacing above the plate's width"),
    translatable("the finite element model needs the ply's constants, missing: {names}"),
    translatable("name a ply of the material card in the study"),
    translatable("stopped after {seconds} s"),
    translatable("row {row} of {file}"),
    # surfaces
    translatable("solve more cases or fit fewer terms"),
    translatable("{cases} solved cases cannot determine {terms} terms"),
    translatable("solved cases have no response to fit"),
    translatable("fit surfaces to solvers that give the vertical stiffness"),
    translatable("the response is the same in all cases"),
    translatable("check that the solver uses the factors of this study"),
    translatable("only one level of a factor has results"),
    translatable("solve cases at two levels or more, or leave the factor out"),
    translatable(
        "drop the aliased terms, or give the factor one level more than its highest power"
    ),
    translatable("the lamination form needs the constants of the plates' ply"),
    translatable("give the specimens of a ply, or leave the lamination form out"),
    translatable("the lamination form needs positive stiffness, spacing and thickness"),
    translatable("correct the cases"),
    translatable("the {link} link needs a positive response"),
    translatable("use the identity link for this response"),
    translatable("leave this surface out, or change its mean"),
    translatable("no surface from so few cases: {counts}"),
    translatable("this distribution is outside the cases ({low} to {high})"),
    translatable("give a distribution inside the range of the levels"),
    # uncertainty and decisions
    translatable("no case of study {study} by {solver} is solved"),
    translatable("see cases.csv for what failed"),
    translatable("the reference design is outside the solved cases"),
    translatable("give a design inside the range of the levels"),
    translatable("no whole number of plates lies between the spacings of the cases"),
    translatable("solve cases over a wider range of spacings"),
    translatable("only {cases} cases of study {study} have {response}"),
    translatable("solve more cases"),
    translatable("study {study} has no such surface"),
    translatable("study {study} does not vary the plates"),
    translatable("leave the plates' mass out of the goals"),
    translatable("this rubber has no material card"),
    translatable("the card of this rubber has no standard error of C10"),
    translatable("test at least two specimens, or state sd_percent"),
    # specimens
    translatable("correct the name in the sheet"),
    translatable("file is empty"),
    translatable("export the test again"),
    translatable("is binary, not text"),
    translatable("export it as text or as XLSX"),
    translatable("name a strain_file in the sheet"),
    translatable("strain_axis is not a strain of the file"),
    translatable("axial strain falls while a {test} test loads"),
    translatable("only {rows} rows are common in time"),
    translatable("largest strain {strain} is beyond {limit} (dimensionless)"),
    translatable("apparent modulus {modulus} MPa is outside {low} to {high} MPa"),
    translatable("time does not grow from reading {first} to {second}"),
    translatable("delete the reading, or export one test per file"),
)
"""What the stages write, without place, value and remedy."""

REMEDY, VALUE = ". Remedy: ", " (value: "


def message_text(message: str) -> str:
    """Write a message of a stage in the language of the run.

    Examples
    --------
    >>> message_text("plate_001: must be positive (value: -1.0). Remedy: give a number above zero")
    'plate_001: must be positive (value: -1.0). Remedy: give a number above zero'
    """
    head, remedy_follows, remedy = message.partition(REMEDY)
    head, value_follows, value = head.partition(VALUE)
    text = _with_place(head)
    if value_follows:
        text += tr(" (value: {value})", value=value.removesuffix(")"))
    if remedy_follows:
        text += tr(". Remedy: {remedy}", remedy=translated(remedy, SENTENCES) or remedy)
    return text


def _with_place(head: str) -> str:
    """Write a message with the place before it; the place stays as it is."""
    parts = head.split(": ")
    for place in range(len(parts)):
        found = translated(": ".join(parts[place:]), SENTENCES)
        if found is not None:
            return ": ".join([*parts[:place], found])
    return flag_text(head)
