"""Files that hold numbers and not text: workbooks, LabVIEW's and MATLAB's files.

Bytes come in, the same rows of cells go out as from a text file. Names and units are read by the
rooms that read those of text files.
"""
