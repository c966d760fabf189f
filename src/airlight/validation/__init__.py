"""Validation: what airlight computes, held against authorities, as a report that shows it."""
