"""Files that lie: made by mutation of honest ones and from scratch, and a judge of what became."""
