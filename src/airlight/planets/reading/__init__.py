"""From a planet's text file to parameter objects."""
