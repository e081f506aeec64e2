# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Closed forms at the bounds of benchmarks/plugins/plugin_closed_forms.py."""

import pytest

from benchmarks.plugins import plugin_closed_forms as bench


@pytest.fixture(scope='module')
def errors():
    return bench.measure()


@pytest.mark.parametrize('name', bench.BOUNDS)
def test_closed_form(errors, name):
    assert errors[name] <= bench.BOUNDS[name]
