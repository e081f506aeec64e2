// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "lean/facts.h"

#include <algorithm>
#include <cstring>

#include "lean/served.h"

namespace fluid_sim {
namespace {

bool Collides(const mjModel* m, int geom) {
  return m->geom_contype[geom] || m->geom_conaffinity[geom];
}

bool HasFluid(const mjModel* m) { return m->opt.density != 0 || m->opt.viscosity != 0; }

// Hand every fact to visit(number), in a fixed order, until one returns false.
template <class Visit>
bool VisitFacts(const mjModel* m, const Visit& visit) {
  const auto all = [&visit](const auto* numbers, mjtSize count) {
    for (mjtSize i = 0; i < count; ++i) {
      if (!visit(static_cast<mjtNum>(numbers[i]))) return false;
    }
    return true;
  };
  if (HasFluid(m)) {  // that MuJoCo's own forces are of
    if (!visit(m->opt.density) || !visit(m->opt.viscosity) || !all(m->body_mass, m->nbody) ||
        !all(m->body_inertia, 3 * m->nbody) || !all(m->body_gravcomp, m->nbody) ||
        !all(m->actuator_gaintype, m->nactuator) || !all(m->actuator_biastype, m->nactuator)) {
      return false;
    }
    for (int i = 0; i < m->ngeom; ++i) {
      const mjtNum* fluid = m->geom_fluid + mjNFLUID * i;
      if (!visit(*fluid)) return false;
      if (*fluid != 0 &&
          (!all(fluid, mjNFLUID) || !visit(m->geom_type[i]) || !all(m->geom_size + 3 * i, 3))) {
        return false;
      }
    }
  }
  for (int i = 0; i < m->ngeom; ++i) {
    if (!visit(m->geom_contype[i]) || !visit(m->geom_conaffinity[i]) ||
        !visit(m->geom_fluid[mjNFLUID * i] > 0)) {
      return false;
    }
    if (!Collides(m, i)) continue;
    if (!all(m->geom_pos + 3 * i, 3) || !all(m->geom_quat + 4 * i, 4) ||
        !all(m->geom_size + 3 * i, 3) || !visit(m->geom_rbound[i]) || !visit(m->geom_margin[i]) ||
        !visit(m->geom_gap[i])) {
      return false;
    }
  }
  return visit(HasFluid(m)) && visit(m->opt.disableflags) && all(m->body_pos, 3 * m->nbody) &&
         all(m->body_quat, 4 * m->nbody) && all(m->jnt_pos, 3 * m->njnt) &&
         all(m->jnt_limited, m->njnt) && all(m->dof_frictionloss, m->nv) &&
         all(m->tendon_limited, m->ntendon) && all(m->tendon_frictionloss, m->ntendon) &&
         all(m->actuator_trntype, m->nactuator) && all(m->actuator_trnid, 2 * m->nactuator) &&
         all(m->actuator_damping, m->nactuator) && all(m->actuator_armature, m->nactuator) &&
         all(m->actuator_dampingpoly, m->nactuator * mjNPOLY);
}

template <class T>
bool Any(const T* numbers, mjtSize count) {
  return std::any_of(numbers, numbers + count, [](T x) { return x != 0; });
}

}  // namespace

void ReadFacts(const mjModel* m, std::vector<mjtNum>* facts) {
  facts->clear();
  VisitFacts(m, [facts](mjtNum x) {
    facts->push_back(x);
    return true;
  });
}

bool SameFacts(const mjModel* m, const std::vector<mjtNum>& facts) {
  const mjtNum* next = facts.data();
  const mjtNum* end = next + facts.size();
  return VisitFacts(m, [&next, end](mjtNum x) { return next < end && *next++ == x; }) &&
         next == end;
}

bool HasConstraints(const mjModel* m) {
  return m->neq > 0 || m->nflex > 0 || Any(m->jnt_limited, m->njnt) ||
         Any(m->dof_frictionloss, m->nv) || Any(m->tendon_limited, m->ntendon) ||
         Any(m->tendon_frictionloss, m->ntendon);
}

int NeededGeoms(const mjModel* m, bool fluid_served) {
  if (m->nsensor > 0) return static_cast<int>(m->ngeom);
  int last = -1;
  for (int i = 0; i < m->ngeom && HasFluid(m) && !fluid_served; ++i) {
    if (m->geom_fluid[mjNFLUID * i] > 0) last = i;
  }
  for (int i = 0; i < m->nwrap; ++i) {
    const int type = m->wrap_type[i];
    if (type == mjWRAP_SPHERE || type == mjWRAP_CYLINDER) last = std::max(last, m->wrap_objid[i]);
  }
  return last + 1;
}

bool OwnPluginsOnly(const mjModel* m) {
  constexpr char kOwn[] = "fluid_sim.";
  for (int i = 0; i < m->nplugin; ++i) {
    const mjpPlugin* plugin = mjp_getPluginAtSlot(m->plugin[i]);
    if (!plugin || std::strncmp(plugin->name, kOwn, sizeof(kOwn) - 1) != 0) return false;
  }
  return true;
}

bool NoCallbacks() {
  return NoForeignCallback() && !mjcb_contactfilter && !mjcb_sensor && !mjcb_act_dyn &&
         !mjcb_act_gain && !mjcb_act_bias;
}

}  // namespace fluid_sim
