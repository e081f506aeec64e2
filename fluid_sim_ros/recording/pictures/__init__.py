"""Pictures of a log: plots, films and a page to read."""
