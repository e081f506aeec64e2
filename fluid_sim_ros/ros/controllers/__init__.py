"""Example controllers: nodes that close a loop over topics."""
