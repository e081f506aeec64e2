# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Reads the text files of an egg-info folder."""


def sections(text):
    """Split an egg-info file into its [sections]; lines before the first are under ''."""
    found, name = {'': []}, ''
    for line in filter(None, text.splitlines()):
        if line.startswith('['):
            name = line.strip('[]')
            found[name] = []
        else:
            found[name].append(line)
    return found
