"""A live view: sources of frames, a page in the browser, the desktop viewer."""
