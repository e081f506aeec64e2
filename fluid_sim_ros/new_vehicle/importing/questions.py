# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What an imported file leaves undecided: asked for in one list, not guessed."""

from pathlib import Path

from fluid_sim_ros.errors import ConfigError


class UndecidedError(ConfigError):
    """
    Something that only the user can say is missing.

    Parameters
    ----------
    path
        The file that is imported.
    questions
        A line each. Kept as an attribute.

    """

    def __init__(self, path: Path, questions: list[str]) -> None:
        count = 'one thing is' if len(questions) == 1 else f'{len(questions)} things are'
        super().__init__(f'{path}: {count} undecided: {"; ".join(questions)}')
        self.path = path
        self.questions = questions
