"""Messages and remedies where a specimen's files cannot be read, without their values."""

from __future__ import annotations

from nptcs.language import translatable

# the more specific ones come before those whose placeholders would match them
SENTENCES = (
    translatable("this raw file does not exist"),
    translatable("correct the file name in the specimen sheet, or copy the file into its folder"),
    translatable("the same data as specimen {first}"),
    translatable("name the right file, or set include to no; it is not counted twice"),
    translatable("state the unit in a profile, or check that both files belong to one specimen"),
    translatable("force in {unit} does not follow the machine's force"),
    translatable(
        "state its unit in a profile under 'wrong_units', or leave the force column out of the "
        "profile and give time_offset_s in the sheet"
    ),
    translatable(
        "largest force is {theirs} N (read as {unit}) here and {ours} N (read as {machine}) "
        "in {file}"
    ),
    translatable(
        "check the force units (profile: wrong_units), or that both belong to one specimen; "
        "pairing.force_tolerance is the allowed difference"
    ),
    translatable("the file calls itself {own} ({where}: '{words}'), the sheet says {test}"),
    translatable("correct test in the sheet, or state the loading in a profile ('loading')"),
    translatable(
        "strain and force cannot be paired: the files share neither time nor force, and no "
        "trigger or frame number that fits"
    ),
    translatable("export the time in both, or the force as an analog channel in the strain file"),
    translatable("give time_offset_s in the sheet, or check that both belong to one specimen"),
    translatable("loading begins at {theirs} s here and at {ours} s in {file}"),
    translatable("give time_offset_s in the sheet (about {seconds})"),
    translatable("{name} does not rise from its start to its peak: no onset of loading"),
    translatable("give time_offset_s in the sheet, or check the column"),
    translatable(
        "force ({force}) and stress ({stress}) of the file give an area of {area} mm², the "
        "sheet {ours} mm²"
    ),
    translatable("correct the area in the sheet, or the unit by a profile's wrong_units"),
    translatable(
        "no unit for strain, and its largest reading {largest} may be a strain or a percentage"
    ),
    translatable(
        "state the unit in a profile under 'units' ('1' or '%') and name the profile in the sheet"
    ),
    translatable(
        "check test, strain_axis and the files of this specimen in the sheet; if the gauge "
        "writes a lengthening as negative, state strain_factor -1"
    ),
    translatable(
        "force is negative (down to {least} N): a {test} test that the file records as compression"
    ),
    translatable(
        "correct test in the sheet; if the machine writes tension as negative, state "
        "force_factor -1 in the sheet"
    ),
    translatable("use '{first}' or '{second}'"),
    translatable("gauge_length_mm is empty: {name} cannot become strain"),
    translatable("give the gauge length (grip distance for crosshead travel) in the sheet"),
    translatable("the axial strain cannot be told from the data: {found}"),
    translatable("name the column as strain_axis in the sheet"),
    translatable("strain_axis is '{axis}', but the other strain is larger: {found}"),
    translatable("correct strain_axis, or leave it empty"),
    translatable("'{name}' fits several columns for {quantity}: {choices}"),
    translatable("table has {found} columns, profile '{profile}' names {count}"),
    translatable("correct columns_in_order"),
    translatable(
        "no column for {wanted} by profile '{profile}'; columns: {found}; several may be it: "
        "{names}"
    ),
    translatable(
        "no column for {wanted} by profile '{profile}'; columns: {found}; {names} may be it, "
        "but its unit is not known"
    ),
    translatable("no column for {wanted} by profile '{profile}'; columns: {found}"),
    translatable(
        "name another profile in the sheet, or write one: nptcs inspect FILE --write-profile"
    ),
    translatable("the file holds {count} tests"),
    translatable("name one of {labels} as force_part or strain_part in the sheet"),
    translatable("no table of five rows or more"),
    translatable("export the raw data"),
    translatable("the table of {width} columns has no names"),
    translatable("write a profile with columns_in_order and units, and name it in the sheet"),
    translatable("no unit for {quantity}"),
    translatable(
        "state it in a profile under 'units' ({choices}) and name the profile in the sheet"
    ),
    translatable(
        "the column's name contains a factor, '{factor}': whether the readings still have to be "
        "multiplied by it cannot be told"
    ),
    translatable(
        "write the factor of the readings as {key} in the sheet, 1 if they are right as they are"
    ),
    translatable("which ton is meant is not known: metric 9806.65 N, US 8896.44 N or UK 9964.02 N"),
    translatable(
        "state 'tf', 'US ton' or 'UK ton' in a profile under 'wrong_units', and name the "
        "profile in the sheet"
    ),
    translatable("two units for {quantity}: {named} in its name, {stated} in the row of units"),
    translatable(
        "state the right one in a profile under 'wrong_units', and name the profile in the sheet"
    ),
    translatable("not a unit of {quantity}"),
    translatable("state the right one in a profile under 'wrong_units': {choices}"),
    translatable("row inside a table does not consist of numbers"),
    translatable("correct or delete the row"),
    translatable("only some rows of the table have a time of day"),
    translatable("correct the row"),
    translatable("{width} columns, but {first} names: it is not clear which column has no name"),
    translatable("state unnamed_columns (first or last) in a profile"),
    translatable("row has {first} cells, the next one {second}"),
    translatable("complete or delete the row"),
    translatable("a number in {unit}, where the column's unit is {stated}"),
    translatable("export the column in one unit"),
    translatable("cannot be read: it holds no columns of numbers"),
    translatable("export it again"),
    translatable("sheet '{sheet}': cell is not a number"),
    translatable("store numbers as numbers, not as text or dates"),
    translatable("sheet '{sheet}': column {name} holds formulas without stored values"),
    translatable("open and save it in a spreadsheet"),
    translatable("is a packed archive (ZIP), not a workbook"),
    translatable("workbook cannot be read: {reason}"),
    translatable("open and save it again, without a password"),
    translatable("is a page of HTML or XML, not a table"),
    translatable("open it in a spreadsheet and save it as XLSX or CSV"),
    translatable("check the name in the sheet"),
    translatable("several formats fit and read different values: {names}"),
    translatable("name one of them as force_format or strain_format in the sheet"),
    translatable("name another profile in the sheet"),
    translatable("number is too large"),
    translatable("correct the file"),
    translatable("correct the file, or name the word in the profile's 'missing'"),
    translatable("is not text in a known encoding"),
    translatable("state it in a profile"),
    translatable("state the right encoding in the profile"),
    translatable(
        "name a profile that states 'decimal' (and 'thousands') in the sheet's force_format "
        "or strain_format"
    ),
    translatable("no table of numbers found"),
    translatable(
        "check that the raw data were exported, not only the results; numbers need one "
        "decimal mark and one delimiter"
    ),
    translatable("force is empty or zero throughout"),
    translatable("check the force column in the file"),
    translatable("only {measured} rows hold {what}"),
    translatable("check the columns of the files (nptcs inspect FILE)"),
    translatable("holds {count} frames"),
    translatable("export one file per frame"),
    translatable("two files have the same frame number"),
    translatable("remove one of them"),
    translatable("no frame number in the names"),
    translatable("name the files by frame"),
    translatable("no point lies in the window"),
    translatable("correct the profile's window"),
)
