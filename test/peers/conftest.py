"""A small part of benchmarks/peer_simulators.py, with what of the peers is installed."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / 'benchmarks'))
