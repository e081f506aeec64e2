// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/history.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "body/body.h"
#include "body/body_forces.h"
#include "shared/config.h"
#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

constexpr mjtNum kRatio = 3;                      // of neighbouring rates
constexpr int kLow = -24, kHigh = 24, kFine = 4;  // table over log2, points per unit

// T = r^2/(pi nu) [s]
mjtNum DiffusionTime(mjtNum radius, const Flow& flow) {
  return radius * radius * flow.density / (kPi * flow.viscosity);
}

mjtNum Share(const History& history, mjtNum p) {
  const mjtNum place = (std::log2(p) - kLow) * kFine;
  const int last = static_cast<int>(history.share.size()) - 1;
  if (!(place > 0)) return history.share.front();
  if (place >= last) return history.share.back();
  const int i = static_cast<int>(place);
  return history.share[i] + (place - i) * (history.share[i + 1] - history.share[i]);
}

// Weights of the exponentials in K; `speed` relative to the fluid.
void Weights(const History& history, const Flow& flow, mjtNum speed, mjtNum out[kHistoryModes]) {
  const mjtNum time = DiffusionTime(history.radius, flow);
  const mjtNum reynolds = 2 * history.radius * speed * flow.density / flow.viscosity;
  const mjtNum f = 0.75 + history.c2 * reynolds, half = 0.5 * reynolds / f;
  const mjtNum b = std::sqrt(half * half * half / (2 * kPi));
  const bool fades = history.kernel != HistoryKernel::kBasset && b > kTiny;
  const mjtNum crossover = fades ? std::pow(b, mjtNum(-4) / 3) : 0;
  for (int k = 0; k < kHistoryModes; ++k) {
    const mjtNum rate = history.rate[k] * time;
    out[k] = std::sqrt(rate / kPi) * std::log(kRatio);
    if (fades) out[k] *= Share(history, rate * crossover);
  }
}

// (1 - exp(-x))/x
mjtNum Mean(mjtNum x) { return x > 0 ? -std::expm1(-x) / x : 1; }

int FluidOf(const Flow& flow) { return flow.lower ? 1 : 2; }

// Which fluid the state is of; 0 also for a state that no step has written.
int FluidOf(const mjtNum* state) { return state[kFluid] == 1 ? 1 : state[kFluid] == 2 ? 2 : 0; }

// Velocity of the sphere's centre from the state after a step; d's poses are those before it.
void CenterMotion(const mjModel* m, const mjData* d, const BodyFluid& body, mjtNum point_w[3],
                  mjtNum velocity_w[3]) {
  const mjtNum *qvel = d->qvel + body.free_dof, *center = body.history.center;
  const mjtNum* qpos = d->qpos + m->jnt_qposadr[m->body_jntadr[body.id]];
  mjtNum arm[3], swing[3];
  mju_rotVecQuat(arm, center, qpos + 3);
  mju_add3(point_w, qpos, arm);
  mju_cross(swing, qvel + 3, center);
  mju_rotVecQuat(arm, swing, qpos + 3);
  mju_add3(velocity_w, qvel, arm);
}

}  // namespace

int HistoryStateSize(const mjModel* m, int instance) {
  const std::string kernel = Config(m, instance, "").Text("history");
  return kernel.empty() || kernel == "none" ? 0 : kHistoryState;
}

std::vector<mjtNum> HistoryShares(mjtNum c) {
  // inverse Laplace transform along the cut: -1/pi int exp(-p u) Im G(u exp(i pi)) du, over that of
  // x^-1/2, (pi p)^-1/2; trapezoidal in log u
  constexpr mjtNum kStep = 0.02, kEnd = 60;
  using Complex = std::complex<mjtNum>;
  std::vector<mjtNum> places, values, out;
  const Complex slow = std::polar<mjtNum>(1, kPi / (2 * c)),
                fast = std::polar<mjtNum>(1, 2 * kPi / c);
  for (mjtNum s = -kEnd; s <= kEnd; s += kStep) {
    const mjtNum u = std::exp(s);
    const Complex base = std::pow(u, 1 / (2 * c)) * slow + std::pow(u, 2 / c) * fast;
    // the angle runs from pi/2c to 2 pi/c without a jump
    mjtNum angle = std::arg(base);
    if (angle < 0) angle += 2 * kPi;
    places.push_back(u);
    values.push_back(-std::pow(std::abs(base), -c) * std::sin(-c * angle) * u * kStep / kPi);
  }
  for (int i = kLow * kFine; i <= kHigh * kFine; ++i) {
    const mjtNum p = std::exp2(static_cast<mjtNum>(i) / kFine);
    mjtNum sum = 0;
    for (size_t k = 0; k < places.size(); ++k) sum += std::exp(-p * places[k]) * values[k];
    out.push_back(std::max<mjtNum>(sum * std::sqrt(kPi * p), 0));
  }
  return out;
}

void AddHistory(const mjModel* m, const mjData* d, const BodyFluid& body, const Flow& flow,
                const Motion& motion, const mjtNum nu[6], bool secant, BodyForces* out) {
  const History& history = body.history;
  const mjtNum* state = d->plugin_state + m->plugin_stateadr[history.instance];
  const int fluid = FluidOf(state);
  if (flow.viscosity <= 0 || (fluid != 0 && fluid != FluidOf(flow))) return;
  mjtNum arm[3], velocity_b[3], velocity[3], weight[kHistoryModes];
  mju_sub3(arm, history.center, body.point);
  mju_copy3(velocity_b, nu);
  AddCross(velocity_b, nu + 3, arm);
  Rotate(velocity, motion.rotation, velocity_b);
  Weights(history, flow, mju_norm3(velocity), weight);
  const mjtNum drag = flow.weight * 6 * kPi * flow.viscosity * history.radius;
  const mjtNum ahead = secant ? m->opt.timestep : 0;
  const mjtNum since = fluid ? std::max<mjtNum>(d->time - state[kTime], 0) : 0;
  mjtNum force[3] = {0, 0, 0}, carried = 0;
  for (int k = 0; k < kHistoryModes; ++k) {
    const mjtNum rate = history.rate[k], fade = std::exp(-rate * (since + ahead));
    carried += weight[k] * Mean(rate * ahead);
    if (fluid == 0) continue;
    const mjtNum* integral = state + kIntegrals + 3 * k;
    const mjtNum gained = std::exp(-rate * ahead) * Mean(rate * since);
    for (int i = 0; i < 3; ++i) {
      const mjtNum change = velocity[i] - state[kVelocity + i];
      force[i] -= drag * weight[k] * (fade * integral[i] + gained * change);
    }
  }
  mjtNum force_b[3];
  RotateBack(force_b, motion.rotation, force);
  mju_addTo3(out->term[kViscous], force_b);
  AddCross(out->term[kViscous] + 3, arm, force_b);
  if (secant) AddIsotropic6(out->secant, drag * carried, 0, arm);
}

void AdvanceHistory(const mjModel* m, mjData* d, const Medium& medium, const BodyFluid& body) {
  mjtNum* state = d->plugin_state + m->plugin_stateadr[body.history.instance];
  mjtNum point[3], velocity[3];
  CenterMotion(m, d, body, point, velocity);
  const bool above =
      medium.in_charge() && medium.has_surface && point[2] > SurfaceHeight(medium, d, point);
  Flow flows[2];
  FlowsAt(medium, m, d, body.id, point, above ? 0 : 1, flows);
  mju_subFrom3(velocity, flows[0].velocity);
  const int fluid = FluidOf(flows[0]), before = FluidOf(state);
  mjtNum change[3], span = d->time - state[kTime];
  if (before == 0) {  // the first step: what it did to the velocity
    span = m->opt.timestep;
    mju_scl3(change, d->qacc + body.free_dof, span);
  } else {
    mju_sub3(change, velocity, state + kVelocity);
  }
  for (int k = 0; k < kHistoryModes; ++k) {
    mjtNum* integral = state + kIntegrals + 3 * k;
    const mjtNum lapse = body.history.rate[k] * std::max<mjtNum>(span, 0);
    const mjtNum fade = before == fluid ? std::exp(-lapse) : 0, gained = Mean(lapse);
    for (int i = 0; i < 3; ++i) integral[i] = fade * integral[i] + gained * change[i];
    if (before != 0 && before != fluid) mju_zero3(integral);  // a new fluid remembers nothing
  }
  state[kFluid] = fluid;
  mju_copy3(state + kVelocity, velocity);
  state[kTime] = d->time;
}

}  // namespace fluid_sim
