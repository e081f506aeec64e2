"""Flights of real vehicles, by any software, in one form: signals with time, unit and axes."""
