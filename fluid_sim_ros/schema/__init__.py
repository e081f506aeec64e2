"""What scene, vehicle, sensor and weather files may say, and the settings of a run."""
