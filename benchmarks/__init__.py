# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Benchmarks, by subject: one module a question, run as ``python -m benchmarks.SUBJECT.NAME``.

From the top folder, which is where ``benchmarks`` and ``test.support`` are found.
"""
