"""Fields and pictures of solved states: stresses, drawings, files for ParaView.

A solved spoke or tyre comes in; arrays of fields, figures or files go out. The only thing solved
here is each spoke of a tyre, again, at the motion that the tyre gives it.
"""
