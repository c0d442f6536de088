"""The explorer of the report: sliders, profiles and planes that compute in the reader's browser.

Stored surfaces with the tables of a run come in (`payload`), and each kind of surface is written
as the numbers that its prediction and its interval need (`models`); one block of the page with its
data, styles and scripts goes out (`markup`). Nothing is fitted, solved or rounded here, and no text
for the reader is written in a script: scripts take all texts from `words`.
"""
