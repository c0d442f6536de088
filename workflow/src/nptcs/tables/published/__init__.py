"""Contracts of published numbers, and of what compares computed results with them.

The paper's tables as they come in, and the differences that go out. The comparison itself is made
in `nptcs.compare`.
"""
