"""The inside of a fit: windows shot from states of their own, steps to the least, and doubts."""
