"""Many piers and many trucks: the work for processes of a machine, or for a cluster."""
