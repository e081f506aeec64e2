# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A browser's side of the page in a process of its own: prints how many pictures come a second."""

import json
import sys
import time

from test.support.view_client import client


def main() -> None:
    """Look at the page of an address for some seconds."""
    url, seconds = sys.argv[1], float(sys.argv[2])
    with client(url) as page:
        page.wait_for(lambda page: len(page.moved_at) > 0)
        print(json.dumps({'first_at': time.time()}), flush=True)
        before, begin = len(page.moved_at), time.monotonic()
        time.sleep(seconds)
        rate = (len(page.moved_at) - before) / (time.monotonic() - begin)
        print(json.dumps({'pictures_per_s': rate}), flush=True)


if __name__ == '__main__':
    main()
