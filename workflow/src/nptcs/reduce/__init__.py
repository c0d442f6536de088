"""From curves to properties (ASTM D3039, D6641, D3518, D412; ISO 527, 14129, 37).

One tidy curve and its specimen come in; rows of properties go out (`reduce_specimen`); groups of
them become statistics in `statistics.group_statistics`, which needs scipy and is therefore not
imported here. No file is read here, and no constant of a material card is fitted.
"""

from nptcs.reduce.specimen import reduce_record, reduce_specimen

__all__ = ["reduce_record", "reduce_specimen"]
