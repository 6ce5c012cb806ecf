"""Maps of a study's rows over the table, by matplotlib, which is asked for only when one is drawn."""
