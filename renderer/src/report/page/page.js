"use strict";
(() => {
  const SVG = "http://www.w3.org/2000/svg";
  const numbers = JSON.parse(document.getElementById("numbers").textContent);
  const tip = document.getElementById("tip");
  const format = new Intl.NumberFormat("en", { maximumSignificantDigits: 5 });
  const readable = (value) => format.format(value).replaceAll(",", "\u202f");

  function element(name, attributes) {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    return made;
  }

  // Index of the value in the ascending list that is nearest to the one wanted.
  function nearest(list, wanted) {
    let best = 0;
    list.forEach((value, index) => {
      if (Math.abs(value - wanted) < Math.abs(list[best] - wanted)) best = index;
    });
    return best;
  }

  const toX = (panel, at) => {
    const [left, , width] = panel.frame, [low, high] = panel.domain;
    return low + ((at - left) / width) * (high - low);
  };
  const fromX = (panel, x) => {
    const [left, , width] = panel.frame, [low, high] = panel.domain;
    return left + ((x - low) / (high - low)) * width;
  };

  // The tip is built from elements, not markup: names are the user's.
  function row(table, color, name, value) {
    const line = table.insertRow();
    const label = line.insertCell();
    if (color) {
      const swatch = document.createElement("i");
      swatch.style.background = `var(--${color})`;
      label.append(swatch);
    }
    label.append(name);
    line.insertCell().append(value);
  }

  function fill(figure, panel, x, y) {
    const index = nearest(panel.x, x);
    const title = document.createElement("b");
    title.append([panel.title.filter(Boolean).join(", "), `${figure.x} ${readable(panel.x[index])}`].filter(Boolean).join(" · "));
    const table = document.createElement("table");
    if (panel.cells) {
      const [, top, , height] = panel.frame;
      const bin = Math.min(panel.labels.length - 1, Math.max(0, Math.floor((1 - (y - top) / height) * panel.labels.length)));
      const cells = panel.cells[index];
      let clusters = 0, all = 0;
      for (let k = 0; k < cells.length; k += 2) {
        if (cells[k] === bin) clusters = cells[k + 1];
        all += cells[k + 1];
      }
      row(table, null, figure.series, panel.labels[bin]);
      row(table, null, "clusters with so many", readable(clusters));
      row(table, null, "visible clusters", readable(all));
    } else {
      let sum = 0;
      const lines = panel.series.map((series) => {
        const own = series.x || panel.x;
        const place = nearest(own, panel.x[index]);
        sum += series.y[place];
        return [series.color, series.name, readable(series.y[place])];
      });
      if (panel.stacked) lines.reverse();
      lines.forEach((line) => row(table, ...line));
      if (panel.stacked) row(table, null, "together", readable(sum));
    }
    tip.replaceChildren(title, table);
    return panel.x[index];
  }

  function show(svg, figure, event) {
    const box = svg.getBoundingClientRect(), view = svg.viewBox.baseVal;
    const x = ((event.clientX - box.left) / box.width) * view.width;
    const y = ((event.clientY - box.top) / box.height) * view.height;
    const within = ({ frame: [left, top, width, height] }) =>
      x >= left && x <= left + width && y >= top && y <= top + height;
    const panel = figure.panels.find(within);
    if (!panel) return hide(svg);
    const frame = fill(figure, panel, toX(panel, x), y);
    // The same frame is marked in every panel of the figure.
    svg.querySelectorAll(".cross").forEach((cross) => cross.remove());
    for (const other of figure.panels) {
      const at = fromX(other, frame).toFixed(1), [, top, , height] = other.frame;
      svg.append(element("path", { class: "cross", d: `M${at} ${top}v${height}` }));
    }
    tip.hidden = false;
    const room = 14, { offsetWidth: width, offsetHeight: height } = tip;
    const left = event.clientX + room + width > innerWidth ? event.clientX - room - width : event.clientX + room;
    const top = event.clientY + room + height > innerHeight ? event.clientY - room - height : event.clientY + room;
    tip.style.transform = `translate(${Math.max(4, left)}px,${Math.max(4, top)}px)`;
  }

  function hide(svg) {
    svg.querySelectorAll(".cross").forEach((cross) => cross.remove());
    tip.hidden = true;
  }

  const figures = [];
  for (const holder of document.querySelectorAll("figure[data-figure]")) {
    const svg = holder.querySelector("svg.chart"), figure = numbers[holder.dataset.figure];
    if (!svg || !figure || !figure.panels.length) continue;
    svg.addEventListener("pointermove", (event) => show(svg, figure, event));
    svg.addEventListener("pointerleave", () => hide(svg));
    figures.push({ id: holder.dataset.figure, svg, figure });
  }

  // Points at the middle of each first panel and keeps what the tip says.
  function selfTest() {
    const hovered = {};
    for (const { id, svg, figure } of figures) {
      const [left, top, width, height] = figure.panels[0].frame;
      const box = svg.getBoundingClientRect(), scale = box.width / svg.viewBox.baseVal.width;
      const clientX = box.left + (left + width / 2) * scale, clientY = box.top + (top + height / 2) * scale;
      svg.dispatchEvent(new PointerEvent("pointermove", { clientX, clientY, bubbles: true }));
      hovered[id] = tip.hidden ? "" : tip.innerText;
      svg.dispatchEvent(new PointerEvent("pointerleave"));
    }
    const marks = {};
    for (const holder of document.querySelectorAll("figure.present")) {
      marks[holder.dataset.figure] = holder.querySelectorAll(".mark-line,.mark-area,.mark-heat,.mark-picture").length;
    }
    const requests = performance.getEntriesByType("resource").map((entry) => entry.name).filter((name) => !name.startsWith("data:"));
    const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
    const result = { problems: window.problems, requests, marks, hovered, wide, tipHidden: tip.hidden };
    document.documentElement.dataset.selftest = JSON.stringify(result);
  }
  if (location.hash === "#selftest") window.addEventListener("load", selfTest);
})();
