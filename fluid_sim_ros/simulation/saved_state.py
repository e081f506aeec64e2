"""A state of a simulation that it can go back to."""

from dataclasses import dataclass

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.scene.schedule import Event
from fluid_sim_ros.simulation.actuation import CommandedWrench
from fluid_sim_ros.simulation.wind_and_current import SavedStreams
from fluid_sim_ros.step_clock import Pace


@dataclass(frozen=True)
class SavedState:
    """Everything that the next step depends on; made by ``Simulation.save_state``."""

    engine: Array
    streams: SavedStreams
    step: int
    wrenches: dict[str, CommandedWrench]
    added_events: tuple[Event, ...]
    gaits: tuple[str, ...] | None = None  # running ones; None: all of the scene
    pace: Pace | None = None  # None: the scene's timestep all along
