"""HTML page and notebook widget."""
