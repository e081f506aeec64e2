"""Charts: what accuracy costs, for every model, integrator and timestep of a problem."""
