"""What stands behind the explorers and the exercises of the teaching notebooks."""
