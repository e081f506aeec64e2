"""A node as a process: its command line, signals, executor thread, and an orderly end."""
