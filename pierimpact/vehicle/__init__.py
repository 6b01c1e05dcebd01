"""The truck and the crush law of its springs."""
