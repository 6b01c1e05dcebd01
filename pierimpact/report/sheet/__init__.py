"""The calculation sheet: its blocks, and what they say of a case."""
