"""What the plugin benchmarks share: models with fluid_sim plugins, native calls, results."""

from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from fluid_sim_ros.plugins.messages import load_error_line
from fluid_sim_ros.plugins.native import native

Array = NDArray[np.float64]
FIRST_ORDER = ('Euler', 'implicit', 'implicitfast', 'discrete')


def text(values: ArrayLike) -> str:
    """Return numbers with all their digits, as MJCF wants them."""
    return ' '.join(f'{value:.17g}' for value in np.asarray(values, dtype=float).reshape(-1))


def config(values: Mapping[str, Any]) -> str:
    """Return the <config> elements of a plugin instance."""
    lines = []
    for key, value in values.items():
        written = value if isinstance(value, str) else text(value)
        lines.append(f'<config key="{key}" value="{written}"/>')
    return ''.join(lines)


def body_plugin(**values: Any) -> str:
    """Return the element that puts fluid_sim.body on the body around it."""
    return f'<plugin plugin="fluid_sim.body">{config(values)}</plugin>'


def ellipsoid(size: ArrayLike, density: float, coef: ArrayLike = (0, 0, 0, 0, 0)) -> str:
    """Return an ellipsoid geom that takes part in the fluid."""
    return (
        f'<geom type="ellipsoid" size="{text(size)}" density="{text(density)}" '
        f'fluidshape="ellipsoid" fluidcoef="{text(coef)}" contype="0" conaffinity="0"/>'
    )


def world(
    bodies: str,
    *,
    integrator: str = 'RK4',
    timestep: float = 0.01,
    gravity: ArrayLike = (0.0, 0.0, 0.0),
    option: str = '',
    flag: str = '',
    medium: Mapping[str, Any] | None = None,
    extra: str = '',
) -> str:
    """Return MJCF with both plugins declared; ``medium`` None leaves fluid_sim.medium out."""
    instance = '' if medium is None else f'<instance name="fluid">{config(medium)}</instance>'
    if medium is not None:
        instance = f'<plugin plugin="fluid_sim.medium">{instance}</plugin>'
    return f"""<mujoco><option timestep="{timestep:.17g}" integrator="{integrator}"
gravity="{text(gravity)}" {option}><flag contact="disable" {flag}/></option>
<extension><plugin plugin="fluid_sim.body"/>{instance}</extension>
<worldbody>{bodies}</worldbody>{extra}</mujoco>"""


def free_body(inside: str, *, name: str = 'hull', position: ArrayLike = (0, 0, 0)) -> str:
    """Return a body with a free joint whose whole inertia matrix MuJoCo stores."""
    return f'<body name="{name}" pos="{text(position)}" simple="false"><freejoint/>{inside}</body>'


def load(xml: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Compile MJCF and make its data."""
    native()
    model = mujoco.MjModel.from_xml_string(xml)
    return model, mujoco.MjData(model)


def explicit_force(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """Return the generalized fluid force summed over the published terms, without qacc."""
    out = np.zeros(model.nv)
    scratch = mujoco.MjData(model)
    native().explicit_force(model._address, data._address, scratch._address, out.ctypes.data)
    return out


def kinetic_energy(
    model: mujoco.MjModel, data: mujoco.MjData, scratch: mujoco.MjData | None = None
) -> Array:
    """Return the kinetic energy of the bodies and of the flow around them [J], shape (2,)."""
    out = np.zeros(2)
    scratch = scratch or mujoco.MjData(model)
    native().kinetic_energy(model._address, data._address, scratch._address, out.ctypes.data)
    return out


def set_medium(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    *,
    wind: ArrayLike | None = None,
    current: ArrayLike | None = None,
) -> bool:
    """Let wind or current move towards a velocity [m/s]; False without a medium in charge."""
    vectors = [
        None if value is None else np.array(value, dtype=np.float64) for value in (wind, current)
    ]
    addresses = [0 if vector is None else vector.ctypes.data for vector in vectors]
    return bool(native().set_medium(model._address, data._address, *addresses))


def refusal(xml: str, plugin: str) -> str:
    """Return the one line with which ``plugin`` refuses a model; AssertionError if it does not."""
    try:
        load(xml)
    except ValueError as error:
        line = load_error_line(error)
    else:
        raise AssertionError('the model loads')
    assert '\n' not in line
    assert line.startswith(plugin), line
    return line
