"""Live views of a planet: one declared list of parameters drives window, notebook and page."""
