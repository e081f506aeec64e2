"""Effects of a model by the error to a flight and what they cost."""
