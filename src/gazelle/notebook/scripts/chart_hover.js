// Draws an upright line under the mouse, and the values there. MARK and CHART are filled in.
(() => {
  const mark = MARK;
  const chart = CHART;
  const make = (tag, attributes, text = '') => {
    const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const name in attributes) element.setAttribute(name, attributes[name]);
    element.textContent = text;
    return element;
  };
  const nearest = (times, at) => {
    let low = 0;
    let high = times.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] > at) high = middle;
      else low = middle;
    }
    return Math.abs(times[high] - at) < Math.abs(times[low] - at) ? high : low;
  };
  const show = (svg, group, event) => {
    const [left, top, right, bottom] = chart.box;
    const place = svg.getBoundingClientRect();
    const x = ((event.clientX - place.left) * svg.viewBox.baseVal.width) / place.width;
    group.replaceChildren();
    if (x < left || x > right) return;
    const at = chart.x[0] + ((x - left) / (right - left)) * (chart.x[1] - chart.x[0]);
    const line = { x1: x, x2: x, y1: top, y2: bottom, stroke: 'currentColor', opacity: 0.6 };
    group.append(make('line', line));
    const rows = [[at.toPrecision(4), 'currentColor']];
    for (const one of chart.lines) {
      if (!one.times.length) continue;
      const value = one.values[nearest(one.times, at)];
      rows.push([`${one.name} = ${value ?? '–'}`, one.colour]);
    }
    const isRight = x > (left + right) / 2;
    rows.slice(0, 12).forEach(([text, colour], number) => {
      const words = {
        x: x + (isRight ? -6 : 6),
        y: top + 12 + number * 14,
        'font-size': 11,
        fill: colour,
        'text-anchor': isRight ? 'end' : 'start',
      };
      group.append(make('text', words, text));
    });
  };
  const charts = document.querySelectorAll(`[data-gazelle-chart="${mark}"]:not([data-ready])`);
  for (const svg of charts) {
    svg.dataset.ready = 'yes';
    const group = make('g', { 'pointer-events': 'none' });
    svg.append(group);
    svg.addEventListener('pointermove', (event) => show(svg, group, event));
    svg.addEventListener('pointerleave', () => group.replaceChildren());
  }
})();
