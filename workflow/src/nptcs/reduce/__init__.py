"""From curves to properties (ASTM D3039, D6641, D3518, D412; ISO 527, 14129, 37).

`nptcs.reduce.specimen.reduce_specimen` needs numpy and pandas alone;
`nptcs.reduce.statistics.group_statistics` needs scipy and is therefore not imported here.
"""

from nptcs.reduce.specimen import reduce_record, reduce_specimen

__all__ = ["reduce_record", "reduce_specimen"]
