"""The moments solver as fragment passes."""
