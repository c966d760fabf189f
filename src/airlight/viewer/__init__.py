"""The viewer: one declared list of parameters, shown in a window, a notebook and a page."""
