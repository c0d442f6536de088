"""What each factor does to a response: average gradients, impact values, Sobol indices, ties.

Fitted surfaces come in; indices and rankings go out. Nothing is fitted here.
"""
