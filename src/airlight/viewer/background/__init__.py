"""Threads that solve in the background of the edits."""
