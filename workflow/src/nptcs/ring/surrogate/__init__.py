"""Spokes that nobody has solved: their energy predicted from those of other spokes, with its error.

Energy tables come in (`collect`), a sealed model and predicted tables go out. A chosen design is
always confirmed with a spoke that was solved.
"""
