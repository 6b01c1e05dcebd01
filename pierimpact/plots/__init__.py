"""Figures, drawn with matplotlib from results that are already computed."""
