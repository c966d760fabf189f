"""Matter of a constituent: gases, particles, absorbers, profiles, phase functions."""
