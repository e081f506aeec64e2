"""What the laboratory solves: bodies with known solutions, and scenes."""
