# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A simulation in this process as a source of the view."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from fluid_sim_ros.errors import CommandError, FluidSimError, listed
from fluid_sim_ros.loop.helms import Move
from fluid_sim_ros.loop.pacing import Pacing, RealTime
from fluid_sim_ros.loop.request_queue import RequestQueue
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.loop.watchdogs import Watchdogs
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.schema.settings import FLUID_RUNGS, RunSettings
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.view import orders
from fluid_sim_ros.view.frame import Frame
from fluid_sim_ros.view.helmsman import Helmsman
from fluid_sim_ros.view.source import Source

#: A request that is not answered in this time is given up [s of wall time].
_PATIENCE = 5.0
#: Simulated time between two looks at the clock, and of one step of the time bar [s].
_TURN, _STEP = 0.01, 0.02
_SCENE = 'as the scene states'


@dataclass(frozen=True)
class ViewOptions:
    """
    How a simulation is viewed.

    Attributes
    ----------
    pace
        Simulated seconds per second; 0: as fast as it goes.
    hold
        Whether vehicles with thrusters that the scene does not command are held from the start.
    paused
        Whether it begins paused.

    """

    pace: float = 1.0
    hold: bool = True
    paused: bool = False


class SimulatedSource(Source):
    """
    Runs a scene for a view; see ``view.source.Source``.

    Nothing here changes how a scene moves: frames are taken at step boundaries, of copies.

    Parameters
    ----------
    scene
        As for ``Simulation``.
    settings
        That a user asked for.
    options
        How it begins.
    say
        Takes the lines of the watchdogs.

    """

    takes = frozenset({
        orders.Pause, orders.Step, orders.Reset, orders.Pace, orders.Thrust, orders.Joint,
        orders.Flow, orders.Rung, orders.Hold, orders.Steer,
    })  # fmt: skip
    span = (0.0, 0.0)

    def __init__(
        self,
        scene: str | Path | Scene,
        settings: RunSettings | None = None,
        options: ViewOptions | None = None,
        say: Callable[[str], None] = lambda line: None,
    ) -> None:
        self._scene = Scene.load(scene)
        self.title = self._scene.name
        self._settings, self._say = settings or RunSettings(), say
        options = options or ViewOptions()
        self.pace, self._hold = options.pace, options.hold
        self.generation = 0
        self._requests = RequestQueue()
        self._frame: Frame | None = None
        self._wanted = True
        self._ended = False
        self._note = ''
        self._begin(Simulation(self._scene, **self._settings.model_dump()), options.paused)

    # ---- the source's side -----------------------------------------------------------------

    def frame(self) -> Frame | None:
        """Return the newest frame that there is, and have a newer one made; never blocks."""
        self._wanted = True
        return self._frame

    def take(self, order: orders.Order) -> None:
        """
        Do what is asked, at the next step boundary.

        Parameters
        ----------
        order
            Of a kind that ``takes`` holds.

        Raises
        ------
        FluidSimError
            If it cannot be done; says why.

        """
        if type(order) not in self.takes:
            raise CommandError(f'a simulation takes no order {type(order).__name__}')
        self._requests.call(lambda: self._do(order), _PATIENCE)

    def run(self) -> None:
        """Step until ``stop``, in the thread that calls it."""
        while not self._ended:
            runner = self._runner
            try:
                runner.run()
            except FluidSimError as error:
                # the last good state stays on the screen
                self._note = f'{error}; Reset begins anew'
                self._say(self._note)
                self._sample()
                while runner is self._runner and not self._ended:
                    self._requests.idle()
                    self._requests.serve()
        self._requests.close()

    def stop(self) -> None:
        """End ``run``; may be called from any thread, and by a signal."""
        self._ended = True
        self._runner.stop()

    # ---- in the stepping thread ------------------------------------------------------------

    def _begin(self, simulation: Simulation, paused: bool) -> None:
        """Start anew, at the simulation's present state."""
        self.simulation, self.model = simulation, simulation.model
        self.vehicles, self.terms = simulation.vehicles, simulation.terms
        self.streams = simulation.streams
        present = self._settings.fluid or _SCENE
        self.rungs = [present, *(rung for rung in (_SCENE, *FLUID_RUNGS) if rung != present)]
        self._note = ''
        self._helmsman = Helmsman(simulation)
        if self._hold:
            self._hold_idle_vehicles()
        watchdogs = Watchdogs(simulation, self._say)
        self._runner = Runner(
            simulation, NoSource(), [watchdogs, self._helmsman], self._pacing(), self._requests,
            self._housekeeping,
        )  # fmt: skip
        self._runner.paused = paused
        self._sample()

    def _hold_idle_vehicles(self) -> None:
        """Hold what has thrusters and neither a schedule, a gait nor joints of unknown use."""
        scene = self._scene
        commanded = {name for event in scene.schedule for name in event.thrust}
        for name, vehicle in self.vehicles.items():
            if not vehicle.thrusters or name in commanded or name in scene.gait:
                continue
            try:
                self._helmsman.hold(name)
            except FluidSimError as error:
                self._say(f"vehicle '{name}' is not held: {error}")

    def _pacing(self) -> Pacing:
        if not self.pace:
            return Pacing()
        tick = max(1, round(_TURN * min(1.0, self.pace) / self.simulation.timestep))
        return RealTime(factor=self.pace, tick=tick)

    def _housekeeping(self) -> None:
        if self._wanted:
            self._sample()

    def _sample(self) -> None:
        self._wanted = False
        simulation = self.simulation
        rows = simulation.observe(forces=True).copy()
        observed = simulation.observed
        self._frame = Frame(
            simulation.time, simulation.data.qpos.copy(), rows, simulation.data.ctrl.copy(),
            observed.actuator_force.copy(), self._flows(), self._runner.paused,
            self._helmsman.held, self._note, simulation.data.plugin_state.copy(),
        )  # fmt: skip

    def _flows(self) -> dict[str, Array]:
        saved = self.simulation.save_state().streams
        flows = {'wind': saved.wind_w, 'current': saved.current_w}
        return {name: flows[name] for name in self.streams}

    def _do(self, order: orders.Order) -> None:
        """Do an order, at a step boundary."""
        simulation, runner = self.simulation, self._runner
        if self._note and not isinstance(order, orders.Reset | orders.Rung | orders.Pace):
            raise CommandError(self._note)
        match order:
            case orders.Pause(paused):
                runner.paused = paused
            case orders.Step():
                runner.paused = True
                runner.advance_paused(max(1, round(_STEP / simulation.timestep)))
            case orders.Reset():
                simulation.reset()
                self._anew(simulation)
            case orders.Rung(fluid):
                self._change_rung(fluid)
            case orders.Pace(factor):
                self.pace = factor
                runner.pacing = self._pacing()
                runner.pacing.begin(simulation)
            case orders.Thrust(vehicle, values):
                self._helmsman.let_go(vehicle)
                simulation.set_thrust(vehicle, values)
            case orders.Joint(vehicle, joint, value):
                self._helmsman.let_go(vehicle)
                simulation.set_joints(vehicle, {joint: value})
            case orders.Flow(stream, velocity):
                self._set_flow(stream, velocity)
            case orders.Hold(vehicle, held):
                (self._helmsman.hold if held else self._helmsman.let_go)(vehicle)
            case orders.Steer(vehicle):
                move = Move(order.forward, order.left, order.up, order.turn)
                self._helmsman.steer(vehicle, move)
        self._wanted = True

    def _set_flow(self, stream: str, velocity: object) -> None:
        if stream not in self.streams:
            raise CommandError(f"'{stream}' is not in the scene; it has: {listed(self.streams)}")
        set_flow = self.simulation.set_wind if stream == 'wind' else self.simulation.set_current
        set_flow(velocity)  # type: ignore[arg-type]

    def _change_rung(self, name: str) -> None:
        """Begin anew with another fluid model; the scene's own file is left alone."""
        if name not in self.rungs:
            raise CommandError(f"fluid '{name}' is not known; allowed: {listed(self.rungs)}")
        fluid = None if name == _SCENE else name
        settings = self._settings.model_copy(update={'fluid': fluid})
        simulation = Simulation(self._scene, **settings.model_dump())
        self._settings = settings
        self.generation += 1
        self._anew(simulation)

    def _anew(self, simulation: Simulation) -> None:
        before = self._runner
        self._begin(simulation, before.paused)
        before.stop()
