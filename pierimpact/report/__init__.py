"""The report: the calculation of a case, its sheet, and the files written from it."""
