"""The document a sheet is: text, mathematics, tables, equations and figures, as data."""
