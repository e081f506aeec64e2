"""ArduPilot: JSON over UDP, in lockstep led by the autopilot."""
