"""Charts of the laboratory, as pictures and pages."""
