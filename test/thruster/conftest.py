"""The thruster tests share the benchmarks' model builder (benchmarks/thruster_common.py)."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / 'benchmarks'))
