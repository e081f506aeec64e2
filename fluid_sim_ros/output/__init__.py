"""Files that people read: HTML pages and JSON results."""
