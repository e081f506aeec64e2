# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where the folders of the repository are."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MODELS = ROOT / 'models'
DOC = ROOT / 'doc'
