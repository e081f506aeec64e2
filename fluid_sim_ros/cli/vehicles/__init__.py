"""Commands that make vehicles and their coefficients."""
