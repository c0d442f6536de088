"""The first screen of the report: what came out, in a few sentences with a small figure each.

`nptcs.report.data.Results` comes in, one `Finding` per question goes out: the stiffness, what
governs it, the recommended design, the agreement with published results, the tests behind it. Each
module answers one question from the result tables, and says what is not assessed where a table has
no answer. Tables and figures of the sections do not belong here.
"""
