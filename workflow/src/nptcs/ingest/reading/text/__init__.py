"""Text files: bytes to text, the way numbers are written, rows of cells, columns of numbers.

Bytes come in, cells and numbers go out. What a column is called, and its unit, is not judged
here.
"""
