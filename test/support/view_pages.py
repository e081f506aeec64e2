# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Pages of the live view, opened for a test."""

import threading
from contextlib import contextmanager

from fluid_sim_ros.view.web.page import Page


@contextmanager
def opened(source, port=0):
    """Give a page of a source that runs."""
    page = Page(source, '127.0.0.1', port)
    loop = threading.Thread(target=source.run)
    loop.start()
    page.start()
    try:
        yield page
    finally:
        source.stop()
        loop.join()
        page.close()


def time_of(browser):
    """Return the simulated time that the page shows [s]; -1: none yet."""
    text = next((text for text in browser.texts() if 't = ' in text), 't = -1 s')
    return float(text.split('t = ')[1].split(' s')[0])
