"""The medium without a body: its density, wind and current, turbulence and waves."""
