"""Settings of a run: integrators and fluid models by name."""

import mujoco

from fluid_sim_ros.errors import ConfigError, listed

INTEGRATORS = {
    name.removeprefix('mjINT_').lower(): getattr(mujoco.mjtIntegrator, name)
    for name in mujoco.mjtIntegrator.__members__
}

#: Fluid rungs that ``Scene.compile(fluid=...)`` can force on a scene.
FLUID_RUNGS = ('none', 'inertia', 'ellipsoid', 'no_added_mass')


def integrator(name: str) -> mujoco.mjtIntegrator:
    """Return an integrator by name (any case); ConfigError with the names that there are."""
    if name.lower() not in INTEGRATORS:
        raise ConfigError(f"integrator '{name}' is not known; allowed: {listed(INTEGRATORS)}")
    return INTEGRATORS[name.lower()]
