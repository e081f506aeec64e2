# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest


@pytest.fixture
def rng():
    return np.random.default_rng(7)


@pytest.fixture(autouse=True)
def _no_numpy_warnings():
    """Fail any test in which numpy would have warned (0/0, overflow, invalid)."""
    with np.errstate(divide='raise', over='raise', invalid='raise'):
        yield
