"""The risk from traffic: how often a year a truck strikes the pier, and how hard."""
