# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Draws a mapping that a schema takes, from the schema itself: a new key is drawn at once."""

import types
import typing
from collections.abc import Callable, Mapping
from typing import Any

import annotated_types as bounds

from fluid_sim_ros.schema.base import Strict
from test.support.hostile.models.draw import Draw

#: A value by the name of the schema and of the key: takes what draws, and the mapping so far.
Rule = Callable[[Draw, Mapping[str, Any]], Any]
#: Share of the keys that may be left out, that are there.
_SHARE = 0.4
#: In place of a value: the key is left out.
ABSENT = object()


class SchemaDraw:
    """
    Draws mappings of schemas.

    Parameters
    ----------
    draw
        Of a seed.
    rules
        What no type says, by ``Schema.key``; a schema's own rule takes its whole mapping.

    Attributes
    ----------
    keys
        Which keys of which schemas have been drawn, as ``Schema.key``.

    """

    def __init__(self, draw: Draw, rules: Mapping[str, Rule]) -> None:
        self._draw, self._rules = draw, rules
        self.keys: set[str] = set()

    def mapping(self, schema: type[Strict], *without: str) -> dict[str, Any]:
        """
        Return a mapping of a schema.

        Parameters
        ----------
        schema
            Its type.
        *without
            Keys that are left out.

        """
        found: dict[str, Any] = {}
        for key, field in schema.model_fields.items():
            if key in without or not (field.is_required() or self._draw.yes(_SHARE)):
                continue
            value = self._key(schema, key, field, found)
            if value is not ABSENT:
                found[key] = value
        if whole := self._rule(schema, ''):
            found = whole(self._draw, found)
        self.keys |= {f'{schema.__name__}.{key}' for key in found}
        return found

    def _rule(self, schema: type[Strict], key: str) -> Rule | None:
        """Return the rule of a key, or of a whole mapping; that of the nearest parent."""
        for each in schema.__mro__:
            name = f'{each.__name__}.{key}' if key else each.__name__
            if name in self._rules:
                return self._rules[name]
        return None

    def _key(self, schema: type[Strict], key: str, field: Any, found: dict[str, Any]) -> Any:
        if rule := self._rule(schema, key):
            return rule(self._draw, found)
        try:
            return self._value(field.annotation, list(field.metadata))
        except NotImplementedError as error:
            raise NotImplementedError(
                f'{schema.__name__}.{key}: {error}; it needs a rule'
            ) from None

    def _value(self, kind: Any, limits: list[Any]) -> Any:
        draw, origin, inner = self._draw, typing.get_origin(kind), typing.get_args(kind)
        if origin is typing.Annotated:
            return self._value(inner[0], [*limits, *inner[1:]])
        if origin in (typing.Union, types.UnionType):
            return self._value(
                draw.choice([one for one in inner if one is not type(None)]), limits
            )
        if origin is typing.Literal:
            return draw.choice(inner)
        limits = [each for limit in limits for each in getattr(limit, 'metadata', [limit])]
        if origin is list:
            least = max(
                [each.min_length for each in limits if isinstance(each, bounds.MinLen)] + [0]
            )
            most = min(
                [each.max_length for each in limits if isinstance(each, bounds.MaxLen)] + [4]
            )
            count = draw.randrange(least, max(least, most) + 1)
            return [self._value(inner[0], []) for _ in range(count)]
        if isinstance(kind, type) and issubclass(kind, Strict):
            return self.mapping(kind)
        if kind is bool:
            return draw.yes()
        if kind is int:
            low, high = _ends(limits, 0, 50)
            return draw.randrange(int(low), int(min(high, low + 200)) + 1)
        if kind is float:
            return self._number(limits)
        raise NotImplementedError(f'nothing is known of {kind}')

    def _number(self, limits: list[Any]) -> float:
        draw = self._draw
        low, high = _ends(limits, -float('inf'), float('inf'))
        if high < float('inf') and low > -float('inf'):
            return draw.uniform(low + 1e-9 * (high - low), high - 1e-9 * (high - low))
        if low > -float('inf'):
            strict = any(isinstance(each, bounds.Gt) for each in limits)
            return low + (draw.size(1e-3, 100) if strict else draw.zero_or_size(1e-3, 10))
        return draw.gauss(0, 2)


def _ends(limits: list[Any], low: float, high: float) -> tuple[float, float]:
    for each in limits:
        low = getattr(each, 'ge', getattr(each, 'gt', low))
        high = getattr(each, 'le', getattr(each, 'lt', high))
    return low, high
