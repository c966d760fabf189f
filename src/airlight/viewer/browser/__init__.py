"""The page and the notebook widget."""
