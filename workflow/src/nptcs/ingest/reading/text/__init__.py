"""Text files: bytes to text, the way numbers are written, rows of cells, columns of numbers.

Bytes come in; cells and numbers go out. The names of columns and their units are not judged here.
"""
