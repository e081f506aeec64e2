"""Stand-ins for autopilots, readers of what goes over the wire, recordings of real ones."""
