"""How uncertain a response is: materials, tolerances and surface, propagated to a distribution.

The material card, the configured tolerances and a study's solved cases come in; mean, standard
deviation, interval and the share of each test and tolerance go out. A response model is a fitted
surface with the effects of the ply and the rubbers (`response_model`, `fitted`). The solver's own
bias does not belong here: it is shown next to these numbers and is never added to them. No case is
solved.
"""
