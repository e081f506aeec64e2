// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "foil/foil_model.h"

#include <algorithm>
#include <cmath>

#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// Lift and drag of a plate with the normal force Cn |sin|^p, for any angle.
void AddPlate(mjtNum normal, mjtNum power, mjtNum alpha, mjtNum share, WingCoefficients* out) {
  const mjtNum sine = std::sin(alpha), size = std::abs(sine);
  const mjtNum force = share * normal * (power == 1 ? size : size * size);
  out->lift += std::copysign(force, sine) * std::cos(alpha);
  out->drag += force * size;
}

}  // namespace

mjtNum AttachedShare(const Stall& stall, mjtNum alpha) {
  return 1 / ((1 + std::exp(stall.sharpness * (alpha - stall.angle))) *
              (1 + std::exp(-stall.sharpness * (alpha + stall.angle))));
}

WingCoefficients EvaluateWing(const Wing& wing, mjtNum alpha, mjtNum deflection) {
  const bool reversed = std::abs(alpha) > kPi / 2;
  // in reverse flow the angle counts from the trailing edge
  const mjtNum angle = reversed ? alpha - std::copysign(kPi, alpha) : alpha;
  const mjtNum attached = AttachedShare(wing.stall, angle), stalled = 1 - attached;
  const mjtNum linear = reversed
                            ? wing.reverse * (wing.lift_slope * angle - wing.lift_0)
                            : wing.lift_0 + wing.lift_slope * angle + wing.lift_delta * deflection;
  WingCoefficients out;
  out.lift = attached * linear;
  // friction acts along the chord: of a stalled plate only its share cos^2 is drag
  const mjtNum cosine = std::cos(alpha), along = attached + stalled * cosine * cosine;
  out.drag = along * (wing.drag_0 + wing.drag_delta * std::abs(deflection)) +
             attached * linear * linear / (kPi * wing.efficiency * wing.aspect_ratio);
  AddPlate(wing.plate_normal, wing.plate_power, alpha, stalled, &out);
  out.pitch = attached * (reversed ? -wing.reverse * wing.pitch_0
                                   : wing.pitch_0 + wing.pitch_delta * deflection);
  out.center = 0;
  if (wing.moving_center) out.center = attached * (reversed ? 0.5 : 0) + 0.25 * stalled;
  return out;
}

Wrench PanelLoad(const Wing& wing, mjtNum area, mjtNum density, const mjtNum v[3],
                 mjtNum deflection, mjtNum* center) {
  const WingCoefficients c = EvaluateWing(wing, std::atan2(-v[2], v[0]), deflection);
  const mjtNum speed = std::sqrt(v[0] * v[0] + v[2] * v[2]);
  const mjtNum scale = 0.5 * density * area * speed;
  Wrench out;
  out.force[0] = scale * (-c.lift * v[2] - c.drag * v[0]);
  out.force[2] = scale * (c.lift * v[0] - c.drag * v[2]);
  out.torque[1] = -scale * speed * wing.chord * c.pitch;  // y to the left: nose up is negative
  *center = c.center;
  return out;
}

Wrench AircraftLoad(const Aircraft& a, mjtNum density, const mjtNum v[3], const mjtNum w[3],
                    const mjtNum deflection[3]) {
  // the set is written for axes forward, right, down
  const mjtNum forward = v[0], right = -v[1], down = -v[2];
  const mjtNum p = w[0], q = -w[1], r = -w[2];
  const mjtNum speed = mju_norm3(v), plane = std::hypot(forward, down);
  const mjtNum alpha = std::atan2(down, forward), beta = std::atan2(right, plane);
  const mjtNum attached = AttachedShare(a.stall, alpha), stalled = 1 - attached;
  const mjtNum sine = std::sin(alpha), cosine = std::cos(alpha);
  // controls and pitch damping of lift and drag fade out where the flow comes from behind
  const mjtNum ahead = attached + stalled * std::max<mjtNum>(cosine, 0);
  const mjtNum aileron = ahead * deflection[0], elevator = ahead * deflection[1];
  const mjtNum rudder = ahead * deflection[2];
  const mjtNum linear = a.lift[0] + a.lift[1] * alpha;
  WingCoefficients c{attached * linear, a.drag[0] + attached * a.drag[1] * alpha, 0, 0};
  if (a.efficiency > 0) {
    c.drag += attached * linear * linear * a.area / (kPi * a.efficiency * a.span * a.span);
  }
  AddPlate(2, 2, alpha, stalled, &c);
  c.lift += a.lift[3] * elevator;
  c.drag += a.drag[3] * elevator;
  c.pitch = a.pitch[0] + a.pitch[1] * (attached * alpha + stalled * sine) + a.pitch[3] * elevator;
  // rates enter as c q/(2V) and b p/(2V): one V less, so nothing is divided by it
  const mjtNum half = 0.5 * density * a.area * speed;
  const mjtNum pitching = 0.5 * a.chord * q, rolling = 0.5 * a.span * p, yawing = 0.5 * a.span * r;
  const mjtNum lift = half * (speed * c.lift + ahead * a.lift[2] * pitching);
  const mjtNum drag = half * (speed * c.drag + ahead * a.drag[2] * pitching);
  const mjtNum pitch = half * a.chord * (speed * c.pitch + a.pitch[2] * pitching);
  mjtNum lateral[3];  // side force, roll and yaw moment
  const mjtNum* sets[3] = {a.side, a.roll, a.yaw};
  for (int i = 0; i < 3; ++i) {
    const mjtNum* s = sets[i];
    lateral[i] = half * (i ? a.span : 1) *
                 (speed * (s[0] + s[1] * beta + s[4] * aileron + s[5] * rudder) + s[2] * rolling +
                  s[3] * yawing);
  }
  Wrench out;
  out.force[0] = lift * sine - drag * cosine;
  out.force[1] = -lateral[0];
  out.force[2] = lift * cosine + drag * sine;
  out.torque[0] = lateral[1];
  out.torque[1] = -pitch;
  out.torque[2] = -lateral[2];
  return out;
}

}  // namespace fluid_sim
