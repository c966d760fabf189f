"""Pictures of a solution on a GPU."""
