# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which parameters of a slow test `make test` takes; `make test-full` takes all of them."""

import pytest


def quick(params, *chosen):
    """Return the parameters of a test, those that are not among the chosen marked ``full``."""
    params = list(params)
    assert set(chosen) <= set(params), 'a chosen parameter is none of the test'
    return [p if p in chosen else pytest.param(p, marks=pytest.mark.full) for p in params]
