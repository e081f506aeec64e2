"""The inside of a fit: windows shot from states of their own, steps, delays, and doubts."""
