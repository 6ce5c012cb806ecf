"""Engines: somebody else's workers, to whom shares of rows are sent, and what a worker does."""
