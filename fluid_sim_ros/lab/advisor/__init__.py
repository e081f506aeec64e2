"""The advisor: the cheapest setting of a scene that is accurate enough."""
