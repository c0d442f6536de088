"""Energy tables of spokes that were not solved, predicted from solved ones, with their errors.

Energy tables come in (`collect`); a sealed model and predicted tables go out. A chosen design is
always confirmed with a solved spoke.
"""
