"""Running a log's flight again: the same to the bit, or with a change."""
