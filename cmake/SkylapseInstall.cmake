# Filled below once the folders exist.
