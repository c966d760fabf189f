"""Many solutions or pictures: fits, sweeps, films, observables, plots and their reports."""
