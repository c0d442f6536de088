"""One contract for each table that crosses a file boundary."""
