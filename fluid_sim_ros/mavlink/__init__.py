"""Bridges to autopilots in lockstep: PX4 over MAVLink HIL, ArduPilot over JSON."""
