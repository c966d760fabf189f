"""What a constituent is made of: gases, particles, absorbers, profiles, phase functions."""
