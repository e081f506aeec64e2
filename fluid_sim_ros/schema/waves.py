# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The YAML schema of a scene's ``waves:``, and the keys of fluid_sim.medium that say the same."""

from typing import Annotated, Literal

from pydantic import Field, model_validator

from fluid_sim_ros.schema.base import NotNegative, Number, Positive, Strict

Direction = Annotated[list[Number], Field(min_length=2, max_length=2)]


class Waves(Strict):
    """
    Waves on the free surface; doc/waves.md.

    ``model`` ``regular``: ``height`` (trough to crest) [m] and ``period`` [s]. ``jonswap``: a
    random sea, ``height`` the significant one and ``period`` that of the peak. ``direction`` of
    travel (world x y), ``depth`` of the bed below the mean surface [m]; the others as the keys of
    fluid_sim.medium. Without ``seed`` that of the simulation holds.
    """

    model: Literal['regular', 'jonswap']
    height: NotNegative
    period: Positive
    direction: Direction = [1.0, 0.0]
    depth: Positive | None = None
    gamma: Annotated[Number, Field(ge=1, le=10)] | None = None
    spreading: NotNegative | None = None
    components: Annotated[int, Field(ge=1, le=10000)] | None = None
    repeat: Positive | None = None
    cutoff: Annotated[Number, Field(gt=1, le=100)] | None = None
    seed: Annotated[int, Field(ge=0, le=2**53)] | None = None

    @model_validator(mode='after')
    def _of_the_model(self) -> 'Waves':
        if not any(self.direction):
            raise ValueError('direction must not be 0 0')
        for key in ('gamma', 'spreading', 'components', 'repeat', 'cutoff', 'seed'):
            if self.model == 'regular' and getattr(self, key) is not None:
                raise ValueError(f'{key} is for jonswap only')
        return self

    def keys(self, seed: int) -> dict[str, str]:
        """
        Return the keys of fluid_sim.medium.

        Parameters
        ----------
        seed
            Of the simulation; for waves that state none.

        Returns
        -------
        dict
            Key -> value as MJCF has it.

        """
        words: list[str | float] = [self.model, self.height, self.period]
        if self.gamma is not None:
            words.append(self.gamma)
        keys = {'waves': _text(*words), 'wave_direction': _text(*self.direction)}
        if self.depth is not None:
            keys['water_depth'] = _text(self.depth)
        for key in ('spreading', 'components', 'repeat', 'cutoff'):
            value = getattr(self, key)
            if value is not None:
                keys[f'wave_{key}'] = _text(value)
        if self.model == 'jonswap':
            keys['wave_seed'] = str(seed % 2**53 if self.seed is None else self.seed)
        return keys


def _text(*values: str | float) -> str:
    return ' '.join(value if isinstance(value, str) else repr(value) for value in values)
