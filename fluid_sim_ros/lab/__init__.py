"""The speed-accuracy laboratory: charts, stability maps, and the advisor on settings."""
