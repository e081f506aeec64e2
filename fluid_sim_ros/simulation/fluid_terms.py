# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Which fluid terms can act on the vehicles of a scene, and what a user must hear of it.

A vehicle that feels no fluid moves as in vacuum, and its numbers look sound: it is said at load.
"""

from collections.abc import Callable, Iterable, Mapping

import mujoco

from fluid_sim_ros.errors import CommandError, ConfigError, listed
from fluid_sim_ros.plugins.acting import acting_terms, terms_together
from fluid_sim_ros.plugins.config import MEDIUM, THRUSTER, medium_of, plugin_instances
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.scene.vehicle import Vehicle

#: Does not depend on the velocity of the fluid.
_AT_REST = ('buoyancy',)
#: Bodies that feel nothing are worth a word when they make up more than this share of the mass:
#: a control surface whose forces stand on the wing has next to none.
_NOTABLE_SHARE = 1e-3
#: From this density on [kg/m^3] a fluid is a liquid, in which buoyancy is no small force: the
#: lightest one at room temperature, isopentane, has 616, the heaviest gas of air's kind 12.
_LIQUID = 100.0
_REMEDY = (
    'give its bodies the plugin fluid_sim.body, or their geoms fluidshape="ellipsoid" '
    '(doc/plugins.md)'
)


class FluidTerms:
    """
    The terms that can act on each moving body of a model, known at load.

    Parameters
    ----------
    model, data
        The compiled model and data of it; the state does not matter and stays.
    vehicles
        Vehicles by name.

    Attributes
    ----------
    of_vehicles
        Vehicle name -> names of the terms that can act on any of its bodies.
    feel_flow
        Whether wind or current can act on any moving body, or on a thruster.

    """

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, vehicles: Mapping[str, Vehicle]
    ) -> None:
        self._model = model
        moving = [body for body in range(1, model.nbody) if model.body_treeid[body] >= 0]
        self._acting = acting_terms(model, moving, data)
        self._parts = {
            name: [body for body in moving if _is_below(model, body, vehicle.body_id)]
            for name, vehicle in vehicles.items()
        }
        self.of_vehicles = {
            name: terms_together({body: self._acting[body] for body in parts})
            for name, parts in self._parts.items()
        }
        self.feel_flow = _thrusters_feel_flow(model) or any(
            term not in _AT_REST for terms in self._acting.values() for term in terms
        )

    def warnings(self) -> list[str]:
        """Return one line for each vehicle or free body on which a fluid of the scene fails."""
        fluid = _fluid_of(self._model)
        if not fluid:
            return []
        lines = []
        for name, parts in self._parts.items():
            if parts and not self.of_vehicles[name]:
                lines.append(
                    f"vehicle '{name}': no fluid acts on it, though the scene has {fluid}: it "
                    f'moves as in vacuum; {_REMEDY}'
                )
            else:
                lines += self._dry_parts(name, parts) + self._not_buoyant(name, parts)
        return lines + self._dry_scenery(fluid)

    def _dry_parts(self, name: str, parts: list[int]) -> list[str]:
        model = self._model
        dry = [body for body in parts if not self._acting[body]]
        whole = float(sum(model.body_mass[body] for body in parts))
        share = float(sum(model.body_mass[body] for body in dry)) / whole if whole else 0.0
        if share <= _NOTABLE_SHARE:
            return []
        return [
            f"vehicle '{name}': no fluid acts on {len(dry)} of its {len(parts)} bodies: "
            f'{listed(_named(model, dry))} ({share:.1%} of its mass); if they should feel it, '
            f'{_REMEDY}'
        ]

    def _not_buoyant(self, name: str, parts: list[int]) -> list[str]:
        model = self._model
        density = _density_everywhere(model)
        if density < _LIQUID or not model.opt.gravity.any() or not parts:
            return []
        if 'buoyancy' in self.of_vehicles[name] or model.body_gravcomp[parts].any():
            return []
        return [
            f"vehicle '{name}': no buoyancy acts on it in a density of {density:g} kg/m^3: the "
            'fluid forces of MuJoCo have none, so it sinks with its whole weight; give its bodies '
            'fluid_sim.body with their volume, or gravcomp="displaced mass over mass"'
        ]

    def _dry_scenery(self, fluid: str) -> list[str]:
        model = self._model
        ours = {body for parts in self._parts.values() for body in parts}
        free = [
            int(model.jnt_bodyid[joint])
            for joint in range(model.njnt)
            if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE
        ]
        dry = [body for body in free if body not in ours and not self._acting[body]]
        if not dry:
            return []
        return [
            f'free bodies beside the vehicles: no fluid acts on {listed(_named(model, dry))}, '
            f'though the scene has {fluid}; {_REMEDY}'
        ]


def no_flow_line(stream: str) -> str:
    """
    Return why a wind or current would be without effect, and what to do.

    Parameters
    ----------
    stream
        ``wind`` or ``current``.

    Returns
    -------
    str
        The tail of an error or warning.

    """
    return (
        f'no body of the model feels the {stream}: give the model a density (in <option>, or a '
        f'{MEDIUM}), and its bodies a drag: fluidshape="ellipsoid" or fluid_sim.body '
        '(doc/plugins.md)'
    )


def check_flows(scene: Scene, unfelt: Callable[[str], None]) -> None:
    """
    Refuse winds and currents of a scene's file that no body feels.

    Parameters
    ----------
    scene
        As its file states it.
    unfelt
        Says what is to be said of a stream, or refuses it.

    Raises
    ------
    ConfigError
        For the first such key of the file.

    """
    flows = {'wind': scene.wind, 'current': scene.current}
    for stream, models in flows.items():
        scheduled = any(getattr(event, stream) is not None for event in scene.schedule)
        if not models and not scheduled:
            continue
        try:
            unfelt(stream)
        except CommandError as error:
            key = stream if models else 'schedule'
            raise ConfigError(f"{scene.name}: key '{key}': {error}") from None


def _density_everywhere(model: mujoco.MjModel) -> float:
    """Return the density of the one fluid of a model [kg/m^3]; 0 where a surface parts two."""
    medium = medium_of(model)
    if medium is None:
        return float(model.opt.density)
    return medium.number('density', 0.0) if medium.text('surface') in ('', 'none') else 0.0


def _fluid_of(model: mujoco.MjModel) -> str:
    """Return what fluid a model has, in words; '' without one."""
    if medium_of(model) is not None:
        return f'a {MEDIUM}'
    if model.opt.density > 0:
        return f'a density of {model.opt.density:g} kg/m^3'
    if model.opt.viscosity > 0:
        return f'a viscosity of {model.opt.viscosity:g} Pa s'
    return 'wind' if model.opt.wind.any() else ''


def _thrusters_feel_flow(model: mujoco.MjModel) -> bool:
    """Return whether the inflow changes the force of any fluid_sim.thruster."""
    return any(
        any(instance.number(key) for key in ('rotor_drag', 'rolling_moment'))
        or len(instance.text('thrust_coefficients').split()) > 1
        for instance in plugin_instances(model, THRUSTER)
    )


def _is_below(model: mujoco.MjModel, body: int, root: int) -> bool:
    while body > root:
        body = int(model.body_parentid[body])
    return body == root


def _named(model: mujoco.MjModel, bodies: Iterable[int]) -> list[str]:
    return [model.body(body).name or f'(unnamed body {body})' for body in bodies]
