"""Tables of others: columns with names and units, of text files, NetCDF and Python objects."""
