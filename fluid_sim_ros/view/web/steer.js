// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Keys and gamepads of the page as four axes (forward, left, up, turn), -1 to 1, sent while they
// change; a key that is let go, a lost focus and a closed page send zeros: the vehicle holds.
(() => {
  'use strict';
  const KEYS = {
    ArrowUp: [0, 1], ArrowDown: [0, -1], PageUp: [2, 1], PageDown: [2, -1],
    ArrowLeft: [3, 1], ArrowRight: [3, -1],
  };
  const SIDEWAYS = { ArrowLeft: [1, 1], ArrowRight: [1, -1] };
  // standard mapping: left stick up/down and turn, right stick forward and sideways
  const STICKS = [[0, 3, -1], [1, 2, -1], [2, 1, -1], [3, 0, -1]];
  const DEAD = 0.12, PERIOD = 50;
  const held = new Map();
  let socket = null, last = '', retry = 0;

  const typing = (target) =>
    target instanceof HTMLElement &&
    (target.isContentEditable || ['INPUT', 'TEXTAREA', 'SELECT'].includes(target.tagName) ||
      target.getAttribute('role') === 'slider');  // arrow keys move a slider that has the focus

  const stop = (event) => { event.preventDefault(); event.stopImmediatePropagation(); };

  addEventListener('keydown', (event) => {
    if (!(event.code in KEYS) || typing(event.target) || event.ctrlKey || event.metaKey) return;
    held.set(event.code, event.shiftKey && SIDEWAYS[event.code] || KEYS[event.code]);
    stop(event);
  }, true);
  addEventListener('keyup', (event) => {
    if (held.delete(event.code)) stop(event);
  }, true);
  const release = () => held.clear();
  addEventListener('blur', release);
  document.addEventListener('visibilitychange', () => { if (document.hidden) release(); });

  const axes = () => {
    const sum = [0, 0, 0, 0];
    for (const [axis, sign] of held.values()) sum[axis] += sign;
    for (const pad of navigator.getGamepads ? navigator.getGamepads() : []) {
      if (!pad || pad.mapping !== 'standard') continue;
      for (const [stick, axis, sign] of STICKS) {
        const value = pad.axes[stick] || 0;
        if (Math.abs(value) > DEAD) sum[axis] += sign * value;
      }
    }
    return sum.map((value) => Math.max(-1, Math.min(1, value)));
  };

  const connect = () => {
    socket = new WebSocket(`ws://${location.host}/steer`);
    socket.onclose = () => { socket = null; last = ''; retry = Date.now() + 2000; };
  };

  setInterval(() => {
    if (!socket) {
      if (Date.now() >= retry) connect();
      return;
    }
    const text = JSON.stringify(axes());
    if (text !== last && socket.readyState === WebSocket.OPEN) {
      socket.send(text);
      last = text;
    }
  }, PERIOD);
})();
