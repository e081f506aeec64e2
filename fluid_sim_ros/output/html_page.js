// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// What the pages share: elements, and a figure with a canvas, a reading and a legend.
function element(kind, parent, text, name) {
  const made = document.createElement(kind);
  if (text !== undefined) made.textContent = text;
  if (name) made.className = name;
  parent.appendChild(made);
  return made;
}

class Figure {  // a subclass has draw()
  constructor(parent, plot) {
    this.plot = plot;
    const figure = element('figure', parent);
    element('figcaption', figure, plot.title);
    this.canvas = element('canvas', figure);
    this.read = element('div', figure, '', 'read');
    const legend = element('div', figure, undefined, 'legend');
    plot.series.forEach(series => {
      const entry = element('span', legend);
      element('i', entry).style.background = series.color;
      entry.appendChild(document.createTextNode(series.name));
      entry.classList.toggle('off', Boolean(series.off));
      entry.onclick = () => {
        series.off = !series.off;
        entry.classList.toggle('off', series.off);
        this.draw();
      };
    });
  }

  begin() {  // an empty canvas as large as it is shown; the axes take what is around the box
    const ratio = window.devicePixelRatio || 1, canvas = this.canvas;
    canvas.width = canvas.clientWidth * ratio;
    canvas.height = canvas.clientHeight * ratio;
    const g = canvas.getContext('2d');
    g.scale(ratio, ratio);
    g.font = '11px system-ui, sans-serif';
    g.fillStyle = '#555';
    g.strokeStyle = '#e4e4e4';
    [this.left, this.top] = [52, 6];
    this.width = canvas.clientWidth - 60;
    this.height = canvas.clientHeight - 40;
    return g;
  }

  clip(g) { g.beginPath(); g.rect(this.left, this.top, this.width, this.height); g.clip(); }

  upright(g, px, text) {  // a line of the grid, and what stands below it
    g.textAlign = 'center';
    g.beginPath(); g.moveTo(px, this.top); g.lineTo(px, this.top + this.height); g.stroke();
    g.fillText(text, px, this.top + this.height + 14);
  }

  across(g, py, text) {
    g.textAlign = 'right';
    g.beginPath(); g.moveTo(this.left, py); g.lineTo(this.left + this.width, py); g.stroke();
    g.fillText(text, this.left - 5, py + 4);
  }

  label(g, text) {
    g.textAlign = 'center';
    g.fillText(text, this.left + this.width / 2, this.top + this.height + 29);
  }
}

const plots = [];

function drawAll() { plots.forEach(plot => plot.draw()); }

function show() {
  drawAll();
  window.onresize = drawAll;
  document.body.dataset.drawn = plots.length;
}
