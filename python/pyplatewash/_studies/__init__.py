"""Studies: how the rows that are missing come to their folder (`run`, by `engines`), and what is read there (`rows`)."""
