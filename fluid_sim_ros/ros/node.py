# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
``fluid_sim_node``: the simulation as a ROS 2 lifecycle node.

The main thread steps, publishes and takes commands; a second thread runs the executor (services,
parameters, lifecycle) and hands its work over as requests that are served between steps.
"""

import gc
import threading
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from rcl_interfaces.msg import SetParametersResult
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.interruption import leave
from fluid_sim_ros.loop.request_queue import RequestQueue
from fluid_sim_ros.output.throttled_log import ThrottledLog
from fluid_sim_ros.ros.health.graph_monitor import GraphMonitor
from fluid_sim_ros.ros.parameters import simulator as parameters
from fluid_sim_ros.ros.process.run import Executable, run_process
from fluid_sim_ros.ros.services import create_services
from fluid_sim_ros.ros.session import Session

Result = TypeVar('Result')

NODE_NAME = 'fluid_sim_node'
SUMMARY = (
    'The simulator as a ROS 2 lifecycle node: steps a scene with fluid forces, takes commands and '
    'weather from topics, and publishes odometry, wrenches, sensors, /clock and /diagnostics.'
)
#: How long a service waits for the stepping thread [s]; configuring compiles a model.
_REQUEST_TIMEOUT = 5.0
_CONFIGURE_TIMEOUT = 60.0


class FluidSimNode(LifecycleNode):
    """Lifecycle node around a Session, with the services of ``create_services``."""

    def __init__(self) -> None:
        super().__init__(NODE_NAME)
        parameters.declare_all(self)
        self._requests = RequestQueue(on_arrival=self._wake)
        self._stepping_thread = threading.get_ident()
        self._session: Session | None = None
        self._active = False
        self._ending = False
        self._report = ThrottledLog(self.get_logger().warning)
        self.configure_error = self.lost = ''
        self.notes: list[str] = []
        self.add_on_set_parameters_callback(self._judge_change)
        self.add_post_set_parameters_callback(self._take_change)
        self._graph = GraphMonitor(self, self._report)
        create_services(self, self._on_session, self.end)

    # ---- stepping thread -------------------------------------------------------------------

    def run(self) -> None:
        """
        Run until ``end``, or until the parameter ``duration`` is over.

        Raises
        ------
        FluidSimError
            If a rule of the lockstep says to stop.

        """
        while not self._ending:
            self._requests.serve()
            self._report.flush()
            session = self._session
            if session is None:
                self._requests.idle()
            elif not self._active or session.diverged:
                session.idle(self._requests)
            elif session.run():
                return

    def end(self) -> None:
        """Have ``run`` return; safe in a signal handler and in any thread."""
        self._ending = True
        if self._session is not None:
            self._session.runner.stop()
        self._wake()

    def close(self) -> None:
        """Refuse further requests and remove the session."""
        self._requests.close()
        self._destroy_session()

    def _wake(self) -> None:
        session = self._session
        if session is not None:
            session.inputs.wake()

    def warn(self, line: str) -> None:
        """
        Tell the user of something that may not be meant, in the log and in diagnostics.

        Parameters
        ----------
        line
            What.

        """
        self.get_logger().warning(line)
        self.notes.append(line)

    def _on_stepping_thread(
        self, work: Callable[[], Result], timeout: float = _REQUEST_TIMEOUT
    ) -> Result:
        if threading.get_ident() == self._stepping_thread:
            return work()
        return self._requests.call(work, timeout)

    # ---- lifecycle -------------------------------------------------------------------------

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Load the scene and create the topics.

        Parameters
        ----------
        state
            State that the node comes from.

        Returns
        -------
        TransitionCallbackReturn
            Whether it succeeded.

        """
        return self._transition(self._create_session, _CONFIGURE_TIMEOUT)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Begin to step.

        Parameters
        ----------
        state
            State that the node comes from.

        Returns
        -------
        TransitionCallbackReturn
            Whether it succeeded.

        """
        return self._transition(lambda: self._set_active(True))

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Stop stepping; the state is kept.

        Parameters
        ----------
        state
            State that the node comes from.

        Returns
        -------
        TransitionCallbackReturn
            Whether it succeeded.

        """
        return self._transition(lambda: self._set_active(False))

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        Remove the scene and its topics.

        Parameters
        ----------
        state
            State that the node comes from.

        Returns
        -------
        TransitionCallbackReturn
            Whether it succeeded.

        """
        return self._transition(self._destroy_session)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """
        End the node's loop.

        Parameters
        ----------
        state
            State that the node comes from.

        Returns
        -------
        TransitionCallbackReturn
            Whether it succeeded.

        """
        self.end()
        return TransitionCallbackReturn.SUCCESS

    def _transition(
        self, work: Callable[[], None], timeout: float = _REQUEST_TIMEOUT
    ) -> TransitionCallbackReturn:
        try:
            self._on_stepping_thread(work, timeout)
        except FluidSimError as error:
            self.configure_error = str(error)
            self.get_logger().error(str(error))
            return TransitionCallbackReturn.FAILURE
        return TransitionCallbackReturn.SUCCESS

    def _create_session(self) -> None:
        settings = parameters.read_all(self)
        session = Session(self, settings, self._requests, self._graph, self._report, self.notes)
        self._session = session
        self.get_logger().info(
            f"scene '{session.simulation.scene.name}': "
            f'vehicles {", ".join(session.simulation.vehicles)}; {settings["pacing"]} pacing'
        )

    def _set_active(self, active: bool) -> None:
        self._active = active
        if self._session is not None:
            self._session.runner.stopped = not active

    def _destroy_session(self) -> None:
        session, self._session = self._session, None
        self._active = False
        if session is not None:
            session.runner.stop()
            session.destroy()
            self.lost = self.lost or session.lost
            # its parts know each other: without this tens of megabytes each stay for some cycles
            del session
            gc.collect()

    # ---- services and parameters (executor thread) -----------------------------------------

    def _on_session(self, work: Callable[[Session], str]) -> str:
        def on_session() -> str:
            if self._session is None:
                raise FluidSimError('the node is not configured')
            return work(self._session)

        return self._on_stepping_thread(on_session)

    def _judge_change(self, changes: list[Parameter]) -> SetParametersResult:
        return parameters.judge_change(self, changes, self._session is not None)

    def _take_change(self, changes: list[Parameter]) -> None:
        names = [p.name for p in changes if p.name in parameters.TABLE]
        if self._session is None or not names:
            return
        present = parameters.read_all(self)
        values = {name: present[name] for name in names}
        try:
            self._on_stepping_thread(lambda: self._change(values))
        except FluidSimError as error:
            self._report('parameters', str(error))

    def _change(self, values: dict[str, Any]) -> None:
        if self._session is not None:
            self._session.change(values)


def _autostart(node: FluidSimNode) -> None:
    if not node.get_parameter('autostart').value:
        return
    if node.trigger_configure() != TransitionCallbackReturn.SUCCESS:
        raise FluidSimError(node.configure_error or 'configuring failed')
    node.trigger_activate()


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node until it is ended.

    Parameters
    ----------
    args
        Command line; None means that of the process.

    Returns
    -------
    int
        The process's exit code.

    """
    return run_process(
        Executable(NODE_NAME, SUMMARY, parameters.TABLE, FluidSimNode, _autostart), args
    )


if __name__ == '__main__':
    leave(main())
