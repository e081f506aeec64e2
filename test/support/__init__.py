"""What tests and benchmarks share: models, equations of motion, flights, processes."""
