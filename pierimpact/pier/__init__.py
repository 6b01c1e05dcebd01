"""The pier: cross-sections, the column, its member forces, and the equivalent pier."""
