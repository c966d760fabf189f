"""Interactive views of a planet: window, notebook and page share one list of parameters."""
