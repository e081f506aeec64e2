"""The program of an autopilot as a child: its arguments, its output, its end."""
