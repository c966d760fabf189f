"""The moments solver as passes of fragments."""
