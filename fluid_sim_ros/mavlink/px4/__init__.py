"""PX4: MAVLink HIL over TCP, in lockstep led by the simulation."""
