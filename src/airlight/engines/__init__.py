"""Files for other programs: baked tables, environment maps, composition, named targets."""
