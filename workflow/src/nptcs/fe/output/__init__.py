"""Fields and pictures of solved states: stresses, drawings, files for ParaView.

A solved spoke or tyre comes in, arrays of fields, figures or files' text go out. Nothing is solved.
"""
