"""Files that store numbers rather than text: workbooks, LabVIEW's and MATLAB's files.

Bytes come in; the same rows of cells go out as from a text file. Names and units are read by the
same rooms as those of text files.
"""
