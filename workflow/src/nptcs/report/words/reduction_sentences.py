"""How the reduction found a property, over which range, or why it has no value."""

from __future__ import annotations

from nptcs.language import translatable

SENTENCES = (
    # rules: how a property was found
    translatable("{rules}; mean of {count}, {test} {angle} degrees"),
    translatable("{standard} chord, {method}"),
    translatable("{rule} at strain {strain}"),
    translatable("{rule} at failure"),
    translatable("{standard}, B_y = 100 (e1 - e2)/(e1 + e2)"),
    translatable("{rule}, least squares up to the peak"),
    translatable("{rule}, first row to the peak"),
    translatable("{standard}, from the curve"),
    translatable("{rule}, corrected for large deflection"),
    translatable("{standard}, largest force, {bar}"),
    translatable("{standard}, largest force"),
    translatable("{standard}, strain at the largest force"),
    translatable("{standard}, interpolated at {percent} %"),
    translatable("{standard}, stress over strain at {percent} % compression"),
    translatable("{standard}, trapezoid rule up to the peak"),
    translatable("{standard}, offset {strain}"),
    translatable("{standard}, largest stress up to shear strain {strain}"),
    translatable("{count} points"),
    translatable("span {span} mm"),
    translatable("loading span {span} mm"),
    # ranges
    translatable("{low} to {high} % of the ultimate strain (below {limit})"),
    translatable("shear {range}"),
    translatable("strain {low} to {high}"),
    translatable("up to the largest force"),
    # why a property is not assessed, and what a reader should know of it
    translatable("no transverse strain"),
    translatable("the curve reaches {reached}"),
    translatable("the curve ends before strain {strain}"),
    translatable("the curve ends at {strain}, before {high}"),
    translatable("the curve begins at {percent} %"),
    translatable("the curve begins at {strain}, after {low}"),
    translatable("the curve begins after {limit}"),
    translatable("fewer than two recorded points"),
    translatable("fewer than three recorded points in the range"),
    translatable("both ends of the range fall on the same recorded point"),
    translatable("the recorded point nearest to {end} is {value}"),
    translatable("the curve goes back by {drop} inside the range"),
    translatable("the strain leaps by {size} at {strain}, within the range: a slip"),
    translatable(
        "the curve stiffens by a factor of {ratio} within the range: slack or a toe remains"
    ),
    translatable("the curve stiffens by {share} within the range: a toe may remain"),
    translatable(
        "the curve is {share} % steeper above the range (strain {low} to {high}) than within "
        "it: a toe may reach into the range"
    ),
    translatable("the standard defines no offset strength"),
    translatable("no shear modulus"),
    translatable("shear strain needs axial and transverse strain"),
    translatable("not reached before shear strain {strain}"),
    translatable("at shear strain {strain}, beyond {limit}"),
    translatable("cut at shear strain {limit}: the stress was still rising"),
    translatable("strain recorded up to {strain} only, the force rose further"),
    translatable("strain recorded up to {strain} only"),
    translatable("strain on one face only"),
    translatable("no compressive strain recorded there"),
    translatable("bending {value} % beyond {limit} %"),
    translatable("{reason} (bending not assessed)"),
    translatable("strain is the mean of both faces, bending {share}"),
    translatable("strain ends at {strain}: {chord} than {range}"),
    translatable("strain begins at {strain}: {chord} than {range}"),
    translatable("chord over another range"),
    translatable("ultimate strain not known, so it may be below {limit}"),
    translatable("failure as the sheet states it"),
    translatable("stopped before failure, as the sheet states"),
    translatable(
        "{state}: the force record ends at its largest value, long after the gauge was taken "
        "off (counts only if the sheet states failed: yes)"
    ),
    translatable("failure not recorded"),
    translatable("no failure seen in force and travel"),
    translatable("no failure seen ({detail})"),
    translatable("no load"),
    translatable("the force never falls by {share} of its largest value"),
    translatable("unloaded: force and strain go back together"),
    translatable("force and strain go back together in {readings}"),
    translatable("so few readings that a break and a return of the machine look alike"),
    translatable(
        "{fall} and the strain returns at one speed: a break, or a machine that returns with "
        "a softened specimen"
    ),
    translatable("{fall}, slowly, and without a strain it is not clear whether by unloading"),
    translatable("the force falls by {share} % of its largest value"),
    translatable("the force relaxes at a held strain"),
    translatable("no usable times"),
    translatable("the loading that was taken is not the one that broke"),
    translatable("the strain ends before the largest force"),
    translatable("{value} {unit} is outside {low} to {high}"),
    translatable("large deflection not assessed: no strain there"),
    translatable("large deflection not assessed: the strain is not that of a deflection"),
    translatable("{deflection}: {standard} gives no correction for this loading"),
    translatable("{deflection}: stress multiplied by {factor}"),
    translatable("deflection {share} of the span"),
    translatable(
        "span to thickness {ratio}, {standard} expects {low} to {high}: shear lowers the "
        "modulus of a short span"
    ),
    translatable("loading span {share} of the span, {standard} specifies {allowed}"),
    translatable("{count} loadings in the record, {name} taken"),
    translatable("the first"),
    translatable("number {number}"),
    translatable("it begins at strain {strain} under {share} % of its load"),
    translatable("strain counted from the set of {strain} that the earlier loadings left"),
    # notes on groups
    translatable("no B-basis: not above zero, n = {n} is too few for this scatter"),
    translatable("standard deviation pooled over {count} groups, {free} degrees of freedom"),
    translatable("equal variances p = {p}"),
    translatable("equal means p = {p}"),
    translatable("the variances differ: do not pool"),
    translatable("the means differ: one mean for all is wrong"),
)
"""The sentences, as the stages write them; ``{…}`` stands for what differs."""
