"""Files of cases, of trucks and of what else a user gives, read and written."""
