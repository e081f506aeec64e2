# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Which stages of MuJoCo's step a simulation takes, and which it leaves out."""

from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.plugins import native as nat

# In the order of enum Whole (plugins/src/lean/lean.h).
_WHOLE = (
    '',
    'the model has plugins that are not of fluid_sim',
    'a callback of MuJoCo is set (mjcb_...)',
    'an option asks for it (sleep, fwdinv, override, autoreset off, or the integrator)',
    'the model has flexes',
)
# In the order of enum Contacts (plugins/src/lean/clearance.h).
_CONTACTS = ('never', 'watched', 'always')


@dataclass(frozen=True)
class Stages:
    """
    What the next steps take of MuJoCo's stages; the state is the same to the bit without the rest.

    Attributes
    ----------
    whole
        Why every step is MuJoCo's, whole; '' where it is not.
    contacts
        ``never``: no two geoms may touch. ``watched``: looked for where geoms come near.
        ``always``: nothing bounds where geoms can be.
    constraints
        Whether there are constraints that are no contacts: limits, equalities, friction loss.
    moved_geoms, geoms
        How many geoms move at every evaluation, and in all; the rest moves once per call.
    without_contacts
        Whether the last step was without contacts.
    moments_by_tree
        Whether moments of actuators at sites are made along their own trees alone.
    fluid_by_chain
        Whether MuJoCo's own fluid forces are made along each body's chain of joints alone.

    """

    whole: str
    contacts: str
    constraints: bool
    moved_geoms: int
    geoms: int
    without_contacts: bool
    moments_by_tree: bool
    fluid_by_chain: bool

    @classmethod
    def of(cls, stepped: int, geoms: int) -> 'Stages':
        """
        Ask the library.

        Parameters
        ----------
        stepped
            What ``Native.lean`` returned.
        geoms
            Of the model.

        Returns
        -------
        Stages
            As the model is now.

        """
        out = np.zeros(7, dtype=np.int32)
        nat.native().lean_about(stepped, out.ctypes.data)
        whole, contacts, constraints, moved, without, by_tree, by_chain = out.tolist()
        return cls(
            whole=_WHOLE[whole],
            contacts=_CONTACTS[contacts],
            constraints=bool(constraints),
            moved_geoms=moved,
            geoms=geoms,
            without_contacts=bool(without),
            moments_by_tree=bool(by_tree),
            fluid_by_chain=bool(by_chain),
        )

    def words(self) -> str:
        """Return one line for people."""
        if self.whole:
            return f'all, in every step: {self.whole}'
        contacts = {
            'never': 'contacts never (no geoms that may touch)',
            'watched': 'contacts while geoms are near each other',
            'always': 'contacts always (no bound on where geoms can be)',
        }[self.contacts]
        others = 'other constraints always' if self.constraints else 'no other constraints'
        all_geoms = self.contacts == 'always'
        geoms = 'all' if all_geoms else f'{self.moved_geoms} of {self.geoms}'
        moments = '; moments of actuators at sites by tree' if self.moments_by_tree else ''
        fluid = "; MuJoCo's fluid forces by chain" if self.fluid_by_chain else ''
        return f'{contacts}; {others}; places of {geoms} geoms at every evaluation{moments}{fluid}'
