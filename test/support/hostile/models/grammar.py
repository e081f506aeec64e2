# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Whole models: trees of bodies with geoms, plugins on them, thrusters, foils and a fluid."""

from collections import defaultdict
from dataclasses import dataclass, field

from test.support.hostile.models.body import Body, drawn_body
from test.support.hostile.models.draw import Draw, Keys, written
from test.support.hostile.models.foil import drawn_foil
from test.support.hostile.models.medium import GRAVITY, Fluid, drawn_fluid
from test.support.hostile.models.thruster import drawn_thruster, is_lagged, torque_acts

#: Plugins of the library that have keys, and the one without.
BODY, MEDIUM, FOIL, THRUSTER = (
    f'fluid_sim.{name}' for name in ('body', 'medium', 'foil', 'thruster')
)
NOOP = 'fluid_sim.noop'
_MESH = '0 0 0 1 0 0 0 1 0 0 0 1 .4 .5 .6'
_SIZES = {'sphere': 1, 'capsule': 2, 'cylinder': 2, 'ellipsoid': 3, 'box': 3}


@dataclass
class Drawn:
    """
    A model of a seed.

    Attributes
    ----------
    xml
        MJCF.
    keys
        Which keys of each plugin it uses.

    """

    xml: str = ''
    keys: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))


class _Writer:
    def __init__(self, seed: int) -> None:
        self.draw = Draw(f'model {seed}')
        self.drawn = Drawn()
        self.timestep = self.draw.size(2e-4, 0.02)
        self.fluid: Fluid = drawn_fluid(self.draw, self.timestep)
        self.instances: dict[str, list[str]] = defaultdict(list)
        self.bodies: list[Body] = []
        self.sites: list[tuple[str, Body]] = []
        self.actuators: list[str] = []

    def model(self) -> Drawn:
        draw, fluid = self.draw, self.fluid
        if fluid.keys is not None:
            self.instance(MEDIUM, 'medium', fluid.keys)
        trees = ''.join(self.body('', 0) for _ in range(draw.choice((1, 1, 1, 2, 3))))
        for i in range(draw.choice((0, 0, 1, 2, 4))):
            self.thruster(i)
        for i in range(draw.choice((0, 0, 1, 2)) if fluid.dense else 0):
            self.foil(i)
        # MuJoCo's own choice is 13 MiB, which a sanitizer clears and fills for each mjData
        self.drawn.xml = f"""<mujoco model="drawn">{self.option()}<size memory="4M"/>
<asset><mesh name="wedge" vertex="{_MESH}" scale=".3 .2 .1"/></asset>
<custom>{self.grids()}</custom><extension>{self.extension()}</extension>
<worldbody>{'<geom type="plane" size="9 9 .1" pos="0 0 -2"/>' if draw.yes(0.3) else ''}{trees}
</worldbody><actuator>{''.join(self.actuators)}</actuator></mujoco>"""
        return self.drawn

    # ---- parts -----------------------------------------------------------------------------

    def option(self) -> str:
        draw, fluid = self.draw, self.fluid
        down = draw.yes(0.6) or 'waves' in (fluid.keys or {})
        gravity = -GRAVITY if down else draw.choice((0.0, -1.6, -1e-3))
        stock = (fluid.density, fluid.viscosity) if fluid.stock else (0, 0)
        integrator = draw.choice(('RK4', 'implicitfast', 'Euler', 'implicit'))
        wind = f'wind="{draw.vector(3)}"' if draw.yes(0.2) else ''
        return (
            f'<option timestep="{self.timestep:.17g}" gravity="0 0 {gravity}" {wind} '
            f'integrator="{integrator}" density="{stock[0]:.17g}" viscosity="{stock[1]:.17g}"/>'
        )

    def grids(self) -> str:
        return ''.join(
            f'<numeric name="{name}" size="{len(numbers.split())}" data="{numbers}"/>'
            for name, numbers in self.fluid.grids.items()
        )

    def extension(self) -> str:
        plugins = {BODY, FOIL, THRUSTER, NOOP} | set(self.instances)
        return ''.join(
            f'<plugin plugin="{plugin}">{"".join(self.instances[plugin])}</plugin>'
            for plugin in sorted(plugins)
        )

    def config(self, plugin: str, keys: Keys) -> str:
        self.drawn.keys[plugin] |= set(keys)
        return ''.join(f'<config key="{key}" value="{text}"/>' for key, text in keys.items())

    def instance(self, plugin: str, name: str, keys: Keys) -> None:
        self.instances[plugin].append(
            f'<instance name="{name}">{self.config(plugin, keys)}</instance>'
        )

    def body(self, parent: str, depth: int) -> str:
        draw = self.draw
        body = Body(f'b{len(self.bodies)}')
        self.bodies.append(body)
        joint = draw.choice(('free', 'free', 'hinge', 'slide', 'ball') if not depth else
                            ('hinge', 'slide', 'ball', 'hinge', ''))  # fmt: skip
        axis = f'axis="{draw.unit()}"' if joint in ('hinge', 'slide') else ''
        joint_xml = f'<joint name="j_{body.name}" type="{joint}" {axis}/>' if joint else ''
        if joint == 'hinge':
            body.hinge = f'j_{body.name}'
        body.free = joint == 'free'
        geoms = ''.join(self.geom(body) for _ in range(draw.choice((1, 1, 2))))
        plugin, chance = '', draw.random()
        if chance < 0.7:
            plugin = f'<plugin plugin="{BODY}">{self.config(BODY, self.keys_of(body))}</plugin>'
        elif chance < 0.75:
            plugin = f'<plugin plugin="{NOOP}"/>'
        elif chance < 0.85 and self.fluid.dense:
            keys = drawn_foil(draw, self.surfaces(), stock=self.fluid.stock)
            plugin = f'<plugin plugin="{FOIL}">{self.config(FOIL, keys)}</plugin>'
        site = f's_{body.name}'
        self.sites.append((site, body))
        inner = ''
        if depth < 2 and not body.alone and draw.yes(0.3):
            inner = self.body(body.name, depth + 1)
        where = written([draw.gauss(0, 1) for _ in range(3)])
        return (
            f'<body name="{body.name}" pos="{where}" simple="false">{joint_xml}{plugin}{geoms}'
            f'<site name="{site}" pos="{draw.gauss(0, 0.1)} 0 0"/>{inner}</body>'
        )

    def keys_of(self, body: Body) -> Keys:
        return drawn_body(self.draw, body, self.fluid)

    def geom(self, body: Body) -> str:
        draw = self.draw
        kind = draw.choice((*_SIZES, 'sphere', 'mesh'))
        size = written([draw.size(0.01, 1) for _ in range(_SIZES.get(kind, 0))])
        shape = f'size="{size}"' if size else 'mesh="wedge"'
        name = f'g{len(body.geoms)}_{body.name}'
        body.geoms.append(name)
        fluid = ''
        if draw.yes(0.6):
            body.ellipsoid = True
            body.balls += kind == 'sphere'
            body.others += kind != 'sphere'
            fluid = 'fluidshape="ellipsoid"'
            if draw.yes():
                numbers = written([draw.zero_or_size(0.01, 2) for _ in range(5)])
                fluid += f' fluidcoef="{numbers}"'
        turned = f'quat="{draw.vector(1, 3)} 1"' if draw.yes(0.3) else ''
        mass = draw.size(1e-3, 100)
        return f'<geom name="{name}" type="{kind}" {shape} mass="{mass:.17g}" {fluid} {turned}/>'

    def surfaces(self) -> list[str]:
        hinges = [f'joint {body.hinge}' for body in self.bodies if body.hinge]
        return [*hinges, *(f'actuator m_{hinge.split()[1]}' for hinge in hinges)]

    def foil(self, number: int) -> None:
        keys = drawn_foil(self.draw, self.surfaces(), stock=self.fluid.stock)
        chosen = self.draw.sample(self.sites, self.draw.randrange(1, min(3, len(self.sites)) + 1))
        self.instance(FOIL, f'foil{number}', keys | {'site': ' '.join(name for name, _ in chosen)})

    def thruster(self, number: int) -> None:
        draw, name = self.draw, f't{number}'
        keys = drawn_thruster(draw, self.fluid)
        self.instance(THRUSTER, name, keys)
        axis, site = draw.unit(), draw.choice(self.sites)[0]
        head = f'<plugin plugin="{THRUSTER}" instance="{name}" site="{site}"'
        limits = 'ctrllimited="true" ctrlrange="-1 5"' if draw.yes(0.3) else ''
        lag = 'actdim="2"' if is_lagged(keys) else ''
        self.actuators.append(f'{head} name="{name}" gear="{axis} 0 0 0" {lag} {limits}/>')
        if torque_acts(keys):
            self.actuators.append(f'{head} name="{name}_torque" gear="0 0 0 {axis}"/>')


def drawn_model(seed: int) -> Drawn:
    """
    Return the model of a seed.

    Parameters
    ----------
    seed
        A whole number.

    """
    writer = _Writer(seed)
    drawn = writer.model()
    servos = ''.join(
        f'<position name="m_{body.hinge}" joint="{body.hinge}" kp="1"/>'
        for body in writer.bodies
        if body.hinge
    )
    # MuJoCo 4.0.0 writes a full row of moments per site actuator into a sparse array where a
    # position is no number; an adhesion reserves a row, so that what is reported is our own
    reserve = '<adhesion body="room" ctrlrange="0 1"/>' * len(writer.actuators)
    drawn.xml = drawn.xml.replace('</actuator>', f'{servos}{reserve}</actuator>')
    room = '<body name="room" pos="0 0 9"><geom size=".1" contype="0" conaffinity="0"/></body>'
    drawn.xml = drawn.xml.replace('</worldbody>', f'{room}</worldbody>')
    return drawn
