"""XML of strangers: read within limits, expanded and tried in processes of their own."""
