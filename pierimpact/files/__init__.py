"""Case files and truck files."""
