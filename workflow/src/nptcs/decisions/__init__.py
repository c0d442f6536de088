"""Which design meets the goals: search, probability, desirability, conflict, confirmation.

Goals (`nptcs.config.studies.goals`) and the solved cases of a study come in; designs that meet them
with the stated probability go out, or the reason why there is none. Responses are predicted by
`nptcs.uncertainty` models; only `confirm` solves cases. What the report shows of it does not
belong here.
"""
