"""What a control law is asked to hold, from what a pilot asks for."""
