# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the services share: work on the session, and what went wrong as their result."""

from collections.abc import Callable
from types import ModuleType
from typing import Any

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.ros.session import Session
from fluid_sim_ros.simulation.entities import UnknownEntityError

#: Has the stepping thread do work on the session; returns what to tell the caller.
OnSession = Callable[[Callable[[Session], str]], str]


class UnsupportedError(FluidSimError):
    """A part of a request that this simulator does not do."""


class WrongStateError(FluidSimError):
    """A request that does not fit the state that the simulation is in."""


class Services:
    """
    A set of services; each method takes a request and fills a response.

    Parameters
    ----------
    messages, services
        The package's modules ``msg`` and ``srv``; of any version from 1.0 on, as numbers are taken
        by their names.
    on_session
        Has the stepping thread do work on the session. Raises FluidSimError where there is none,
        or the work fails.
    end
        Ends the node.

    """

    def __init__(
        self,
        messages: ModuleType,
        services: ModuleType,
        on_session: OnSession,
        end: Callable[[], None],
    ) -> None:
        self._messages, self._services = messages, services
        self._on_session, self._end = on_session, end

    def answering(self, fill: Callable[[Any, Any], None]) -> Callable[[Any, Any], Any]:
        """
        Return a service's function: what goes wrong becomes its result.

        Parameters
        ----------
        fill
            Method of this class.

        Returns
        -------
        callable
            Takes request and response, returns the response.

        """
        codes = self._messages.Result

        def answer(request: Any, response: Any) -> Any:
            code, words = codes.RESULT_OK, ''
            try:
                fill(request, response)
            except UnsupportedError as error:
                code, words = codes.RESULT_FEATURE_UNSUPPORTED, str(error)
            except WrongStateError as error:
                code, words = codes.RESULT_INCORRECT_STATE, str(error)
            except UnknownEntityError as error:
                code, words = codes.RESULT_NOT_FOUND, str(error)
            except FluidSimError as error:
                code, words = codes.RESULT_OPERATION_FAILED, str(error)
            if hasattr(response, 'result') and not response.result.result:
                response.result.result, response.result.error_message = code, words
            return response

        return answer
