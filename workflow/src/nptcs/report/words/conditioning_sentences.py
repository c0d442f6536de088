"""What ingest did to the readings of a specimen, and what it noticed."""

from __future__ import annotations

from nptcs.language import translatable

SENTENCES = (
    # names of the steps
    translatable("pairing"),
    translatable("load cell"),
    translatable("axial strain"),
    translatable("transverse strain"),
    translatable("compliance"),
    translatable("extensometer"),
    translatable("dead channels"),
    translatable("spikes"),
    translatable("empty rows"),
    translatable("force zero"),
    translatable("end of test"),
    translatable("strain origin"),
    translatable("sign"),
    translatable("loading of one sign"),
    translatable("excursions"),
    # what they changed
    translatable("leaps from {force} N: {rows} rows cut"),
    translatable("stands still at {force} N: {rows} rows cut"),
    translatable("by the force in {file} (one of the files has no time)"),
    translatable("peak force from {file}"),
    translatable("by the edges of the trigger channel"),
    translatable("by the number of the frame"),
    translatable("by time, {way}"),
    translatable("stated in the sheet"),
    translatable("from the force that both recorded"),
    translatable("one clock, onsets of loading agree"),
    translatable("force {force} Hz, strain {strain} Hz"),
    translatable("column '{name}' over {length} mm"),
    translatable("column '{name}', {way} ({found})"),
    translatable("column '{name}'"),
    translatable("found: the larger one"),
    translatable("found: it follows the load"),
    translatable("travel - compliance × force"),
    translatable("no removal or slip found"),
    translatable("{channel} {what} at reading {reading}: emptied from there"),
    translatable("{sensor}: {channel} {what} at {value}, emptied from there"),
    translatable("extensometer removed or slipped"),
    translatable("transducer of travel slipped"),
    translatable("jumps"),
    translatable("moves back"),
    translatable("stands still"),
    translatable("removed {names}"),
    translatable("{count} readings emptied"),
    translatable("{rows} rows without force, {frames} frames without strain dropped"),
    translatable("{force} N subtracted"),
    translatable("no failure recorded, nothing cut"),
    translatable("failure is in the force file"),
    translatable("nothing of it is in these rows"),
    translatable("{rows} rows after failure cut"),
    translatable("not corrected: {reason}"),
    translatable("nothing shifted: {shift} ± {error} is not significant"),
    translatable("strain shifted by {shift} ± {error}, {rows} toe rows cut"),
    translatable("turned: {names}"),
    translatable("as recorded"),
    translatable("{count} readings in {name} left out"),
    translatable("emptied: {names}"),
    translatable("R² {value} is below the limit"),
    # flags of an ingest record
    translatable(
        "load cell saturated: the force stands still at {force} N while the specimen is "
        "stretched; cut from there, so neither strength nor failure is known"
    ),
    translatable(
        "the force leaps from {before} to {after} N while the strain goes on, and then grows "
        "as stiffly as before: the load cell was probably set to zero again; cut from there, "
        "so neither strength nor failure is known"
    ),
    translatable(
        "the force leaps from {before} to {after} N while the strain goes on, and then grows "
        "at {factor} times that scale: its range was probably switched; cut from there, so "
        "neither strength nor failure is known"
    ),
    translatable(
        "column '{name}' in {unit}: read in metric tons (9806.65 N), since the other columns "
        "are metric"
    ),
    translatable("{count} wild readings emptied: {names}"),
    translatable("readings that jump away and back were emptied: {names}"),
    translatable(
        "machine area {area} mm² differs from the sheet's {ours} mm²; the sheet's was used"
    ),
    translatable(
        "{name} in {file} is {value} {its_unit}, in the sheet {ours} {unit}; the sheet's was used"
    ),
    translatable("recorded in {name}, too (to {force} N, strain {strain}); that part was left out"),
    translatable(
        "the load cell reads {before} N before loading and {after} N after the break: it was "
        "probably not tared; ingest: force_zero subtracts it"
    ),
    translatable(
        "column '{name}' was left out: it grows with the axial strain ({ratio} times), which "
        "no contraction does; if it is one written as positive, state transverse_factor -1 in "
        "the sheet"
    ),
)
"""The sentences, as the stages write them; ``{…}`` stands for what differs."""
