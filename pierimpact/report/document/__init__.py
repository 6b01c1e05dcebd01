"""What a sheet is made of: text, mathematics, tables, equations and figures."""
