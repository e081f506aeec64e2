"""The model of a log: its files gathered, kept apart from the disk, and loaded for a trial."""
