"""English sentences that tables and stages write, translated into the language of the page.

A flag, a message or the name of a surface comes in as the tables have it; its translation with the
same numbers goes out. Texts that the report itself writes are translated where they are written.
"""
